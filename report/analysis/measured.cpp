#include "report/analysis/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/scenario/built_robot.h"

namespace gaitlab::report {

namespace {

constexpr double kWholeDuty = 0.999;  // share of the supply from which a motor counts as at the limit; chosen: a PWM has steps
constexpr double kSameTime = 1e-9;    // s; rounding of times

std::string column_of(std::size_t joint, const char* quantity) { return fmt::format("joint.{}.{}", joint, quantity); }

/// Rows of the log that the run covers.
std::size_t covered(const MeasuredLog& log, const Series& t) {
  if (t.size() < 2) return 0;
  const auto end = std::upper_bound(log.t.begin(), log.t.end(), t.back() + kSameTime);
  return static_cast<std::size_t>(end - log.t.begin());
}

/// Walk over the rows of a trace along rising times.
class RowWalk {
 public:
  explicit RowWalk(Series t) : t_(t) {}
  /// Moves to the row before a time, and returns the share of the interval to the next row that has passed.
  double move_to(double time) {
    while (row_ + 2 < t_.size() && t_[row_ + 1] <= time) ++row_;
    return std::clamp((time - t_[row_]) / (t_[row_ + 1] - t_[row_]), 0.0, 1.0);
  }
  [[nodiscard]] std::size_t row() const { return row_; }
  [[nodiscard]] double length() const { return t_[row_ + 1] - t_[row_]; }

 private:
  Series t_;
  std::size_t row_ = 0;
};

/// Cubic with the values x0, x1 and the slopes v0, v1 at both ends of an interval h (Hermite), at its share s.
double cubic(double x0, double v0, double x1, double v1, double h, double s) {
  const double r = 1 - s;
  return x0 * r * r * (1 + 2 * s) + x1 * s * s * (3 - 2 * s) + h * s * r * (v0 * r - v1 * s);
}

LogError error_of(const std::vector<double>& simulated, const std::vector<double>& measured, const std::vector<double>& t) {
  LogError made;
  double low = measured[0];
  double high = measured[0];
  for (std::size_t k = 0; k < simulated.size(); ++k) {
    const double off = std::abs(simulated[k] - measured[k]);
    made.mae += off;
    made.rms += off * off;
    if (off > made.peak || k == 0) {
      made.peak = off;
      made.peak_time = t[k];
    }
    low = std::min(low, measured[k]);
    high = std::max(high, measured[k]);
  }
  const auto rows = static_cast<double>(simulated.size());
  made.mae /= rows;
  made.rms = std::sqrt(made.rms / rows);
  made.span = high - low;
  return made;
}

/// Duty of a joint at the times of the log.
std::vector<double> duty_at_log(const Scenario& scenario, const Recording& record, std::size_t joint) {
  const MeasuredLog& log = *scenario.measured.log;
  const Series t = record.series("t");
  const Series command = record.series(column_of(joint, logged_kinds()[static_cast<std::size_t>(Logged::duty)].column));
  const Series bus = record.series("supply.voltage");
  const std::unique_ptr<Actuator> motors = make_motors(scenario);
  const double most = motors->command_limit()[joint];
  std::vector<double> duty(command.empty() ? 0 : covered(log, t));
  RowWalk walk(t);
  for (std::size_t k = 0; k < duty.size(); ++k) {
    const double share = walk.move_to(log.t[k]);
    // A row has the command that was in force before it.
    const std::size_t row = walk.row() + (share * walk.length() > kSameTime ? 1 : 0);
    duty[k] = std::clamp(command[row] / (bus.empty() ? most : std::min(most, bus[row])), -1.0, 1.0);
  }
  return duty;
}

/// Share of the first rows with the whole duty.
double share_at_limit(const std::vector<double>& duty, std::size_t rows) {
  const auto whole = [](double one) { return std::abs(one) >= kWholeDuty; };
  const auto count = std::count_if(duty.begin(), duty.begin() + static_cast<std::ptrdiff_t>(rows), whole);
  return static_cast<double>(count) / static_cast<double>(rows);
}

}  // namespace

std::vector<double> at_log(const Scenario& scenario, const Recording& record, std::size_t joint, Logged kind) {
  if (kind == Logged::duty) return duty_at_log(scenario, record, joint);
  const LoggedKind& of = logged_kinds()[static_cast<std::size_t>(kind)];
  const MeasuredLog& log = *scenario.measured.log;
  const Series t = record.series("t");
  const Series encoder = kind == Logged::angle ? record.series(column_of(joint, "measured")) : Series();
  const Series value = encoder.empty() ? record.series(column_of(joint, of.column)) : encoder;
  const Series slope = kind == Logged::angle && encoder.empty() ? record.series(column_of(joint, "speed")) : Series();
  std::vector<double> values(value.empty() ? 0 : covered(log, t));
  RowWalk walk(t);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double s = walk.move_to(log.t[k]);
    const std::size_t i = walk.row();
    values[k] = slope.empty() ? value[i] + s * (value[i + 1] - value[i])
                              : cubic(value[i], slope[i], value[i + 1], slope[i + 1], walk.length(), s);
  }
  return values;
}

std::optional<LogErrors> log_errors(const Scenario& scenario, const Recording& record) {
  if (!scenario.measured.any()) return {};
  const MeasuredLog& log = *scenario.measured.log;
  LogErrors made;
  made.rows = covered(log, record.series("t"));
  if (made.rows < 2) return {};
  made.from_log = log.t.back();
  made.compared = log.t[made.rows - 1];
  for (const MeasuredLog::OfJoint& of : log.joints) {
    JointLogErrors& joint = made.joints.emplace_back();
    joint.joint = of.joint;
    for (const LoggedKind& kind : logged_kinds()) {
      if (of.of(kind.kind).empty()) continue;
      const std::vector<double> simulated = at_log(scenario, record, of.joint, kind.kind);
      if (simulated.empty()) return {};
      joint.errors[static_cast<std::size_t>(kind.kind)] = error_of(simulated, of.of(kind.kind), log.t);
      if (kind.kind != Logged::duty) continue;
      joint.at_limit = share_at_limit(simulated, made.rows);
      joint.measured_at_limit = share_at_limit(of.of(kind.kind), made.rows);
    }
  }
  return made;
}

std::optional<double> LogErrors::mean(Logged kind, double LogError::*number) const {
  double sum = 0;
  std::size_t count = 0;
  for (const JointLogErrors& joint : joints) {
    if (!joint.of(kind)) continue;
    sum += *joint.of(kind).*number;
    ++count;
  }
  return count == 0 ? std::nullopt : std::optional(sum / static_cast<double>(count));
}

std::optional<double> LogErrors::mean(std::optional<double> JointLogErrors::*share) const {
  double sum = 0;
  std::size_t count = 0;
  for (const JointLogErrors& joint : joints) {
    if (!(joint.*share)) continue;
    sum += *(joint.*share);
    ++count;
  }
  return count == 0 ? std::nullopt : std::optional(sum / static_cast<double>(count));
}

const JointLogErrors* LogErrors::of(std::size_t joint) const {
  const auto found = std::ranges::find(joints, joint, &JointLogErrors::joint);
  return found == joints.end() ? nullptr : &*found;
}

}  // namespace gaitlab::report
