// Benchmarks of files: a run folder, its page, and the exports of long chains; and of a ground with many boxes.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "bench/scenarios.h"
#include "core/simulation/simulation.h"
#include "interchange/mjcf.h"
#include "interchange/urdf.h"
#include "kit/run_writer.h"
#include "report/analysis/summary.h"
#include "report/page/page_data.h"
#include "report/verdict/verdict.h"
#include "tests/folder.h"

namespace gaitlab {
namespace {

/// A run, its numbers and its verdict.
struct Judged {
  explicit Judged(Scenario s) : scenario(std::move(s)) {
    Simulation simulation({&scenario, 1}, Loads::recorded);
    simulation.run();
    recording = simulation.take_recording(0);
    summary = report::summarise(scenario, recording, 0);
    verdict = report::verdict(scenario, recording, summary, report::overlaps(scenario, recording));
  }
  Scenario scenario;
  Recording recording;
  report::Summary summary;
  report::Verdict verdict;
};

/// Measures the files of 8 s of a walk, with all columns in rows of 5 ms. The argument of the benchmark is 1 with the page.
void run_folder(benchmark::State& state, const char* file) {
  const Judged run(bench::shipped(file, {"duration=8", "physics.estimate=off"}));
  const test::Folder folder;
  kit::RunWriter writer(folder.path(), [](const std::string&) {});
  for ([[maybe_unused]] auto once : state) {
    writer.write_run("h5", run.scenario, run.recording);
    writer.write_report(run.scenario, run.recording, run.summary, run.verdict, state.range(0) != 0);
  }
  if (writer.lost_any()) state.SkipWithError("a file was not written");
}

/// Measures numbers and verdict of 0.1 s of a chain. The argument of the benchmarks of chains is the number of modules; the
/// cost per module is fitted.
void verdict_of_chain(benchmark::State& state) {
  const Judged run(bench::chain(static_cast<std::size_t>(state.range(0)), {"duration=0.1", "physics.estimate=off"}));
  for ([[maybe_unused]] auto once : state) {
    const report::Summary summary = report::summarise(run.scenario, run.recording, 0);
    const report::Overlaps overlaps = report::overlaps(run.scenario, run.recording);
    benchmark::DoNotOptimize(report::verdict(run.scenario, run.recording, summary, overlaps).checks.data());
  }
  state.SetComplexityN(state.range(0));
}

void page_of_chain(benchmark::State& state) {
  const Judged run(bench::chain(static_cast<std::size_t>(state.range(0)), {"duration=0.1", "physics.estimate=off"}));
  for ([[maybe_unused]] auto once : state)
    benchmark::DoNotOptimize(report::page_data(run.scenario, run.recording, run.summary, run.verdict).data.data());
  state.SetComplexityN(state.range(0));
}

void mjcf_of_chain(benchmark::State& state) {
  const Scenario s = bench::chain(static_cast<std::size_t>(state.range(0)));
  for ([[maybe_unused]] auto once : state)
    benchmark::DoNotOptimize(interchange::to_mjcf(s, interchange::MjcfModel::walking).data());
  state.SetComplexityN(state.range(0));
}

void urdf_of_chain(benchmark::State& state) {
  const Scenario s = bench::chain(static_cast<std::size_t>(state.range(0)));
  for ([[maybe_unused]] auto once : state) benchmark::DoNotOptimize(interchange::to_urdf(s).data());
  state.SetComplexityN(state.range(0));
}

/// Measures 2 s of the hexapod on flat boxes. The argument of the benchmark is the number of boxes, on which the cost should
/// not depend.
void run_on_boxes(benchmark::State& state) {
  const auto boxes = static_cast<std::size_t>(state.range(0));
  const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(boxes)));
  std::string list;
  for (std::size_t i = 0; i < boxes; ++i) {
    const double x = 0.2 * (static_cast<double>(i % columns) - static_cast<double>(columns) / 2);
    const double y = 0.2 * (static_cast<double>(i / columns) - static_cast<double>(boxes / columns) / 2);
    list += fmt::format("{}{{center: [{}, {}, -0.01], size: [0.15, 0.15, 0.025]}}", list.empty() ? "" : ", ", x, y);
  }
  const Scenario s = bench::shipped("hexapod.yaml",
                                    {"duration=2", "physics.estimate=off", "ground.type=boxes", "ground.boxes=[" + list + "]"});
  for ([[maybe_unused]] auto once : state) {
    Simulation simulation({&s, 1});
    simulation.run();
  }
}

BENCHMARK_CAPTURE(run_folder, hexapod, "hexapod.yaml")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_folder, caterpillar, "caterpillar.yaml")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(verdict_of_chain)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);
BENCHMARK(page_of_chain)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);
BENCHMARK(mjcf_of_chain)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);
BENCHMARK(urdf_of_chain)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);
BENCHMARK(run_on_boxes)->Arg(10)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitlab
