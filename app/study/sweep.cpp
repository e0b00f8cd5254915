// Many runs of a scenario: a map of its parameters, in a journal that survives whatever ends the program.
#include <fmt/format.h>

#include <algorithm>

#include "app/commands.h"
#include "app/study/own_gait.h"
#include "app/study/study_quantities.h"
#include "app/study/study_run.h"
#include "app/study/study_text.h"
#include "app/study/sweep_arguments.h"
#include "core/errors.h"
#include "core/settings/wording.h"
#include "studies/run/answers.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;
using studies::Journal;
using studies::Plan;
using studies::Study;

int sweep_study(const SweepArguments& a) {
  refuse_copies("gaitlab sweep");
  Catalog catalog = standard_catalog();
  Study study = wanted_study(a);
  const studies::Shard shard = wanted_shard(a);
  if (study.name.empty()) study.name = read_scenario(study.scenario, study.sets, catalog).name;
  Plan plan(std::move(study), quantity_offer(), catalog);
  if (a.dry_run) {
    print_notes(plan, a.quiet);
    print_plan(plan, a);
    return 0;
  }
  // Before the folder, which belongs to one process.
  const studies::Executor executor = study_executor(plan, a);
  print_notes(plan, a.quiet);  // one process of several comes here
  studies::JournalHead head = study_head(plan);
  std::vector<studies::Answers> answers = other_answers(plan, a, head.build);
  std::uint64_t answered = 0;
  const StopOnSignal stop(StopOnSignal::Second::ends_the_process);  // before there is a folder
  const fs::path folder = studies::study_folder(a.out, "sweep-" + plan.study().name, holds_study(head));
  head.command = goes_on(a, folder);
  const fs::path file = journal_file(folder, shard);
  std::error_code none;
  if (!shard.whole()) fs::create_directory(folder / "shards", none);
  fs::path lock_file = file;
  const studies::Lock lock(shard.whole() ? folder / "lock" : lock_file.replace_extension("lock"));
  const bool begins = !fs::exists(file, none);  // a plugin that crashes in the own gait ends the first start alone
  Journal journal(file, head, taken_build(a));
  keep_runs(plan, journal, folder, a.quiet);
  if (begins && shard.index == 0) print_own_gait(plan, a.quiet);

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
    fmt::print("{} of {} were answered by other studies\n", answered, counted(standing.ended - standing.before, "run"));
  if (!standing.whole()) {
    say(fmt::format("{}: interrupted: {} of {} runs are in the journal; go on with\n{}\n", folder.string(), standing.ended,
                    standing.wanted, goes_on(a, folder)));
    return 1;
  }
  const bool all_failed = standing.wanted > 0 && standing.failed == standing.wanted;
  if (!shard.whole()) {
    if (!a.quiet)
      fmt::print("{}: {} runs ended; when all shards have, gaitlab study merge {}\n", file.string(), standing.ended,
                 shell_word(folder.string()));
    return all_failed ? 1 : 0;
  }
  const studies::Results results = studies::results(journal);
  const std::vector<std::string> files = write_study_files(journal, results, folder);
  if (!a.quiet) {
    constexpr std::size_t kShown = 5;
    fmt::print("{}", study_summary(journal, results, folder, kShown));
    fmt::print("files in {}: {}, {}\n", folder.string(), studies::kJournalFile, fmt::join(files, ", "));
  }
  if (all_failed) say(fmt::format("{}: error: none of the {} runs came to its end\n", folder.string(), standing.wanted));
  return all_failed ? 1 : 0;
}

void repeatable(CLI::Option* option) {
  option->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

void add_sweep(Commands& commands) {
  add_command<SweepArguments>(
      commands, "sweep", "Run a scenario at many points: a journal, a table and a map.", sweep_study,
      [](CLI::App& command, SweepArguments& a) {
        add_scenario(command, a);
        command.get_option("SCENARIO")->description("scenario file, or the file of a study (YAML)");
        command.get_option("--seed")->description("seed of what is drawn (default 1)");
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
            "quantities to show and draw, by name with * and ?; the first orders the points of a scenario; may be repeated"));
        command.add_option("--shard", a.shard,
                           "do one part of the runs, I/N, or auto in a Slurm array; then `gaitlab study merge`");
        command.add_flag("--dry-run", a.dry_run, "tell what would be run and how long it takes, and write nothing");
        add_study_run(command, a, "runs/sweep-NAME");
      });
}

}  // namespace gaitlab::app
