// `gaitlab sweep`, which runs a scenario at many points of its parameters. The journal survives any end of the program.
#include <fmt/format.h>

#include <algorithm>

#include "app/shell/commands.h"
#include "app/study/own_gait.h"
#include "app/study/quantity_text.h"
#include "app/study/study_progress.h"
#include "app/study/study_quantities.h"
#include "app/study/study_run.h"
#include "app/study/study_text.h"
#include "app/study/sweep_arguments.h"
#include "core/errors.h"
#include "core/settings/shell_word.h"
#include "core/settings/wording.h"
#include "studies/run/again.h"
#include "studies/run/answers.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;
using studies::Journal;
using studies::Plan;
using studies::Study;

/// If the torque errors of the drawn runs are not small enough, repeats all other runs with an estimate. Returns false if the
/// program was stopped.
bool estimate_others(const Plan& plan, Journal& journal, const studies::Executor& executor, const SweepArguments& a) {
  const std::vector<std::uint64_t> runs = runs_in_doubt(plan, journal);
  if (runs.empty()) return true;
  if (!a.quiet) {
    const studies::Estimated found = studies::estimated(journal);
    const std::string why = found.too_few()
                                ? fmt::format("was estimated for fewer than {} runs", studies::Estimated::kFewest)
                                : fmt::format("is beyond {:.3g} % in more than one of ten estimated runs", 100 * found.most);
    say(journal.file().string(), "note",
        fmt::format("the torque error {}: the other {} again with an estimate", why,
                    runs.size() == 1 ? "run is made" : fmt::format("{} runs are made", runs.size())));
  }
  return estimate_again(plan, journal, runs, executor, AgainProgress(a.quiet, "estimates"), stopped());
}

/// Runs those points of the shard that are not in the journal. Prints the number of runs that were taken from other studies.
studies::Standing run_points(const Plan& plan, Journal& journal, const studies::Executor& executor,
                             std::vector<studies::Answers>& answers, const studies::Shard& shard, const SweepArguments& a) {
  std::uint64_t answered = 0;
  studies::Standing standing;
  {
    StudyProgress progress(a.quiet, objective_unit(journal.head()));
    studies::Runner runner(plan, journal,
                           {.executor = remembering(executor, answers, &answered),
                            .shard = shard,
                            .jobs = study_threads(a.jobs),
                            .told = std::ref(progress)});
    runner.run(plan.points().runs(), stopped());
    standing = runner.standing();
  }
  if (!a.quiet && !answers.empty())
    fmt::print("{} of {} were taken from other studies\n", answered, counted(standing.ended - standing.before, "run"));
  return standing;
}

/// Writes and prints the results of a complete sweep.
void write_results(Journal& journal, const fs::path& folder, bool quiet) {
  const studies::Results results = studies::results(journal);
  const std::vector<std::string> files = write_study_files(journal, results, folder);
  if (quiet) return;
  constexpr std::size_t kShown = 5;
  fmt::print("{}", study_summary(journal, results, folder, kShown));
  fmt::print("files in {}: {}, {}\n", folder.string(), studies::kJournalFile, fmt::join(files, ", "));
}

/// Prints how a sweep ended and writes the files of a complete one. Returns the exit code.
int end_sweep(Journal& journal, const studies::Standing& standing, const studies::Shard& shard, const fs::path& folder,
              const fs::path& file, bool quiet) {
  const bool all_failed = standing.wanted > 0 && standing.failed == standing.wanted;
  if (!shard.whole()) {
    if (!quiet) {
      fmt::print("{}: {} runs ended; when all shards have ended, merge them: gaitlab study merge {}\n", file.string(),
                 standing.ended, shell_word(folder.string()));
    }
    return all_failed ? 1 : 0;
  }
  write_results(journal, folder, quiet);
  if (all_failed) say(fmt::format("{}: error: none of the {} runs came to its end\n", folder.string(), standing.wanted));
  return all_failed ? 1 : 0;
}

int print_dry_run(const Plan& plan, const SweepArguments& a) {
  print_notes(plan, a.quiet);
  note_engine(plan, a, a.quiet);
  print_plan(plan, a);
  return 0;
}

int sweep_study(const SweepArguments& a) {
  refuse_copies("gaitlab sweep");
  Catalog catalog = standard_catalog();
  Study study = wanted_study(a);
  const studies::Shard shard = wanted_shard(a);
  if (study.name.empty()) study.name = read_scenario(study.scenario, study.sets, catalog).name;
  Plan plan(std::move(study), quantity_offer(), catalog);
  if (a.dry_run) return print_dry_run(plan, a);
  // The executor is made before the folder is locked, because only one process may lock the folder.
  const studies::Executor executor = study_executor(plan, a);
  print_notes(plan, a.quiet);  // only one process of a team reaches this line
  studies::JournalHead head = study_head(plan);
  std::vector<studies::Answers> answers = other_answers(plan, a, head.build);
  const StopOnSignal stop(StopOnSignal::Second::ends_the_process);  // installed before the folder is created
  const fs::path folder = studies::study_folder(a.out, "sweep-" + plan.study().name, holds_study(head));
  head.command = goes_on(a, folder);
  const fs::path file = journal_file(folder, shard);
  std::error_code none;
  if (!shard.whole()) fs::create_directory(folder / "shards", none);
  fs::path lock_file = file;
  const studies::Lock lock(shard.whole() ? folder / "lock" : lock_file.replace_extension("lock"));
  // The trial runs are made only at the first start, so that a plugin that crashes in them does not prevent a continuation.
  const bool begins = !fs::exists(file, none);
  Journal journal(file, head, taken_build(a));
  write_heights(plan, folder);
  keep_runs(plan, journal, folder, a.quiet);
  if (begins && shard.index == 0) {
    note_engine(plan, a, a.quiet);
    print_own_gait(plan, a.quiet);
  }

  const studies::Standing standing = run_points(plan, journal, executor, answers, shard, a);
  const bool whole = standing.whole() && (!shard.whole() || estimate_others(plan, journal, executor, a));
  if (!whole) {
    say(fmt::format("{}: interrupted: {} of {} runs are in the journal; continue with\n{}\n", folder.string(), standing.ended,
                    standing.wanted, goes_on(a, folder)));
    return 1;
  }
  return end_sweep(journal, standing, shard, folder, file, a.quiet);
}

void repeatable(CLI::Option* option) {
  option->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

void add_sweep(Commands& commands) {
  add_command<SweepArguments>(
      commands, "sweep", "Run a scenario at many points, and write a journal, a table and a map.", sweep_study,
      [](CLI::App& command, SweepArguments& a) {
        add_scenario(command, a);
        offering(command.get_option("SCENARIO"), "file of a scenario or study (YAML), or a name of {} or {}",
                 {.kinds = {"scenarios", "studies"}});
        command.get_option("--seed")->description("seed of the random draws (default 1)");
        repeatable(
            command.add_option("--grid", a.grids, "values of a key, KEY=A:B:N, KEY=log:A:B:N or KEY=v,v,v; may be repeated"));
        repeatable(command.add_option("--random", a.randoms,
                                      "a key that is drawn, KEY=A:B, KEY=log:A:B or KEY=v,v,v; may be repeated"));
        command.add_option("--runs", a.runs, "number of runs of --random")->check(CLI::Range(1, 1000000000));
        command.add_flag("--sobol", a.sobol, "draw evenly, by a Sobol sequence");
        command.add_option("--seeds", a.replicates, "runs of each point, which differ in their seed")
            ->check(CLI::Range(1, 1000000));
        repeatable(command.add_option(
            "--show,--figure", a.quantities,
            "quantities to show and draw, by name with * and ?; for a scenario file, the first one orders the points; "
            "may be repeated"));
        command.add_option("--shard", a.shard,
                           "simulate only part I of N of the runs, I/N, or auto in a Slurm array; then `gaitlab study merge`");
        command.add_flag("--dry-run", a.dry_run, "print the runs and the time that they take, and write nothing");
        add_study_run(command, a, "runs/sweep-NAME");
      });
}

}  // namespace gaitlab::app
