#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <new>
#include <optional>
#include <utility>

#include "app/gait/run_time.h"
#include "app/shell/commands.h"
#include "app/shell/progress.h"
#include "app/shell/stop_on_signal.h"
#include "app/study/study_progress.h"
#include "core/recording/run_folder.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sensor_section.h"
#include "core/simulation/batch.h"
#include "core/simulation/batch_limits.h"
#include "core/simulation/simulation.h"
#include "kit/run_warnings.h"
#include "kit/run_writer.h"
#include "kit/stored_scenario.h"
#include "report/analysis/summary.h"
#include "report/verdict/draws.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/numbers/summary_text.h"
#include "report/verdict/spread.h"
#include "report/verdict/trust.h"

namespace gaitlab::app {

namespace {

/// Summary and verdict of a recording, with the numbers that the verdict needs.
struct Judgement {
  report::Summary summary;
  report::Overlaps overlaps;
  report::Verdict verdict;
};

/// Prints the estimated time of a long run, and the faster engine. A run without a file is a repeated run of a study, which has
/// printed them.
void note_time(const Scenario& scenario, const RunArguments& arguments, const RowsNeeded& rows) {
  if (arguments.quiet || arguments.file.empty()) return;
  Catalog catalog = standard_catalog();
  const double seconds = estimated_seconds(scenario, rows);
  const std::string advice = faster_engine(scenario, seconds, rows, arguments, catalog);
  if (seconds > kLongRun || !advice.empty()) say(scenario.file, "note", time_text(seconds, advice));
}

/// Simulates the rollouts for Recording::spread if the motion is unpredictable. If memory is short or a plugin throws, the run
/// is written without them.
void take_spread(const Scenario& scenario, Recording& recording, const Judgement& own, bool quiet) try {
  if (!needs_spread(scenario, recording)) return;
  if (!quiet) {
    say(scenario.file, "note",
        report::predictability_text(scenario, recording) +
            "; three more rollouts are simulated to show the spread of the results");
  }
  AgainProgress progress(quiet, "spread");
  recording.spread =
      report::spread(scenario, recording, own.summary, own.verdict, stopped(), [&] { progress.add(1, report::kSpread); });
} catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch)
} catch (const PluginError&) {     // NOLINT(bugprone-empty-catch)
}

/// Scenarios with the next seeds after the seed of `scenario`.
std::vector<Scenario> other_draws(const Scenario& scenario, const RunArguments& arguments, Catalog& catalog) {
  constexpr std::int64_t kMostSeed = 9'000'000'000'000'000'000;
  if (arguments.draws == 1) return {};
  const SourceLocation place{"--draws"};
  if (!seed_matters(scenario)) {
    throw InputError(place,
                     "the seed has no effect, because no tolerance, sensor or lost set point is drawn; add for example "
                     "tolerances: {mass: 0.03, R: 0.07} (gaitlab explain scenario)");
  }
  if (scenario.seed > kMostSeed - arguments.draws) {
    throw InputError(
        place, fmt::format("{} draws from seed {} exceed the largest seed, {}", arguments.draws, scenario.seed, kMostSeed));
  }
  std::vector<std::vector<std::string>> seeds;
  for (int k = 1; k < arguments.draws; ++k) seeds.push_back({fmt::format("seed={}", scenario.seed + k)});
  return rollouts(arguments.file, arguments.sets, seeds, catalog);
}

/// Simulates the draws for Recording::draws. Returns false if they are incomplete. If memory is short or a plugin throws, the
/// run is written without them.
bool take_draws(const Scenario& scenario, std::span<const Scenario> draws, const RunArguments& arguments, Recording& recording,
                const Judgement& own) try {
  if (draws.empty()) return true;
  if (!recording.outcome.done()) {
    say("--draws", "warning", "the other seeds are not simulated, because the run ended early");
    return false;
  }
  AgainProgress progress(arguments.quiet, "draws");
  report::Drawn drawn = report::draws(scenario, {recording, own.summary, own.verdict}, draws, {arguments.jobs, 0}, stopped(),
                                      [&] { progress.add(1, draws.size()); });
  recording.draws = std::move(drawn.table);
  for (const std::string& refused : drawn.refused) say("--draws", "warning", refused);
  if (recording.draws.rows() == 1 + draws.size()) return true;
  say("--draws", "error", fmt::format("interrupted after {} of {}", recording.draws.rows(), 1 + draws.size()));
  return false;
} catch (const std::bad_alloc&) {
  say("--draws", "error", "not simulated: out of memory");
  return false;
} catch (const PluginError& error) {
  say("--draws", "error", error.what());
  return false;
}

/// Runs the simulation. Returns its outcome if the simulation did not reach the end of the run.
std::optional<Outcome> simulate(Simulation& simulation, bool quiet) try {
  Progress progress(quiet);
  if (simulation.run(std::ref(progress), &stopped())) return {};
  return Outcome{Ended::interrupted, fmt::format("interrupted at t = {:.6g} s", simulation.time())};
} catch (const SimulationError& error) {
  return error.outcome();
}

void print_files(const RunArguments& arguments, const std::filesystem::path& folder) {
  if (!arguments.no_page) print_page(folder / kPageFile);
  if (!arguments.no_page && !arguments.shown.verbose) return;
  print_lines({{"files", fmt::format("{}: {}, summary.json, verdict.json,", one_line(folder.string()),
                                     arguments.format == "csv" ? "trace.csv, recording.h5" : "trace.h5")},
               {"", "scenario.resolved.yaml, figure.svg"}});
}

/// Arguments of the more accurate run that replaces the `first` run without a verdict, if it is cheap. Runs of a study are
/// not replaced, because they have no file, and neither is a run whose file has changed since.
std::optional<RunArguments> more_accurate(const Scenario& first, const Recording& recording, const report::Verdict& own,
                                          const RowsNeeded& rows, const RunArguments& arguments) {
  if (arguments.no_retry || arguments.file.empty() || !recording.outcome.done()) return {};
  if (!own.retry_is_finer) return {};
  RunArguments again = arguments;
  again.no_retry = true;
  again.sets.insert(again.sets.end(), own.retry.begin(), own.retry.end());
  try {
    Catalog catalog = standard_catalog();  // the plugins of the run are already loaded
    Scenario same = read(arguments, catalog);
    draw_joints(same, arguments.joints);
    if (resolved(same) != resolved(first) || estimated_seconds(read(again, catalog), rows) >= kLongRun) return {};
  } catch (const InputError&) {
    return {};
  }
  if (!arguments.quiet) {
    say(first.file, "note",
        fmt::format("not judged: {}; simulated again with {} (--no-retry keeps the first run)", own.reason.text,
                    fmt::join(own.retry, " ")));
  }
  return again;
}

/// Reads a scenario and its further draws, and returns the exit code of `use(scenario, draws)`.
template <class Use>
int with_scenario(const RunArguments& arguments, const Use& use) {
  Catalog catalog = careful_catalog({.from_scenario = true, .files = arguments.libraries});
  Scenario scenario = read(arguments, catalog);
  draw_joints(scenario, arguments.joints);
  return use(scenario, other_draws(scenario, arguments, catalog));
}

/// Runs a scenario and its draws, and writes the folder. Returns the exit code.
int run_into(RunFolder& folder, const Scenario& scenario, const RunArguments& arguments, std::span<const Scenario> draws) {
  constexpr std::size_t kMostDraws = 40;  // rows of the table of draws
  Simulation simulation({&scenario, 1}, Loads::recorded);
  if (!arguments.quiet) note_rows(scenario, simulation);
  const RowsNeeded rows = simulation.rows_needed(0);
  note_time(scenario, arguments, rows);

  const StopOnSignal stop(StopOnSignal::Second::is_ignored);
  const auto start = std::chrono::steady_clock::now();
  std::optional<Outcome> early = simulate(simulation, arguments.quiet);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;

  Recording recording = simulation.take_recording(0);
  if (early) recording.outcome = std::move(*early);
  std::optional<AllRows> all;
  try {
    all = thin_rows(recording);
  } catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch): the rows stay as they are
  }
  const Scenario seen = with_row_stride(scenario, all ? all->stride : 1);
  if (!arguments.quiet) note_row_stride(seen, all ? all->stride : 1);
  RunWriter files(folder.path(), [](const std::string& why) { say("gaitlab", "error", why); });
  const auto judge = [&] {
    Judgement of{report::summarise(seen, recording, wall.count()), report::overlaps(seen, recording), {}};
    of.verdict = report::verdict(seen, recording, of.summary, of.overlaps);
    return of;
  };
  std::optional<Judgement> made;  // kept, because the memory of a failed trace.h5 may not be freed
  try {
    made = judge();
  } catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch): the trace is written first, then the run is judged
  } catch (const PluginError&) {     // NOLINT(bugprone-empty-catch)
  }
  if (const auto again = made ? more_accurate(scenario, recording, made->verdict, rows, arguments) : std::nullopt) {
    recording = {};
    all.reset();
    return with_scenario(*again, [&](const Scenario& finer, const std::vector<Scenario>& others) {
      return run_into(folder, finer, *again, others);
    });
  }
  if (made) take_spread(scenario, recording, *made, arguments.quiet);
  const bool complete = made ? take_draws(scenario, draws, arguments, recording, *made) : draws.empty();
  if (all) all->swap(recording);
  files.write_run(arguments.format, scenario, recording);
  if (all) all->swap(recording);
  all.reset();
  Judgement run = made ? std::move(*made) : judge();
  const report::Summary& summary = run.summary;
  report::Verdict& verdict = run.verdict;
  if (files.lost_any()) files.write_text("summary.json", [&] { return report::to_json(summary, scenario, recording); });
  if (recording.spread.rows() > 0 || recording.draws.rows() > 0)
    verdict = report::verdict(seen, recording, summary, run.overlaps);
  take_word_without_friction(seen, verdict, arguments.quiet);
  if (arguments.shown.demand) take_demand(seen, recording, summary, verdict, arguments.quiet);
  files.write_report(seen, recording, summary, verdict, !arguments.no_page);
  if (files.wrote_any()) folder.keep();
  if (!arguments.quiet) print_summary(scenario, recording, summary, verdict, arguments.shown);
  if (!arguments.quiet && !arguments.file.empty()) print_retry(arguments, verdict);
  if (!arguments.quiet && !verdict.draws.empty()) {
    fmt::print("{}", report::texts::without_nan(
                         report::draws_table(verdict.draws, arguments.shown.verbose ? verdict.draws.size() : kMostDraws)));
  }
  const bool interrupted = recording.outcome.ended == Ended::interrupted;
  const Remedied remedied = interrupted ? Remedied() : take_remedy(scenario, verdict, arguments);
  if (!remedied.json.empty()) {
    files.write_text(kRemedyFile, [&] { return remedied.json; });
    files.write_report(seen, recording, summary, verdict, !arguments.no_page);
  }
  if (!arguments.quiet) print_lines(remedied.lines);
  if (!arguments.quiet && arguments.names_files && !files.lost_any()) print_files(arguments, folder.path());
  warn_of_run(scenario, recording, verdict);
  const bool sound = report::not_finite(scenario, recording).empty();
  if (recording.outcome.done())
    return files.lost_any() || !sound || !complete || !remedied.complete ? 1 : exit_code(verdict, arguments.shown);
  say(scenario.file, "error",
      fmt::format("{}; the rows up to that time are in {}", recording.outcome.message, folder.path().string()));
  return 1;
}

}  // namespace

int run(const RunArguments& arguments) {
  return with_scenario(
      arguments, [&](const Scenario& scenario, const std::vector<Scenario>& draws) { return run(scenario, arguments, draws); });
}

int run(const Scenario& scenario, const RunArguments& arguments, std::span<const Scenario> draws) {
  warn_of_start(scenario, arguments.quiet);  // printed first, because wrong units may be the reason why a step is refused
  RunFolder folder(arguments.out, scenario.name);
  return run_into(folder, scenario, arguments, draws);
}

void add_run(Commands& commands) {
  add_command<RunArguments>(
      commands, "run", "Simulate a scenario, write a run folder and print the summary.", run,
      [](CLI::App& command, RunArguments& arguments) {
        add_scenario(command, arguments);
        command.add_option("--out", arguments.out, "run folder (default runs/NAME, then NAME-2 ...); new or empty");
        command.add_option("--plugin", arguments.libraries, "plugin library that is not beside the scenario; may be repeated")
            ->expected(1)
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        command.add_option("--format", arguments.format, "format of the trace: h5 (default) or csv")
            ->check(CLI::IsMember({"h5", "csv"}));
        command.add_flag("--no-report", arguments.no_page, "write no report.html");
        add_joint(command, arguments.joints);
        command
            .add_option("--draws", arguments.draws,
                        "number of seeds with which the gait is judged, beginning with the scenario's; each draws another "
                        "robot within its tolerances and other noise for its sensors")
            ->check(CLI::Range(1, 10000));
        command.add_option("-j,--jobs", arguments.jobs, "threads for the draws and the remedy (default 1)")
            ->check(CLI::Range(1, kMostThreads));
        command.add_flag("--no-retry", arguments.no_retry,
                         "do not simulate again if a run is `not judged` only because it is inaccurate; by default it is "
                         "repeated, more accurately, if that takes less than 10 s");
        command.add_flag("--remedy", arguments.remedy,
                         "also search the settings that would make the gait feasible (gaitlab remedy)");
        add_shown(command, arguments.shown);
      });
}

}  // namespace gaitlab::app
