#include "identify/error_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/settings/wording.h"

namespace gaitlab::identify {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Differences (simulated - measured) / width of all joints and quantities, one after another; empty if the run did not reach
/// its end.
VectorXd residuals(const Scenario& scenario, const Recording& recording, const std::vector<Logged>& kinds,
                   const std::vector<double>& widths) {
  if (!recording.outcome.done()) return {};
  std::vector<double> all;
  const MeasuredLog& log = *scenario.measured.log;
  for (const MeasuredLog::OfJoint& joint : log.joints) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const std::vector<double>& measured = joint.of(kinds[i]);
      if (measured.empty()) continue;
      const std::vector<double> simulated = report::at_log(scenario, recording, joint.joint, kinds[i]);
      if (simulated.size() < measured.size()) return {};
      for (std::size_t k = 0; k < measured.size(); ++k) all.push_back((simulated[k] - measured[k]) / widths[i]);
    }
  }
  return Eigen::Map<const VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace

std::optional<double> mean_error(const std::vector<BenchLog>& logs, const std::vector<Compared>& runs, Logged kind,
                                 bool held_out) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t l = 0; l < logs.size(); ++l) {
    if (logs[l].held_out != held_out) continue;
    sum += error_of(runs[l], kind);
    ++count;
  }
  return count == 0 ? std::nullopt : std::optional(sum / static_cast<double>(count));
}

double error_of(const Compared& run, Logged kind) { return run.errors->mean(kind, &report::LogError::mae).value_or(0); }

ErrorModels::ErrorModels(const std::vector<BenchLog>& logs, const std::vector<Key>& keys, std::vector<Logged> kinds,
                         int threads, std::atomic<bool>& stop)
    : logs_(logs), keys_(keys), kinds_(std::move(kinds)), threads_(threads), stop_(stop) {
  const std::vector<Compared> bench = compared(Point{});
  for (std::size_t l = 0; l < logs.size(); ++l) {
    if (!bench[l].errors) {
      throw RunError(fmt::format("log {}: the run of the bench does not reach the end of the log; run the bench to see why",
                                 logs[l].name));
    }
  }
  constexpr double kPart = 0.5;    // chosen: widths of 10 and 30 mrad end within 1 mrad of one another on 16 logs of an XL330
  constexpr double kLeast = 1e-9;  // far below any log: a bench without an error gives no width
  for (const Logged kind : kinds_)
    widths_.push_back(std::max(kPart * mean_error(logs, bench, kind, false).value_or(0), kLeast));
}

double ErrorModels::scale(std::size_t key) const {
  constexpr double kPart = 0.1;  // chosen
  const Key& of = keys_[key];
  return of.start != 0 ? std::abs(of.start) : kPart * std::max(std::abs(of.low), std::abs(of.high));
}

double ErrorModels::step(const Point& point, std::size_t varied) const {
  // Contact of gear and load, sticking and rows of a log make the error rough below this part of a value (chosen).
  constexpr double kPart = 0.03;
  constexpr double kOfScale = 0.01;  // chosen, for a value near 0
  const Key& key = keys_[point.keys[varied]];
  const double value = point.values[static_cast<Eigen::Index>(varied)];
  const double size = std::max({kPart * std::abs(value), kOfScale * scale(point.keys[varied]), key.least});
  return value + size > key.high ? -size : size;
}

std::vector<std::string> sets_of(const Point& point, const std::vector<Key>& keys) {
  std::vector<double> values;
  for (const Key& key : keys) values.push_back(key.bench);
  for (std::size_t k = 0; k < point.keys.size(); ++k) values[point.keys[k]] = point.values[static_cast<Eigen::Index>(k)];
  std::vector<std::string> sets;
  for (std::size_t k = 0; k < keys.size(); ++k) sets.push_back(keys[k].name + "=" + number_text(values[k]));
  return sets;
}

Point ErrorModels::varied(const Point& point, std::size_t key) const {
  Point other = point;
  if (key < point.keys.size()) other.values[static_cast<Eigen::Index>(key)] += step(point, key);
  return other;
}

void ErrorModels::run(std::size_t count, const std::function<Scenario(std::size_t)>& scenario,
                      const std::function<void(const RolloutEnd&)>& end) {
  std::size_t next = 0;
  const BatchStream stream{.next = [&]() -> std::optional<Rollout> {
                             while (next < count) {
                               const std::size_t number = next++;
                               try {
                                 return Rollout{number, scenario(number)};
                               } catch (const InputError&) {  // no servo has these values; the run counts as not whole
                               }
                             }
                             return {};
                           },
                           .end =
                               [&](std::vector<RolloutEnd>&& pack) {
                                 for (const RolloutEnd& one : pack) {
                                   if (one.refused.empty()) end(one);
                                 }
                               }};
  constexpr std::size_t kLookAhead = 64;  // each waiting run holds the texts of its log
  if (!run_pulled(stream, {threads_, 0}, Loads::left_out, stop_, kLookAhead)) throw Stopped{};
  runs_ += count;
}

std::vector<Compared> ErrorModels::compared(const Point& point) {
  std::vector<Compared> all(logs_.size());
  std::vector<Scenario> scenarios;
  for (const BenchLog& log : logs_) scenarios.push_back(log.with->with(sets_of(point, keys_)));
  const auto largest = [](const Recording& recording, std::size_t joint, const char* quantity) {
    double most = 0;
    const Series values = recording.series(fmt::format("joint.{}.{}", joint, quantity));
    for (std::size_t k = 0; k < values.size(); ++k) most = std::max(most, std::abs(values[k]));
    return most;
  };
  run(
      logs_.size(), [&](std::size_t l) { return scenarios[l]; },
      [&](const RolloutEnd& one) {
        if (!one.recording.outcome.done()) return;
        Compared& made = all[one.rollout.number];
        made.errors = report::log_errors(one.rollout.scenario, one.recording);
        for (const MeasuredLog::OfJoint& joint : one.rollout.scenario.measured.log->joints) {
          made.largest_current = std::max(made.largest_current, largest(one.recording, joint.joint, "current"));
          made.largest_speed = std::max(made.largest_speed, largest(one.recording, joint.joint, "speed"));
          made.largest_torque = std::max(made.largest_torque, one.recording.joints[joint.joint].torque_peak);
          MeasuredLog::OfJoint& curves = made.simulated.emplace_back(MeasuredLog::OfJoint{joint.joint, {}});
          for (const LoggedKind& kind : logged_kinds()) {
            if (joint.of(kind.kind).empty()) continue;
            curves.values[static_cast<std::size_t>(kind.kind)] =
                report::at_log(one.rollout.scenario, one.recording, joint.joint, kind.kind);
          }
        }
      });
  return all;
}

std::vector<ErrorModel> ErrorModels::operator()(std::span<const Question> questions) {
  struct Part {
    std::size_t question, varied;  // varied: number of the key, or their count for none
  };
  std::vector<Part> parts;
  for (std::size_t q = 0; q < questions.size(); ++q) {
    for (std::size_t k = 0; k <= questions[q].point.keys.size(); ++k) parts.push_back({q, questions[q].point.keys.size() - k});
  }
  std::vector<VectorXd> residual(parts.size());
  run(
      parts.size(),
      [&](std::size_t i) {
        const Question& of = questions[parts[i].question];
        return logs_[of.log].with->with(sets_of(varied(of.point, parts[i].varied), keys_));
      },
      [&](const RolloutEnd& one) {
        residual[one.rollout.number] = residuals(one.rollout.scenario, one.recording, kinds_, widths_);
      });

  std::vector<ErrorModel> answers;
  for (std::size_t first = 0, q = 0; q < questions.size(); ++q) {
    const Point& point = questions[q].point;
    const std::size_t count = point.keys.size();
    ErrorModel& model = answers.emplace_back();
    const VectorXd& r = residual[first];
    if (r.size() > 0) {
      const auto rows = static_cast<double>(r.size());
      MatrixXd slopes = MatrixXd::Zero(r.size(), static_cast<Eigen::Index>(count));
      for (std::size_t k = 1; k <= count; ++k) {
        const std::size_t varied = parts[first + k].varied;
        const VectorXd& other = residual[first + k];
        if (other.size() != r.size()) continue;  // no slope: the key stays in this step
        slopes.col(static_cast<Eigen::Index>(varied)) = (other - r) * (scale(point.keys[varied]) / step(point, varied));
      }
      const Eigen::ArrayXd stretch = (1 + r.array().square()).sqrt();
      const Eigen::VectorXd weight = stretch.inverse();
      const MatrixXd weighted = weight.asDiagonal() * slopes;
      const MatrixXd local = weight.cwiseProduct(weight).asDiagonal() * weighted;
      model = {true,
               2 * (stretch - 1).mean(),
               r.cwiseAbs().mean(),
               weighted.transpose() * r / rows,
               weighted.transpose() * slopes / rows,
               local.transpose() * slopes / rows};
    }
    first += count + 1;
  }
  return answers;
}

}  // namespace gaitlab::identify
