// Benchmarks of engine `articulated`: a step of the kernel, a control tick, a whole run; chains of 10 to 1000 modules.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "app/app.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/read_scenario.h"
#include "core/simulation/simulation.h"
#include "core/simulation/start.h"

namespace gaitlab {
namespace {

constexpr double kStep = 5e-4;  // s

/// Outlives the scenarios made from it.
Catalog& catalog() {
  static Catalog all = app::standard_catalog();
  return all;
}

Scenario shipped(const std::string& name, std::vector<std::string> sets = {}) {
  sets.emplace_back("physics.engine=articulated");
  sets.emplace_back("trace.columns=[joint.*]");
  return read_scenario(std::string(GAITLAB_SOURCE_DIR) + "/scenarios/" + name, sets, catalog());
}

/// The caterpillar with another number of modules.
Scenario chain(std::size_t modules) {
  std::vector<Dock> docks;
  for (int k = 1; k < static_cast<int>(modules); ++k) docks.push_back({1, k, 4, k - 1, 0});
  Scenario s = shipped("caterpillar.yaml");
  s.robot = std::make_shared<Robot>(assemble(s.robot->types, std::vector<std::size_t>(modules, 0), docks));
  return s;
}

/// Steps of the implicit method alone, of `lanes` rollouts: standing on the ground, motors without a command. Time per pack.
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
  for (int i = 0; i < 200; ++i) plant->advance(command, kStep);  // until it stands
  const std::vector<double> standing = x;
  for ([[maybe_unused]] auto once : state) {
    std::copy(standing.begin(), standing.end(), x.begin());  // so that every call computes the same
    plant->advance(command, kStep);
    benchmark::DoNotOptimize(x.data());
    benchmark::ClobberMemory();
  }
}

/// Argument: lanes.
void kernel_of(benchmark::State& state, const char* file) {
  kernel(state, shipped(file), static_cast<std::size_t>(state.range(0)));
}

/// Argument: modules. The cost per module is fitted; the exponent is log10(t(1000) / t(10)) / 2.
void kernel_of_chain(benchmark::State& state) {
  kernel(state, chain(static_cast<std::size_t>(state.range(0))), 1);
  state.SetComplexityN(state.range(0));
}

/// Loop, CPG, controllers and one step with control and trace at every step; the cost of a tick is this minus that of a step.
void tick_of(benchmark::State& state, const char* file) {
  const std::string period = "=0.0005";  // kStep
  const Scenario s =
      shipped(file, {"controller.period" + period, "trace.period" + period, "physics.step" + period, "duration=1000"});
  Simulation simulation({&s, 1});
  for ([[maybe_unused]] auto once : state) simulation.step();
}

/// Two simulated seconds at the engine's default step; counter: simulated seconds per second.
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
