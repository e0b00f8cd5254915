#include "golden/runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <span>

#include "core/build_id.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sections.h"
#include "core/settings/joint_patterns.h"
#include "core/simulation/probes.h"
#include "core/simulation/simulation.h"
#include "golden/natural_scales.h"
#include "golden/starts.h"
#include "report/verdict/numbers/quantities.h"
#include "report/verdict/verdict.h"

namespace gaitlab::golden {

namespace {

constexpr double kRowEvery = 0.02;     // s; follows a gait of 0.5 Hz, without most of the spikes of contacts
constexpr double kLeastTravel = 0.01;  // m; for a robot that travels less, the cost of transport is noise

std::vector<std::string> usual_columns(const Scenario& scenario) {
  std::vector<std::string> names;
  if (report::has_motors(scenario)) names = {"joint.*.torque", "joint.*.current"};
  if (!scenario.robot->joints.empty()) names.emplace_back("joint.*.angle");
  for (const char* part : {"x", "y", "z", "qw", "qx", "qy", "qz"}) names.push_back(std::string("base.") + part);
  return names;
}

// Every stride-th row of a trace. The last row is omitted if it is not a trace tick.
Trace thinned(const Trace& trace, double period) {
  const auto stride = std::max<std::int64_t>(1, static_cast<std::int64_t>(kRowEvery / period * (1 + 1e-9)));
  Trace thin{trace.columns, {}};
  for (std::size_t k = 0; k < trace.rows(); k += static_cast<std::size_t>(stride)) {
    if (std::abs(trace.at(k, 0) - static_cast<double>(k) * period) > 1e-6 * period) break;
    thin.values.insert(thin.values.end(), trace.row(k).begin(), trace.row(k).end());
  }
  return thin;
}

/// Time of the peak `number`. Null if it is not a peak, or if its time is not recorded.
const report::SummaryNumber* time_of(const report::SummaryNumber& number) {
  const std::string key = std::string(number.key) + "_time";
  for (const report::SummaryNumber& other : report::summary_numbers()) {
    if (other.key == key && other.of_joint != nullptr) return &other;
  }
  return nullptr;
}

std::vector<GoldenNumber> numbers(const Scenario& scenario, const Recording& record) {
  const report::Summary summary = report::summarise(scenario, record, 0);
  std::vector<const report::SummaryNumber*> kept = report::placed(&report::SummaryNumber::golden);
  if (!report::has_motors(scenario))
    std::erase_if(kept, [](const report::SummaryNumber* number) { return number->golden.needs_motor; });
  std::vector<GoldenNumber> all;
  for (const report::SummaryNumber* number : kept) {
    if (number->of_joint == nullptr) all.push_back({number->name(), number->unit, number->value({scenario, record, summary})});
  }
  for (std::size_t j = 0; j < record.joints.size(); ++j) {
    for (const report::SummaryNumber* number : kept) {
      if (number->of_joint == nullptr) continue;
      const report::RunData run{scenario, record, summary};
      all.push_back({number->name(scenario.robot->joints[j].name), number->unit, number->of_joint(run, j)});
      if (const report::SummaryNumber* time = time_of(*number); time != nullptr && time->of_joint(run, j) < summary.judged.from)
        all.back().at_start = time->of_joint(run, j);
    }
  }
  return all;
}

std::vector<BoundCheck> bounds(const Scenario& scenario, const report::RunData& run) {
  const MeasuredBounds& bound = scenario.measured.bound;
  std::vector<BoundCheck> all;
  for (std::size_t i = 0; i < bound.most.size(); ++i) {
    if (!bound.stated(i)) continue;
    const MeasuredBounds::Number& number = MeasuredBounds::numbers()[i];
    const std::string name = "measured." + number.key;
    const auto quantity = std::ranges::find(report::quantities(), name, &report::SummaryQuantity::name);
    all.push_back({name, number.unit, scenario.measured.path, quantity->value(run), bound.most[i]});
  }
  return all;
}

GoldenRun golden_run(const Scenario& scenario, const std::function<void(double)>& progress, bool judged) {
  Simulation simulation({&scenario, 1}, judged ? Loads::recorded : Loads::left_out);
  simulation.run(progress);
  const Recording record = simulation.take_recording(0);
  GoldenRun run{thinned(record.trace, scenario.trace.period), numbers(scenario, record)};
  run.natural = natural_scales(scenario, run.trace.columns);
  for (const Joint& joint : scenario.robot->joints) run.joints.push_back(joint.name);
  if (!judged) return run;
  const report::Summary summary = report::summarise(scenario, record, 0);
  run.bounds = bounds(scenario, {scenario, record, summary});
  const report::Verdict verdict = report::verdict(scenario, record, summary, report::overlaps(scenario, record));
  run.verdict = verdict.word;
  run.why = verdict.why();
  return run;
}

double steps(const Scenario& scenario) { return scenario.duration / scenario.physics.step; }

// Progress of all runs, measured in steps.
class Bar {
 public:
  Bar(const std::vector<Scenario>& scenarios, const std::function<void(double)>& progress) : progress_(progress) {
    for (const Scenario& scenario : scenarios) all_ += steps(scenario);
  }
  void add(double more) {
    const std::lock_guard lock(mutex_);
    done_ += more;
    if (progress_) progress_(std::min(1.0, done_ / all_));
  }

 private:
  std::mutex mutex_;
  double all_ = 0, done_ = 0;
  const std::function<void(double)>& progress_;
};

/// One run per scenario, up to `jobs` at once.
std::vector<Attempt> attempts(const std::vector<Scenario>& scenarios, int jobs, const std::function<void(double)>& progress,
                              bool judged) {
  std::vector<Attempt> outcomes(scenarios.size());
  Bar bar(scenarios, progress);
  parallel(scenarios.size(), jobs, [&](std::size_t i) {
    const auto start = std::chrono::steady_clock::now();
    const auto stop = [&] {
      outcomes[i].seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    try {
      double before = 0;
      const auto advance = [&](double share) {
        bar.add((share - before) * steps(scenarios[i]));
        before = share;
      };
      outcomes[i].run = golden_run(scenarios[i], advance, judged);
    } catch (...) {
      outcomes[i].error = std::current_exception();
    }
    stop();
  });
  return outcomes;
}

/// Result of a scenario from the results of its starts: the mean of the runs, or the first error.
Attempt mean_of_attempts(std::span<const Attempt> attempts) {
  Attempt mean;
  std::vector<GoldenRun> runs;
  for (const Attempt& attempt : attempts) {
    mean.seconds += attempt.seconds;
    if (attempt.error && !mean.error) mean.error = attempt.error;
    runs.push_back(attempt.run);
  }
  if (!mean.error) mean.run = mean_of(runs);
  return mean;
}

/// True for each column that one of the patterns matches.
std::vector<bool> matching(const std::vector<std::string>& patterns, const std::vector<Column>& columns,
                           const Scenario& scenario) {
  std::vector<bool> found(columns.size());
  const std::vector<std::string> joints = joint_names(*scenario.robot);
  for (const std::string& pattern : patterns) {
    const ColumnChoice choice(pattern, joints, scenario.groups);
    for (std::size_t i = 0; i < columns.size(); ++i) found[i] = found[i] || choice.has(columns[i].name);
  }
  return found;
}

/// The usual columns that the scenario's `trace.columns` match: patterns if these match all of them, else names.
std::vector<std::string> usual_and_traced(const Scenario& scenario, const std::vector<Column>& columns) {
  const std::vector<bool> traced = matching(scenario.trace.columns, columns, scenario);
  std::vector<std::string> found;
  for (const std::string& pattern : usual_columns(scenario)) {
    const std::vector<bool> usual = matching({pattern}, columns, scenario);
    std::vector<std::string> names;
    bool all = true;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (usual[i] && traced[i]) names.push_back(columns[i].name);
      all = all && (traced[i] || !usual[i]);
    }
    if (all) names = {pattern};
    found.insert(found.end(), names.begin(), names.end());
  }
  if (!found.empty()) return found;
  throw InputError(scenario.place("trace.columns"),
                   fmt::format("matches no column that a golden holds: {}; add one of them, or choose others with gaitlab "
                               "approve --columns",
                               fmt::join(usual_columns(scenario), ", ")));
}

}  // namespace

Scenario with_golden_columns(const Scenario& scenario, const std::vector<std::string>& selected, const Trace* before) {
  Scenario made = scenario;
  const std::vector<Column> columns = Probes::known(scenario);
  made.trace.columns = selected.empty() ? usual_and_traced(scenario, columns) : selected;
  if (!selected.empty()) made.own_places["trace.columns"] = {"--columns"};
  const std::vector<bool> found = matching(made.trace.columns, columns, scenario);
  for (std::size_t i = 1; before != nullptr && i < columns.size(); ++i) {
    if (!found[i] && before->find(columns[i].name) < before->columns.size()) made.trace.columns.push_back(columns[i].name);
  }
  return made;
}

std::vector<Attempt> golden_runs(const std::vector<Scenario>& scenarios, int jobs, const std::function<void(double)>& progress,
                                 bool judged) {
  std::vector<Scenario> all;
  std::vector<std::size_t> first{0};  // index of the first start of each scenario, and the number of all starts
  for (const Scenario& scenario : scenarios) {
    for (Scenario& start : starts(scenario)) all.push_back(std::move(start));
    first.push_back(all.size());
  }
  const std::vector<Attempt> runs = attempts(all, jobs, progress, judged);
  std::vector<Attempt> outcomes;
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    outcomes.push_back(mean_of_attempts(std::span(runs).subspan(first[i], first[i + 1] - first[i])));
  return outcomes;
}

std::vector<GoldenNumber> golden_numbers(const GoldenRun& run) {
  const auto distance =
      std::find_if(run.numbers.begin(), run.numbers.end(), [](const GoldenNumber& n) { return n.name == "distance"; });
  std::vector<GoldenNumber> kept = run.numbers;
  if (distance->value > kLeastTravel) return kept;
  for (const report::SummaryNumber& entry : report::summary_numbers()) {
    if (entry.golden.needs_travel) std::erase_if(kept, [&](const GoldenNumber& number) { return number.name == entry.name(); });
  }
  return kept;
}

bool take_golden_accuracy(Scenario& scenario) {
  if (!scenario.physics.adapts() || scenario.places->contains("physics.accuracy")) return false;
  const bool sticks = scenario.actuator.entry != nullptr && !make_motors(scenario)->friction().empty();
  scenario.physics.accuracy = sticks ? kStickingAccuracy : kGoldenAccuracy;
  return true;
}

GoldenProvenance golden_origin(const Scenario& scenario) {
  const Engine& engine = *scenario.physics.engine;
  const std::string build = build_id();
  // Format of the build id: `VERSION (COMPILER; LIBRARIES)`.
  const std::size_t from = std::min(build.find('('), build.size() - 1) + 1;
  std::string text = resolved(scenario);
  std::string text_hash = hash(text);
  return {scenario.name,         engine.name,    scenario.physics.integrator->name,
          scenario.physics.step, build,          build.substr(from, build.find_first_of(";)", from) - from),
          std::move(text_hash),  std::move(text)};
}

}  // namespace gaitlab::golden
