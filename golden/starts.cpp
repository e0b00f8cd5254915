#include "golden/starts.h"

#include <cmath>
#include <cstdint>

#include "core/math/random.h"
#include "core/scenario/sensor_section.h"

namespace gaitlab::golden {

namespace {

constexpr double kOfRounding =
    1e-7;  // rad; above the rounding errors of another compiler, far below a visible change of a torque
// rad; a fraction of the step of an encoder, so that the steps come at other times, and far below the amplitude of a gait
constexpr double kOfSteps = 1e-3;

/// The column `t` of a trace.
Trace times_of(const Trace& trace) {
  Trace times{{trace.columns[0]}, {}};
  for (std::size_t k = 0; k < trace.rows(); ++k) times.values.push_back(trace.at(k, 0));
  return times;
}

/// The scenario with each initial joint angle changed by up to `most` (rad), by splitmix64 of a counter.
Scenario moved_start(const Scenario& scenario, int member, double most) {
  Scenario moved = scenario;
  const std::size_t joints = scenario.robot->joints.size();
  PerJoint& angles = moved.initial.angles;
  angles.each.resize(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const std::uint64_t counter = static_cast<std::uint64_t>(member) * joints + j + 1;
    const std::uint64_t seed = math::splitmix64(static_cast<std::uint64_t>(scenario.seed) + 1);
    angles.each[j] = scenario.initial.angles[j] + most * math::symmetric(math::splitmix64(seed + counter));
  }
  return moved;
}

}  // namespace

Scenario perturbed(const Scenario& scenario, int member) { return moved_start(scenario, member, kOfRounding); }

std::vector<Scenario> starts(const Scenario& scenario) {
  std::vector<Scenario> all{scenario};
  if (!quantised(scenario)) return all;
  for (int member = 1; member < kStarts; ++member) all.push_back(moved_start(scenario, member, kOfSteps));
  return all;
}

GoldenRun mean_of(std::span<const GoldenRun> runs) {
  GoldenRun mean = runs.front();
  if (runs.size() == 1) return mean;
  const auto count = static_cast<double>(runs.size());
  mean.trace = times_of(runs.front().trace);
  mean.starts = static_cast<int>(runs.size());
  for (std::size_t i = 0; i < mean.numbers.size(); ++i) {
    double sum = 0;
    for (const GoldenRun& run : runs) sum += run.numbers[i].value;
    mean.numbers[i].value = sum / count;
    double squares = 0;
    for (const GoldenRun& run : runs) squares += std::pow(run.numbers[i].value - sum / count, 2);
    mean.numbers[i].deviation = std::sqrt(squares / (count - 1));
  }
  for (std::size_t i = 0; i < mean.bounds.size(); ++i) {
    double sum = 0;
    for (const GoldenRun& run : runs) sum += run.bounds[i].value;
    mean.bounds[i].value = sum / count;
  }
  return mean;
}

}  // namespace gaitlab::golden
