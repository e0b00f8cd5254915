// Benchmarks of a study: the quantities of a run, its row in the journal, reading many rows, and rollouts as in a sweep.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <optional>

#include "app/app.h"
#include "app/study/study_quantities.h"
#include "core/scenario/read_scenario.h"
#include "core/simulation/batch.h"
#include "report/analysis/summary.h"
#include "report/verdict/verdict.h"
#include "studies/journal/results.h"
#include "tests/folder.h"

namespace gaitlab {
namespace {

/// A scenario and its recording over 12 s, with a row every 15 ms.
struct Recorded {
  explicit Recorded(const char* name) {
    scenarios.push_back(read_scenario(std::string(GAITLAB_SOURCE_DIR) + "/scenarios/" + name,
                                      {"physics.engine=articulated", "duration=12", "trace.period=0.015"}, catalog));
    run_batch(scenarios, {}, [this](std::size_t, Recording&& r) { recording = std::move(r); });
  }
  Catalog catalog = app::standard_catalog();
  std::vector<Scenario> scenarios;
  Recording recording;
};

void summary(benchmark::State& state, const char* name) {
  const Recorded run(name);
  for ([[maybe_unused]] auto once : state)
    benchmark::DoNotOptimize(report::summarise(run.scenarios[0], run.recording, 0).speed);
}

void overlaps(benchmark::State& state, const char* name) {
  const Recorded run(name);
  for ([[maybe_unused]] auto once : state) benchmark::DoNotOptimize(report::overlaps(run.scenarios[0], run.recording));
}

/// Measures the evaluation of a run: summary, overlaps, verdict and the columns of the journal.
void measure(benchmark::State& state, const char* name) {
  const Recorded run(name);
  const studies::Measure of = app::quantity_measure(app::quantity_offer().common, run.scenarios[0]);
  for ([[maybe_unused]] auto once : state) benchmark::DoNotOptimize(of(run.scenarios[0], run.recording).quantities.data());
}

/// Measures four rollouts of 20 s side by side, as in a sweep: simulated and judged, with all quantities.
void rollouts(benchmark::State& state, const char* name) {
  Catalog catalog = app::standard_catalog();
  const ScenarioTemplate from(std::string(GAITLAB_SOURCE_DIR) + "/scenarios/" + name,
                              {"physics.engine=articulated", "physics.estimate=off", "duration=20"}, catalog);
  std::vector<Scenario> pack;
  for (const char* frequency : {"0.42", "0.47", "0.52", "0.57"})
    pack.push_back(from.with({std::string("cpg.frequency=") + frequency}));
  const studies::Measure of = app::quantity_measure(app::quantity_offer().common, pack[0]);
  double simulated = 0;
  for ([[maybe_unused]] auto once : state) {
    std::size_t next = 0;
    std::atomic<bool> stop = false;
    const BatchStream stream{.next = [&]() -> std::optional<Rollout> {
                               if (next == pack.size()) return {};
                               const std::size_t number = next++;
                               return Rollout{number, pack[number]};
                             },
                             .end =
                                 [&](std::vector<RolloutEnd>&& ended) {
                                   for (const RolloutEnd& one : ended) {
                                     simulated += one.recording.simulated;
                                     benchmark::DoNotOptimize(of(one.rollout.scenario, one.recording).quantities.data());
                                   }
                                 }};
    run_pulled(stream, {1, 4}, of.reads, stop);
  }
  state.counters["simulated s/s"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
}

/// Head of the journal of a study with 6 parameters and 30 quantities.
studies::JournalHead head() {
  studies::JournalHead head;
  head.name = "bench";
  head.objectives = {{"f0", true}};
  for (int k = 0; k < 6; ++k) head.parameters.push_back({fmt::format("p{}", k), false, false, 0, 1, false, {}});
  for (int k = 0; k < 30; ++k) head.quantities.push_back({fmt::format("f{}", k), "", ""});
  head.shown = {"f0"};
  return head;
}

void write_rows(studies::Journal& journal, std::uint64_t first, std::uint64_t count) {
  constexpr std::uint64_t kPack = 8;
  for (std::uint64_t run = first; run < first + count; run += kPack) {
    std::vector<studies::Row> rows;
    for (std::uint64_t r = run; r < run + kPack; ++r) {
      const double x = 1.0 / static_cast<double>(r + 3);
      studies::Row row;
      row.run = r;
      row.point = fmt::format("{:032x}", r * 0x9E3779B97F4A7C15ULL);
      row.outcome = "done";
      row.simulated = 12;
      for (int k = 0; k < 6; ++k) row.values.push_back(fmt::format("{}", x * (k + 1)));
      for (int k = 0; k < 30; ++k) row.quantities.push_back(x * (k + 7));
      row.verdict = "feasible";
      row.score = studies::Score{{x}, 0};
      rows.push_back(std::move(row));
    }
    journal.write(rows, {run, kPack, "2000-01-01T00:00:00Z", 1, "bench", 1});
  }
}

/// Measures writing rows in packs of eight. Each pack is on the disk before the next one is written.
void journal_write(benchmark::State& state) {
  const test::Folder folder;
  studies::Journal journal(folder.path() / studies::kJournalFile, head(), studies::Journal::Build::same);
  std::uint64_t rows = 0;
  constexpr std::uint64_t kRows = 8000;
  for ([[maybe_unused]] auto once : state) {
    write_rows(journal, rows, kRows);
    rows += kRows;
  }
  double bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path())) bytes += static_cast<double>(file.file_size());
  state.counters["rows/s"] = benchmark::Counter(static_cast<double>(rows), benchmark::Counter::kIsRate);
  state.counters["bytes/row"] = bytes / static_cast<double>(rows);
}

/// Measures reading a journal for `study show`.
void journal_results(benchmark::State& state) {
  const test::Folder folder;
  studies::Journal journal(folder.path() / studies::kJournalFile, head(), studies::Journal::Build::same);
  write_rows(journal, 0, static_cast<std::uint64_t>(state.range(0)));
  for ([[maybe_unused]] auto once : state) benchmark::DoNotOptimize(studies::results(journal).points.data());
}

BENCHMARK_CAPTURE(summary, caterpillar, "caterpillar.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(overlaps, caterpillar, "caterpillar.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(measure, caterpillar, "caterpillar.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(measure, hexapod, "hexapod.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rollouts, caterpillar, "caterpillar.yaml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rollouts, hexapod, "hexapod.yaml")->Unit(benchmark::kMillisecond);
BENCHMARK(journal_write)->Unit(benchmark::kMillisecond);
BENCHMARK(journal_results)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitlab
