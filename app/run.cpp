#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <functional>

#include "app/commands.h"
#include "app/progress.h"
#include "app/run_time.h"
#include "app/stop_on_signal.h"
#include "core/files/atomic_file.h"
#include "core/recording/recording_file.h"
#include "core/recording/run_folder.h"
#include "core/scenario/resolved.h"
#include "core/simulation/simulation.h"
#include "report/build_id.h"
#include "report/figure.h"
#include "report/page.h"
#include "report/run_figure.h"
#include "report/summary.h"

namespace gaitlab::app {

namespace {

void write_run(const std::filesystem::path& folder, const std::string& format, const Scenario& scenario,
               const Recording& recording, const report::Summary& summary) {
  write_recording(recording, {resolved(scenario), scenario.seed, summary.build, recording.outcome}, format, folder);
  write_file(folder / "scenario.resolved.yaml", resolved(scenario));
}

void write_report(const std::filesystem::path& folder, const Scenario& scenario, const Recording& recording,
                  const report::Summary& summary, const report::Verdict& verdict, bool page) {
  write_file(folder / "figure.svg", report::run_figure(scenario, recording, summary));
  write_file(folder / "verdict.json", report::to_json(verdict));
  if (page) write_file(folder / kPageFile, report::page(report::page_data(scenario, recording, summary, verdict)));
  // Last: a folder with a summary is a whole run.
  write_file(folder / "summary.json", report::to_json(summary, scenario, recording));
}

/// The first steps of the run tell how long it takes: nothing is simulated twice.
void note_time(const Scenario& scenario, Simulation& simulation) {
  const RunTime time = measure(simulation, scenario.duration);
  if (time.seconds > kLongRun) fmt::print(stderr, "{}: note: {}\n", scenario.file, to_string(time));
}

}  // namespace

int run(const RunArguments& arguments) {
  Catalog catalog = standard_catalog();
  Scenario scenario = read(arguments, catalog);
  draw_joints(scenario, arguments.joints);
  return run(scenario, arguments);
}

int run(const Scenario& scenario, const RunArguments& arguments) {
  warn_of_start(scenario, arguments.quiet);  // first: a slip of units is why a step is refused
  Simulation simulation({&scenario, 1}, Loads::recorded);
  RunFolder folder(arguments.out, scenario.name);
  constexpr double kMuch = 1e8;  // bytes
  if (const RowsNeeded needed = simulation.rows_needed(0); needed.bytes() > kMuch && !arguments.quiet) {
    fmt::print(
        stderr,
        "{}: note: records {:.3g} rows of {:.0f} columns, {:.3g} MB in memory; trace.period and trace.columns make it less\n",
        scenario.file, needed.rows, needed.columns, needed.bytes() / 1e6);
  }

  const StopOnSignal stop(StopOnSignal::Second::is_ignored);
  std::string failure;
  const auto start = std::chrono::steady_clock::now();
  try {
    if (!arguments.quiet) note_time(scenario, simulation);
    const Progress progress(arguments.quiet);
    if (!simulation.run(std::cref(progress), &stopped()))
      failure = fmt::format("interrupted at t = {:.6g} s", simulation.time());
  } catch (const SimulationError& error) {
    failure = error.what();
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;

  Recording recording = simulation.take_recording(0);
  if (!failure.empty()) recording.outcome = failure;
  const report::Summary summary = report::summarise(scenario, recording, wall.count());
  write_run(folder.path(), arguments.format, scenario, recording, summary);
  const report::Overlaps overlaps = report::overlaps(scenario, recording);
  const report::Verdict verdict = judged(scenario, recording, summary, overlaps, arguments.shown);
  write_report(folder.path(), scenario, recording, summary, verdict, !arguments.no_page);
  folder.keep();
  if (!arguments.quiet) {
    print_summary(scenario, recording, summary, verdict, arguments.shown);
    fmt::print("  {:<13} {}: {}, summary.json, verdict.json,\n  {:<13} scenario.resolved.yaml, figure.svg\n", "files",
               folder.path().string(), arguments.format == "csv" ? "trace.csv, recording.h5" : "trace.h5", "");
    if (!arguments.no_page) print_page(folder.path() / kPageFile);
  }
  warn_of_run(scenario, recording, summary, overlaps);
  if (failure.empty()) return exit_code(verdict, arguments.shown);
  fmt::print(stderr, "{}: error: {}; what was simulated until then is in {}\n", scenario.file, failure, folder.path().string());
  return 1;
}

void add_run(Commands& commands) {
  add_command<RunArguments>(commands, "run", "Simulate a scenario, write a run folder and print the summary.", run,
                            [](CLI::App& command, RunArguments& arguments) {
                              add_scenario(command, arguments);
                              command.add_option("--out", arguments.out,
                                                 "run folder (default runs/NAME, then NAME-2 ...); new or empty");
                              command.add_option("--format", arguments.format, "format of the trace: h5 (default) or csv")
                                  ->check(CLI::IsMember({"h5", "csv"}));
                              command.add_flag("--no-report", arguments.no_page, "write no report.html");
                              add_joint(command, arguments.joints);
                              add_shown(command, arguments.shown);
                            });
}

}  // namespace gaitlab::app
