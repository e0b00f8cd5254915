#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "app/shell/commands.h"
#include "app/shell/progress.h"
#include "core/parallel.h"
#include "core/recording/convergence.h"
#include "core/scenario/sensor_section.h"
#include "core/simulation/batch_limits.h"
#include "core/simulation/simulation.h"

namespace gaitlab::app {

namespace {

struct ConvergeArguments : ScenarioArguments {
  int halvings = 2;
  std::vector<std::string> columns;  ///< patterns of column names; if empty: the torques or, without motors, the angles
  int jobs = 1;                      ///< threads
};

constexpr double kGood = 0.01;       // error of a "good" step: 1 %
constexpr double kLeastOrder = 0.5;  // at a lower observed order, halving the step hardly helps, and the power law would
                                     // suggest absurd steps

/// Patterns as items of a YAML list.
std::string quoted(const std::vector<std::string>& patterns) {
  std::string text;
  for (const std::string& pattern : patterns) {
    text += text.empty() ? "\"" : ", \"";
    for (const char c : pattern) {
      if (c == '"' || c == '\\') text += '\\';
      text += c;
    }
    text += '"';
  }
  return text;
}

struct Runs {
  std::vector<double> steps;  // s; accuracies if the integrator adapts its step
  const char* what = "step";
  const char* unit = " s";
  std::vector<Trace> traces;
  std::vector<std::vector<double>> travel;  // displacement of the centre of mass in x and y over the run
  double allowed = 0;                       // longest stable step; 0 if any step is stable
  bool quantised = false;                   // a sensor has a resolution
};

/// Progress of runs side by side. Each takes twice as long as the previous run.
class DoublingProgress {
 public:
  DoublingProgress(bool quiet, std::size_t runs) : progress_(quiet), done_(runs) {}
  void operator()(std::size_t run, double share) {
    const std::lock_guard lock(mutex_);
    done_[run] = share * static_cast<double>(1 << run);
    progress_(std::accumulate(done_.begin(), done_.end(), 0.0) / static_cast<double>((1 << done_.size()) - 1));
  }

 private:
  Progress progress_;
  std::vector<double> done_;
  std::mutex mutex_;
};

Runs all_runs(const Scenario& scenario, int halvings, int jobs, bool quiet) {
  const auto count = static_cast<std::size_t>(halvings) + 1;
  Runs runs;
  runs.traces.resize(count);
  runs.travel.resize(count);
  runs.quantised = quantised(scenario);
  const bool adapts = scenario.physics.adapts();
  if (adapts) {
    runs.what = "accuracy";
    runs.unit = "";
  }
  const double first = adapts ? scenario.physics.accuracy : scenario.physics.step;
  for (std::size_t i = 0; i < count; ++i) runs.steps.push_back(first / static_cast<double>(1 << i));
  std::vector<double> rate(count);
  DoublingProgress progress(quiet, count);
  parallel(count, jobs, [&](std::size_t i) {
    Scenario halved = scenario;
    halved.physics.refine(static_cast<double>(1 << i));
    Simulation simulation({&halved, 1});
    rate[i] = simulation.standing().rate;
    simulation.run([&](double share) { progress(i, share); });
    Recording r = simulation.take_recording(0);
    rate[i] = std::max(rate[i], r.worst.rate);
    runs.travel[i] = {r.travel().x(), r.travel().y()};
    runs.traces[i] = std::move(r.trace);
  });
  if (rate.back() > 0) runs.allowed = 1 / rate.back();
  return runs;
}

void print(const ConvergenceRow& row) {
  fmt::print("{:<24}", row.name);
  for (const double error : row.error) fmt::print(" {:>10.2g} %", 100 * error);
  fmt::print(" {:>6}\n", row.order ? fmt::format("{:.1f}", *row.order) : "-");
}

/// Column with the largest error at step number `i`, and this error plus that of the finest step. NaN is larger than any
/// number. There is at least one row.
std::pair<const ConvergenceRow*, double> worst_at(const std::vector<ConvergenceRow>& rows, std::size_t i) {
  const auto error_of = [i](const ConvergenceRow& row) { return (i < row.error.size() ? row.error[i] : 0) + row.left; };
  std::pair<const ConvergenceRow*, double> worst{&rows.front(), error_of(rows.front())};
  for (const ConvergenceRow& row : rows) {
    const double error = error_of(row);
    if (error > worst.second || std::isnan(error)) worst = {&row, error};
  }
  return worst;
}

/// Sentence on the step with an error of 1 %, found from the tried steps and the observed order.
std::string verdict(const std::vector<ConvergenceRow>& rows, const Runs& runs) {
  const double finest = runs.steps.back();
  if (runs.quantised)
    return "no step can be recommended: the resolution of sensors amplifies rounding errors, so that runs do not converge";
  const auto within_rule = [&](double step) { return !(runs.allowed > 0) || step <= runs.allowed; };
  const ConvergenceRow& last = *worst_at(rows, runs.steps.size() - 1).first;
  std::string text = fmt::format("no value that was tried is both allowed and accurate to 1 % of {}", last.name);
  for (std::size_t i = 0; i < runs.steps.size(); ++i) {
    const auto [row, error] = worst_at(rows, i);
    if (!(error <= kGood) || !within_rule(runs.steps[i])) continue;
    text = fmt::format("{} {}{} is accurate to 1 %: the error is at most {:.2g} % ({}), including the error of {}{} itself",
                       runs.what, runs.steps[i], runs.unit, 100 * error, row->name, finest, runs.unit);
    break;
  }
  if (!within_rule(runs.steps.front())) {
    text +=
        fmt::format("; the rule h lambda <= 1 allows up to {:.3g} s, less than the longest step that was tried", runs.allowed);
  }
  if (runs.steps.size() < 3) return text;
  if (last.order && *last.order < kLeastOrder) {
    return text + fmt::format("; the observed order, {:.2f}, is too low to predict other values", *last.order);
  }
  const std::optional<double> reach = last.step_for(kGood, finest);
  if (!reach) return text + "; the order is not clear enough to predict other values";
  if (!within_rule(*reach)) {
    if (!within_rule(runs.steps.front())) return text;
    return text + fmt::format("; the rule h lambda <= 1 allows longer steps only up to {:.3g} s", runs.allowed);
  }
  return text + fmt::format("; by the observed order about {:.2g}{} would suffice", *reach, runs.unit);
}

int converge(const ConvergeArguments& arguments) {
  Catalog catalog = standard_catalog();
  ConvergeArguments with_columns = arguments;
  std::vector<std::string> wanted = arguments.columns;
  if (!wanted.empty()) with_columns.sets.push_back("trace.columns=[" + quoted(wanted) + "]");
  Scenario scenario = read(with_columns, catalog);
  if (!wanted.empty()) scenario.own_places["trace.columns"] = SourceLocation{"--columns"};
  if (wanted.empty()) {
    wanted = {scenario.actuator.entry != nullptr ? "joint.*.torque" : "joint.*.angle"};
    if (!scenario.robot->joints.empty()) scenario.trace.columns = wanted;
  }
  const Runs runs = all_runs(scenario, arguments.halvings, arguments.jobs, arguments.quiet);

  fmt::print("{}: error against {} {}{} (RMS over the rows / largest magnitude of the column)\n", scenario.name, runs.what,
             runs.steps.back(), runs.unit);
  fmt::print("{:<24}", scenario.physics.adapts() ? runs.what : "step, s");
  for (std::size_t i = 0; i + 1 < runs.steps.size(); ++i) fmt::print(" {:>12}", runs.steps[i]);
  fmt::print(" {:>6}\n", "order");
  const std::vector<ConvergenceRow> rows = convergence(runs.traces, wanted);
  for (const ConvergenceRow& row : rows) print(row);
  ConvergenceRow travel = convergence("displacement", runs.travel);
  const bool moves = std::hypot(runs.travel.back()[0], runs.travel.back()[1]) > 1e-3;  // m; with a smaller displacement the
                                                                                       // relative error is noise
  if (moves) print(travel);
  if (rows.empty()) {
    fmt::print("the only column requested is the time\n");
    return 0;
  }
  ConvergenceRow worst = *worst_at(rows, 0).first;
  worst.name = "worst: " + worst.name;
  print(worst);
  fmt::print("{}\n", verdict(rows, runs));
  return 0;
}

}  // namespace

void add_converge(Commands& commands) {
  add_command<ConvergeArguments>(
      commands, "converge",
      "Halve the step, and print the errors against the finest step, their order, and the step that is accurate to 1 %.",
      converge, [](CLI::App& command, ConvergeArguments& arguments) {
        add_scenario(command, arguments);
        command.add_option("--halvings", arguments.halvings, "number of halvings (default 2; an order needs 2)")
            ->check(CLI::Range(1, 8));
        command
            .add_option(
                "--columns", arguments.columns,
                "trace columns that match this pattern (default joint.*.torque, or joint.*.angle if no joint has a motor)")
            ->expected(1)
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        command.add_option("-j,--jobs", arguments.jobs, "threads (default 1)")->check(CLI::Range(1, kMostThreads));
      });
}

}  // namespace gaitlab::app
