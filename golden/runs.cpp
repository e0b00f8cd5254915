#include "golden/runs.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>

#include "core/build_id.h"
#include "core/math/random.h"
#include "core/parallel.h"
#include "core/scenario/resolved.h"
#include "core/simulation/simulation.h"
#include "report/verdict/numbers.h"
#include "report/verdict/verdict.h"

namespace gaitlab::golden {

namespace {

constexpr double kRowEvery = 0.02;      // s; a gait has about 0.5 Hz, and spikes of contacts do not drift
constexpr double kLeastTravel = 0.01;   // m; for a robot that travels less, the cost of transport is noise
constexpr double kPerturbation = 1e-7;  // rad; above the rounding of another compiler, far below a visible change of a torque

std::vector<std::string> columns(const Scenario& scenario) {
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

std::vector<Number> numbers(const Scenario& scenario, const Recording& record) {
  const report::Summary summary = report::summarise(scenario, record, 0);
  std::vector<const report::SummaryNumber*> kept = report::placed(&report::SummaryNumber::golden);
  if (!report::has_motors(scenario))
    std::erase_if(kept, [](const report::SummaryNumber* number) { return number->golden.needs_motor; });
  std::vector<Number> all;
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

GoldenRun golden_run(const Scenario& scenario, const std::function<void(double)>& progress, bool judged) {
  Scenario ours = scenario;
  ours.trace.columns = columns(scenario);
  Simulation simulation({&ours, 1}, judged ? Loads::recorded : Loads::left_out);
  simulation.run(progress);
  const Recording record = simulation.take_recording(0);
  GoldenRun run{thinned(record.trace, scenario.trace.period), numbers(scenario, record)};
  for (const Joint& joint : scenario.robot->joints) run.joints.push_back(joint.name);
  if (!judged) return run;
  const report::Verdict verdict =
      report::verdict(scenario, record, report::summarise(scenario, record, 0), report::overlaps(scenario, record));
  run.verdict = name_of(verdict.word);
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

}  // namespace

std::vector<Attempt> golden_runs(const std::vector<Scenario>& scenarios, int jobs, const std::function<void(double)>& progress,
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

std::vector<Number> golden_numbers(const GoldenRun& run) {
  const auto distance =
      std::find_if(run.numbers.begin(), run.numbers.end(), [](const Number& n) { return n.name == "distance"; });
  std::vector<Number> kept = run.numbers;
  if (distance->value > kLeastTravel) return kept;
  for (const report::SummaryNumber& entry : report::summary_numbers()) {
    if (entry.golden.needs_travel) std::erase_if(kept, [&](const Number& number) { return number.name == entry.name(); });
  }
  return kept;
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

Scenario perturbed(const Scenario& scenario, int member) {
  Scenario moved = scenario;
  const std::size_t joints = scenario.robot->joints.size();
  PerJoint& angles = moved.initial.angles;
  angles.each.resize(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const std::uint64_t counter = static_cast<std::uint64_t>(member) * joints + j + 1;
    const std::uint64_t seed = math::splitmix64(static_cast<std::uint64_t>(scenario.seed) + 1);
    angles.each[j] = scenario.initial.angles[j] + kPerturbation * math::symmetric(math::splitmix64(seed + counter));
  }
  return moved;
}

}  // namespace gaitlab::golden
