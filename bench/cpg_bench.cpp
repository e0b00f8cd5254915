// Benchmarks of a CPG at a control tick: the built-in phase oscillator, and the same model written as equations.
#include <benchmark/benchmark.h>

#include "cpg/equations.h"
#include "cpg/phase_oscillator.h"

namespace gaitlab {
namespace {

RobotInfo chain(std::size_t joints) {
  RobotInfo robot;
  for (std::size_t j = 0; j < joints; ++j) {
    JointInfo joint;
    joint.name = "j" + std::to_string(j);
    joint.parent = static_cast<std::int64_t>(j) - 1;
    joint.lo = -1.6;
    joint.hi = 1.6;
    robot.joints.push_back(joint);
  }
  return robot;
}

/// Measures one derivative and one output. The arguments of the benchmark are the number of joints and the coupling rule. The
/// state is not advanced, so that every call computes the same.
template <class Model>
void cpg(benchmark::State& state) {
  const auto joints = static_cast<std::size_t>(state.range(0));
  typename Model::Settings settings;
  settings.rule = static_cast<CouplingRule>(state.range(1));
  const Model model(chain(joints), settings);
  std::vector<double> x(model.states()), rate(x.size()), setpoint(joints);
  model.start(x);
  // Avoids special values such as sin(0).
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += 0.1 + 0.01 * static_cast<double>(i);
  for ([[maybe_unused]] auto once : state) {
    model.derivative({}, x, rate);
    model.output(0, x, setpoint);
    benchmark::DoNotOptimize(rate.data());
    benchmark::DoNotOptimize(setpoint.data());
    benchmark::ClobberMemory();
  }
}

constexpr auto kChain = static_cast<std::int64_t>(CouplingRule::chain);
constexpr auto kAll = static_cast<std::int64_t>(CouplingRule::all);

BENCHMARK(cpg<cpg::PhaseOscillator>)
    ->Name("phase_oscillator")
    ->ArgNames({"joints", "rule"})
    ->Args({16, kChain})
    ->Args({16, kAll});
BENCHMARK(cpg<cpg::Equations>)->Name("equations")->ArgNames({"joints", "rule"})->Args({16, kChain})->Args({16, kAll});

}  // namespace
}  // namespace gaitlab
