#include "python/native/rollouts.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/errors.h"
#include "core/settings/wording.h"
#include "core/simulation/batch.h"
#include "python/native/apart.h"
#include "report/verdict/measure.h"
#include "report/verdict/trust.h"

namespace py = pybind11;

namespace gaitlab::python {

namespace {

/// The rows of a table, each of which is filled by one thread.
class Rows {
 public:
  Rows(const PyScenario& scenario, const std::vector<Texts>& overrides, report::RunMeasure measure, double* values,
       std::size_t width, std::size_t estimate_every)
      : outcome(overrides.size(), "not run"),
        verdict(overrides.size()),
        message(overrides.size()),
        scenario_(scenario),
        overrides_(overrides),
        measure_(std::move(measure)),
        values_(values),
        width_(width),
        estimate_every_(estimate_every) {}

  std::vector<std::string> outcome, verdict, message;

  [[nodiscard]] std::size_t ended() const { return ended_; }
  /// Warns that rows without an estimate are not reliable, if the estimates show it.
  void doubt() const {
    constexpr std::size_t kOneIn = 10;
    if (estimate_every_ == 1 || large_ * kOneIn <= estimates_) return;
    say("rollouts", "warning",
        fmt::format("the torque error is above limits.torque_error in {} of {} estimates: `feasible` is not reliable for the "
                    "other rows; take "
                    "estimate_every=1, and a smaller physics.accuracy or physics.step",
                    large_.load(), estimates_.load()));
  }
  bool run(const BatchSettings& settings, std::atomic<bool>& stop) {
    return run_pulled({.next = [&] { return next(); }, .end = [&](std::vector<RolloutEnd>&& group) { end(std::move(group)); }},
                      settings, measure_.reads, stop);
  }

 private:
  std::optional<Rollout> next() {
    while (next_ < overrides_.size()) {
      const std::size_t i = next_++;
      Texts own = scenario_.own;
      own.insert(own.end(), overrides_[i].begin(), overrides_[i].end());
      try {
        Rollout rollout{i, scenario_.file->with(own)};
        Physics& physics = rollout.scenario.physics;
        if (physics.estimate == Estimate::full && !is_estimated(i)) {
          physics.estimate = Estimate::off;
          physics.estimated_by_others = true;
        }
        return rollout;
      } catch (const InputError& error) {
        refuse(i, error);
      } catch (const PluginError& error) {
        give(i, "plugin", error.what());
      }
    }
    return {};
  }
  void end(std::vector<RolloutEnd>&& group) {
    for (RolloutEnd& one : group) {
      const std::size_t i = one.rollout.number;
      const Outcome& how = one.recording.outcome;
      if (!one.refused.empty()) {
        refuse(i, InputError(std::move(one.refused)));
      } else if (!how.done()) {
        give(i, name_of(how.ended), how.text());
      } else {
        const report::MeasuredRun measured = measure_.measured(one.rollout.scenario, one.recording);
        std::ranges::copy(measured.quantities, values_ + i * width_);
        count_estimate(one.recording, one.rollout.scenario.limits.most_torque_error());
        verdict[i] = name_of(measured.verdict);
        give(i, "done", measured.why);
      }
    }
  }
  /// Like Plan::estimates of a study, but by the number of the row.
  [[nodiscard]] bool is_estimated(std::size_t i) const {
    constexpr std::size_t kFewest = 3;
    if (estimate_every_ == 0) return false;
    return (overrides_.size() + estimate_every_ - 1) / estimate_every_ < kFewest || i % estimate_every_ == 0;
  }
  /// `most` is the largest error of a run that is judged.
  void count_estimate(const Recording& recording, double most) {
    const report::TorqueError error = report::torque_error(recording);
    estimates_ += error.estimated ? 1 : 0;
    large_ += error.estimated && !(error.share <= most) ? 1 : 0;
  }
  void refuse(std::size_t i, const InputError& error) { give(i, "refused", error.what()); }
  void give(std::size_t i, std::string how, std::string why) {
    outcome[i] = std::move(how);
    message[i] = std::move(why);
    ++ended_;
  }

  const PyScenario& scenario_;
  const std::vector<Texts>& overrides_;
  report::RunMeasure measure_;
  double* values_;
  std::size_t width_, estimate_every_, next_ = 0;
  std::atomic<std::size_t> ended_ = 0, estimates_ = 0, large_ = 0;
};

/// The columns of the table. Throws InputError for unknown ones, with the nearest known name.
std::vector<report::QuantityText> columns_of(const Texts& quantities, const Robot& robot) {
  if (quantities.empty()) return report::common_quantities();
  std::vector<report::QuantityText> columns;
  std::vector<std::string> known;
  for (const report::QuantityText& one : report::common_quantities()) known.push_back(one.name);
  for (const report::QuantityText& one : report::quantities_of_joints()) known.push_back(one.name);
  Problems problems;
  for (const std::string& name : quantities) {
    if (auto found = report::describe_quantity(name, robot)) {
      columns.push_back(std::move(*found));
      continue;
    }
    const std::string near = nearest(name, known);
    problems.add(SourceLocation{"quantities"}, in_quotes(name) + " is not a quantity of this robot" +
                                                   (near.empty() ? "" : "; did you mean " + in_quotes(near) + "?"));
  }
  problems.raise();
  return columns;
}

}  // namespace

py::dict roll_out(const PyScenario& scenario, const std::vector<Texts>& overrides, const Texts& quantities,
                  const RolloutSettings& settings, const py::object& progress) {
  const std::vector<report::QuantityText> columns = columns_of(quantities, *scenario.scenario.robot);
  Texts names;
  Texts units;
  for (const report::QuantityText& column : columns) {
    names.push_back(column.name);
    units.push_back(column.unit);
  }
  const std::size_t n = overrides.size();
  py::array_t<double> values({static_cast<py::ssize_t>(n), static_cast<py::ssize_t>(columns.size())});
  std::fill(values.mutable_data(), values.mutable_data() + values.size(), std::nan(""));
  Rows rows(scenario, overrides, report::run_measure(names, *scenario.scenario.robot), values.mutable_data(), columns.size(),
            settings.estimate_every);
  std::atomic<bool> stop = false;
  std::function<void()> told;
  if (!progress.is_none()) told = [&] { progress(rows.ended(), n); };
  py::object raised = py::none();
  try {
    const int threads = static_cast<int>(std::min(static_cast<std::size_t>(settings.threads), std::max<std::size_t>(n, 1)));
    apart(stop, told, [&] { rows.run({threads, settings.lanes}, stop); });
    rows.doubt();
    if (told) told();
  } catch (py::error_already_set& error) {
    if (error.trace()) error.value().attr("__traceback__") = error.trace();
    raised = error.value();
  }
  return py::dict(py::arg("names") = names, py::arg("units") = units, py::arg("values") = values,
                  py::arg("outcome") = rows.outcome, py::arg("verdict") = rows.verdict, py::arg("message") = rows.message,
                  py::arg("raised") = raised);
}

std::vector<std::vector<std::string>> quantity_texts(bool of_joints) {
  std::vector<std::vector<std::string>> all;
  for (const report::QuantityText& one : of_joints ? report::quantities_of_joints() : report::common_quantities())
    all.push_back({one.name, one.unit, one.meaning});
  return all;
}

}  // namespace gaitlab::python
