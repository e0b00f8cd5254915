// Benchmarks of the preparation of a rollout: its scenario is read from a file or made from a template.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sys/resource.h>

#include "app/app.h"
#include "core/scenario/read_scenario.h"
#include "core/simulation/batch.h"
#include "report/analysis/summary.h"

namespace gaitlab {
namespace {

const std::string kScenarios = std::string(GAITLAB_SOURCE_DIR) + "/scenarios/";

/// Measures reading a scenario with one changed number.
void read(benchmark::State& state, const char* name) {
  Catalog catalog = app::standard_catalog();
  double frequency = 0.3;
  const std::size_t before = mallinfo2().uordblks;
  std::vector<Scenario> kept;
  for ([[maybe_unused]] auto once : state) {
    kept.push_back(read_scenario(kScenarios + name, {"cpg.frequency=" + std::to_string(frequency += 1e-5)}, catalog));
  }
  state.counters["bytes"] = static_cast<double>(mallinfo2().uordblks - before) / static_cast<double>(kept.size());
}
/// Measures making the same scenario as a rollout of a template.
void rollout(benchmark::State& state, const char* name) {
  Catalog catalog = app::standard_catalog();
  const ScenarioTemplate from(kScenarios + name, {}, catalog);
  double frequency = 0.3;
  std::vector<Scenario> kept;
  kept.reserve(1000000);
  const std::size_t before = mallinfo2().uordblks;
  for ([[maybe_unused]] auto once : state) kept.push_back(from.with({"cpg.frequency=" + std::to_string(frequency += 1e-5)}));
  state.counters["bytes"] =
      static_cast<double>(mallinfo2().uordblks - before) / static_cast<double>(kept.size()) + sizeof(Scenario);
}

/// Measures making a simulation, which checks the assembled robot and makes the plant.
void simulation(benchmark::State& state, const char* name) {
  Catalog catalog = app::standard_catalog();
  const ScenarioTemplate from(kScenarios + name, {"physics.engine=articulated"}, catalog);
  const Scenario one = from.with({"cpg.frequency=0.4"});
  for ([[maybe_unused]] auto once : state) benchmark::DoNotOptimize(Simulation({&one, 1}).step_number());
}

/// Shows the largest memory of the process during a stream of ten thousand rollouts of 0.5 s.
void stream(benchmark::State& state) {
  Catalog catalog = app::standard_catalog();
  const ScenarioTemplate from(kScenarios + "hexapod.yaml", {"physics.engine=articulated", "duration=0.5"}, catalog);
  for ([[maybe_unused]] auto once : state) {
    std::int64_t made = 0;
    double distance = 0;
    run_stream(
        [&]() -> std::optional<Scenario> {
          if (made == state.range(0)) return std::nullopt;
          return from.with({"cpg.frequency=" + std::to_string(0.3 + 1e-5 * static_cast<double>(made++))});
        },
        {.threads = 2}, [](const Scenario& s, Recording&& r) { return report::summarise(s, r, 0); },
        [&](report::Summary&& summary) { distance += summary.distance; });
    benchmark::DoNotOptimize(distance);
  }
  struct rusage used = {};
  getrusage(RUSAGE_SELF, &used);
  state.counters["MB"] = static_cast<double>(used.ru_maxrss) / 1000;
}

BENCHMARK_CAPTURE(read, hexapod, "hexapod.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(read, caterpillar, "caterpillar.yaml")->Unit(benchmark::kMicrosecond);

BENCHMARK_CAPTURE(rollout, hexapod, "hexapod.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rollout, caterpillar, "caterpillar.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(simulation, hexapod, "hexapod.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(simulation, caterpillar, "caterpillar.yaml")->Unit(benchmark::kMicrosecond);

BENCHMARK(stream)->Arg(10000)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitlab
