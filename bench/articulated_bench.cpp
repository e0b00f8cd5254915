// Benchmarks of engine `articulated`: one step of the engine, a control tick, and a complete run; also chains of 10 to 1000
// modules.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <utility>

#include "bench/scenarios.h"
#include "core/plugin/plugin_instance.h"
#include "core/simulation/simulation.h"
#include "core/simulation/start.h"

namespace gaitlab {
namespace {

constexpr double kStep = 5e-4;  // s

const std::string kJoints = "trace.columns=[joint.*]";

Scenario shipped(const std::string& name, std::vector<std::string> sets = {}) {
  sets.push_back(kJoints);
  return bench::shipped(name, std::move(sets));
}

/// Measures one step of the implicit method for `lanes` rollouts side by side. The robot stands on the ground, and its motors
/// have no command.
void kernel(benchmark::State& state, const Scenario& s, std::size_t lanes) {
  const auto& widths = s.physics.engine->lanes;
  if (std::find(widths.begin(), widths.end(), lanes) == widths.end()) {
    state.SkipWithError("this processor has no such lanes");
    return;
  }
  const std::vector<const PluginSelection*> choices(lanes, &s.actuator);
  const std::unique_ptr<Actuator> motors = make_actuator(choices, info(*s.robot));
  const LaneSettings own{s.robot, s.physics.gravity, s.ground, contact_elements(*s.robot, s.contact.on), s.contact.penalty};
  PlantSettings settings;
  static_cast<LaneSettings&>(settings) = own;
  settings.others.assign(lanes - 1, own);
  settings.base = s.base;
  settings.actuator = motors.get();
  settings.integrator = s.physics.engine->fixed().name;
  const std::unique_ptr<Plant> plant = s.physics.engine->make(settings);
  const StateLayout layout{s.robot->joints.size(), lanes};
  std::vector<double> x(layout.size());
  const std::vector<double> command(s.robot->joints.size() * lanes);
  for (std::size_t l = 0; l < lanes; ++l) layout.write(start_state(s), l, x);
  std::vector<double> history(plant->history());
  plant->bind(x, history);
  for (int i = 0; i < 200; ++i) plant->advance(command, kStep);  // until the robot stands
  const std::vector<double> standing = x;
  for ([[maybe_unused]] auto once : state) {
    std::copy(standing.begin(), standing.end(), x.begin());  // every call computes the same step
    plant->advance(command, kStep);
    benchmark::DoNotOptimize(x.data());
    benchmark::ClobberMemory();
  }
}

/// Measures one step of a scenario. The argument of the benchmark is the number of lanes.
void kernel_of(benchmark::State& state, const char* file) {
  kernel(state, shipped(file), static_cast<std::size_t>(state.range(0)));
}

/// Measures one step of a caterpillar. The argument of the benchmark is the number of modules. The cost per module is fitted;
/// the exponent of the cost is log10(t(1000) / t(10)) / 2.
void kernel_of_chain(benchmark::State& state) {
  kernel(state, bench::chain(static_cast<std::size_t>(state.range(0)), {kJoints}), 1);
  state.SetComplexityN(state.range(0));
}

/// Measures a simulation step with CPG, controllers and trace at every step. The cost of a control tick is this time minus that
/// of a step alone.
void tick_of(benchmark::State& state, const char* file) {
  const std::string period = "=0.0005";  // equals kStep
  const Scenario s =
      shipped(file, {"controller.period" + period, "trace.period" + period, "physics.step" + period, "duration=1000"});
  Simulation simulation({&s, 1});
  for ([[maybe_unused]] auto once : state) simulation.step();
}

/// Measures two simulated seconds with the engine's default step. The counter shows simulated seconds per second.
void run_of(benchmark::State& state, const char* file) {
  const Scenario s = shipped(file, {"duration=2"});
  for ([[maybe_unused]] auto once : state) {
    Simulation simulation({&s, 1});
    simulation.run();
    benchmark::DoNotOptimize(simulation.state().data());
  }
  state.counters["sim_s/s"] = benchmark::Counter(2, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK_CAPTURE(kernel_of, hexapod, "hexapod.yaml")->Arg(1)->Arg(4)->Arg(8);
BENCHMARK_CAPTURE(kernel_of, caterpillar, "caterpillar.yaml")->Arg(1)->Arg(4)->Arg(8);
BENCHMARK(kernel_of_chain)->Arg(10)->Arg(100)->Arg(1000)->Complexity(benchmark::oN);
BENCHMARK_CAPTURE(tick_of, hexapod, "hexapod.yaml")->Iterations(2000);
BENCHMARK_CAPTURE(tick_of, caterpillar, "caterpillar.yaml")->Iterations(2000);
BENCHMARK_CAPTURE(run_of, hexapod, "hexapod.yaml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_of, caterpillar, "caterpillar.yaml")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitlab
