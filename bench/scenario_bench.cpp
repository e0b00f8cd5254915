// What one more rollout of a scenario costs before it runs: reading it anew.
#include <benchmark/benchmark.h>

#include <malloc.h>

#include "app/app.h"
#include "core/simulation/batch.h"

namespace gaitlab {
namespace {

const std::string kScenarios = std::string(GAITLAB_SOURCE_DIR) + "/scenarios/";

/// Reading a scenario with one number changed.
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
BENCHMARK_CAPTURE(read, hexapod, "hexapod.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(read, caterpillar, "caterpillar.yaml")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gaitlab
