// `gaitlab optimize`, which searches for the best point of a study and verifies it with half the step, in another engine, and
// in worlds.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>

#include "app/shell/commands.h"
#include "app/study/asking.h"
#include "app/study/optimize_seeds.h"
#include "app/study/own_gait.h"
#include "app/study/quantity_text.h"
#include "app/study/study_progress.h"
#include "app/study/study_quantities.h"
#include "app/study/study_run.h"
#include "app/study/study_text.h"
#include "app/study/verification_text.h"
#include "core/errors.h"
#include "core/files/file_kind.h"
#include "core/settings/shell_word.h"
#include "core/settings/wording.h"
#include "studies/search/candidates.h"
#include "studies/search/optimizer.h"
#include "studies/search/verify.h"
#include "studies/search/world_trials.h"
#include "studies/study/study_file.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;
using studies::Journal;
using studies::Plan;
using studies::SearchEnd;
using studies::Study;

struct OptimizeArguments : StudyRunArguments {
  std::string file, method;
  std::vector<std::string> sets;
  std::int64_t runs = 0, seed = -1, seeds = 0;
  bool quiet = false, dry_run = false;
  bool ask = false;    ///< true if another program simulates the points
  bool noted = false;  ///< true if the notes on the study have been printed, for another seed
};

Study searched_study(const OptimizeArguments& a) {
  if (!studies::is_study(a.file)) {
    expect_kind(a.file, FileKind::study);
    throw InputError(SourceLocation{a.file},
                     "is not the file of a study; expected one with gaitlab_study: 1 (gaitlab explain "
                     "study)");
  }
  Study study = studies::read_study(a.file, studies::Purpose::optimize);
  if (!a.method.empty()) study.method = named<studies::Method>(a.method).value();
  if (!studies::is_search(study.method) && !a.method.empty())
    study.starts.clear();  // a method that is compared with a search has no start points
  if (a.runs > 0) study.runs = a.runs;
  if (a.runs > 0 || !a.method.empty()) study.place = SourceLocation{a.runs > 0 ? "--runs" : "--method"};
  if (a.seed >= 0) study.seed = a.seed;
  study.told = a.ask;
  add_sets(study, a.sets);
  Problems problems;
  check_study(study, problems);
  problems.raise();
  return study;
}

/// Names of all methods except grids and designs of sensitivity studies.
std::vector<std::string> known_methods() {
  using studies::Method;
  std::vector<std::string> names;
  for (const auto& row : enum_table<Method>()) {
    if (row.searches || row.value == Method::random || row.value == Method::sobol) names.emplace_back(row.text);
  }
  return names;
}

std::string search_goes_on(const OptimizeArguments& a, const fs::path& folder) {
  std::string line = "gaitlab optimize " + shell_word(told_path(a.file));
  if (!a.method.empty()) line += " --method " + a.method;
  if (a.runs > 0) line += fmt::format(" --runs {}", a.runs);
  if (a.seed >= 0) line += fmt::format(" --seed {}", a.seed);
  if (a.ask) line += " --ask";
  if (a.seeds > 0) line += fmt::format(" --seeds {}", a.seeds);
  line += set_words(a.sets);
  for (const std::string& answers : a.answers) line += " --answers " + shell_word(told_path(answers));
  return line + " --out " + shell_word(told_path(folder.string()));
}

/// Executes the runs of the study: those that the search requests or, if the method is not a search, those of all points.
SearchEnd run_study(Plan& plan, Journal& journal, const studies::Executor& executor, const OptimizeArguments& a) {
  StudyProgress progress(a.quiet, objective_unit(journal.head()));
  studies::RunnerSettings settings{
      .executor = executor, .shard = {}, .jobs = study_threads(a.jobs), .told = std::ref(progress)};
  if (studies::is_search(plan.study().method))
    return run_searches(plan, journal, std::move(settings), std::ref(progress), stopped());
  studies::Runner runner(plan, journal, std::move(settings));
  return runner.run(plan.points().runs(), stopped()) ? SearchEnd::budget : SearchEnd::stopped;
}

/// Writes the run folder of the best verified point, and replaces an earlier one by it. Returns false if the run was
/// interrupted or a file could not be written; the earlier folder then stays.
[[nodiscard]] bool write_best(const Plan& plan, std::uint64_t run_number, const fs::path& folder, bool quiet) {
  const fs::path next = folder.string() + ".next", before = folder.string() + ".before";
  std::error_code none, error;
  if (!fs::exists(folder, none)) fs::rename(before, folder, none);  // left by a process that was killed between two renames
  fs::remove_all(before, none);
  fs::remove_all(next, none);
  RunArguments arguments;
  arguments.out = next.string();
  arguments.quiet = quiet;
  arguments.names_files = false;  // the files are renamed afterwards
  const int code = run(plan.scenario(run_number), arguments);
  if (code != 0 || stopped()) {
    fs::remove_all(next, none);
    if (!stopped())
      say(folder.string(), "error", "not written, because a file of the run is missing; an earlier folder is kept");
    return false;
  }
  fs::rename(folder, before, none);
  fs::rename(next, folder, error);
  if (error) {
    fs::rename(before, folder, none);
    throw RunError(fmt::format("{}: cannot be written: {}", folder.string(), error.message()));
  }
  fs::remove_all(before, none);
  if (!quiet) print_page(folder / kPageFile);
  return true;
}

/// Runs points again, and then runs in worlds those that stand. Returns nothing if interrupted.
std::optional<std::vector<studies::Verification>> verify_points(const Plan& plan, Journal& journal,
                                                                const studies::Results& results,
                                                                const std::vector<std::size_t>& points, const std::string& what,
                                                                const studies::Executor& executor, bool quiet) {
  auto tried = verify(plan, journal, results, points, executor, AgainProgress(quiet, "verification of " + what), stopped());
  if (!tried || !plan.study().verify.worlds) return tried;
  return in_worlds(plan, journal, results, *tried, executor, AgainProgress(quiet, "points that stand, in worlds"), stopped());
}

/// Verifies the best points, in rounds until one stands or four rounds have ended, and writes the results. Nothing if
/// interrupted.
std::optional<std::vector<studies::Verification>> verify_best(const Plan& plan, Journal& journal,
                                                              const studies::Results& results,
                                                              const studies::Executor& executor, bool quiet) {
  constexpr int kRounds = 4;
  std::vector<studies::Verification> all;
  std::vector<std::size_t> tried;
  for (int round = 0; round < kRounds && studies::verified(all).empty(); ++round) {
    const std::vector<std::size_t> points = candidates(plan, results, tried);
    if (points.empty()) break;
    const std::string number = points.size() == 1 ? "point" : fmt::format("{} points", points.size());
    const auto found =
        verify_points(plan, journal, results, points, (round == 0 ? "the best " : "the next best ") + number, executor, quiet);
    if (!found) return {};
    tried.insert(tried.end(), points.begin(), points.end());
    all.insert(all.end(), found->begin(), found->end());
  }
  all = ranked_by_share(all, plan.study().objectives.front().maximize);
  journal.write(all);
  return all;
}

/// States on stderr why no point is verified.
void say_none(Journal& journal, bool tried, const std::string& folder) {
  const std::string show = "`gaitlab study show " + shell_word(folder) + "`";
  if (!tried) return say(fmt::format("{}: no point is kept; {} says which limits most runs break\n", folder, show));
  const std::string nearest = nearest_text(journal);
  say(fmt::format("{}: none of the best points was verified; {}\n", folder,
                  nearest.empty() ? show + " says why. `verify: {best: N}` tries more, --seed N searches elsewhere" : nearest));
}

/// Prints the result of a search, and simulates the best verified point again for its run folder. Returns the exit code.
int finish_search(const Plan& plan, Journal& journal, const studies::Results& results,
                  const std::vector<studies::Verification>& tried, const fs::path& folder, SearchEnd end, bool quiet) {
  const std::vector<std::uint64_t> stood = studies::verified(tried);
  std::vector<std::string> files = write_study_files(journal, results, folder);
  if (!quiet) {
    constexpr std::size_t kShown = 5;
    fmt::print("{}", study_summary(journal, results, folder, kShown));
    if (end == SearchEnd::converged) fmt::print("all searches have converged before the budget was used\n");
  }
  if (!stood.empty()) {
    if (!quiet) fmt::print("\nrun {}, the best verified point, with its trace and page:\n", stood.front());
    if (!write_best(plan, stood.front(), folder / "best", quiet)) return 1;
    files.emplace_back("best");
  }
  if (!quiet) fmt::print("files in {}: {}, {}\n", folder.string(), studies::kJournalFile, fmt::join(files, ", "));
  if (!stood.empty() || stopped()) return 0;
  if (end == SearchEnd::refused) {
    say(fmt::format("{}: the search has ended, because the scenario refused all {} points of the first block: {}\n",
                    folder.string(), results.points.size(), results.failures.by_outcome.at("refused").message));
  } else {
    say_none(journal, !tried.empty(), folder.string());
  }
  return 3;
}

/// Simulates the winner with each joint dead in turn if the study requests it. Returns false if interrupted.
bool add_faults(const Plan& plan, Journal& journal, const studies::Results& results,
                const std::vector<studies::Verification>& tried, const studies::Executor& executor, bool quiet) {
  const std::vector<std::uint64_t> stood = studies::verified(tried);
  if (plan.study().verify.faults == studies::VerifyFaults::none || stood.empty()) return true;
  const auto winner = std::ranges::find(results.points, stood.front(), &studies::PointResult::first_run);
  const auto dead =
      with_dead_joints(plan, journal, *winner, executor, AgainProgress(quiet, "winner with a dead joint"), stopped());
  if (!dead) return false;
  std::vector<studies::Verification> all = tried;
  all.insert(all.end(), dead->begin(), dead->end());
  journal.write(all);
  return true;
}

/// Checks that another program can supply the results of this study.
void prepare_asking(const Plan& plan, const OptimizeArguments& a) {
  std::signal(SIGPIPE, SIG_IGN);  // the failed write reports the closed output instead
  if (team()) throw InputError(SourceLocation{"--ask"}, "is not for gaitlab-mpi; expected gaitlab");
  if (const std::uint64_t runs = plan.points().runs_of_point(); runs > 1) {
    throw InputError(SourceLocation{a.file},
                     fmt::format("has {} runs per point (replicates, scenarios or worlds); expected 1 with --ask, because the "
                                 "other program gives one result per point",
                                 runs));
  }
}

/// Writes the files of a search whose points another program simulated. Returns the exit code.
int finish_asked(const Plan& plan, Journal& journal, const fs::path& folder, SearchEnd end, const Lines& lines, bool quiet) {
  const studies::Results results = studies::results(journal);
  const std::vector<std::string> files = write_study_files(journal, results, folder);
  if (quiet) return 0;
  say(study_summary(journal, results, folder, 5));
  if (end == SearchEnd::converged) say("all searches have converged before the budget was used\n");
  if (end == SearchEnd::stopped) {
    say(fmt::format("the {} before the budget of {}; continue with\n{}\n",
                    lines.output_closed() ? "reader of the points has closed the output" : "results ended", plan.most_runs(),
                    journal.head().command));
  }
  say(fmt::format("files in {}: {}, {}\n", folder.string(), studies::kJournalFile, fmt::join(files, ", ")));
  return 0;
}

int optimize_once(const OptimizeArguments& a) {
  refuse_copies("gaitlab optimize");
  Catalog catalog = standard_catalog();
  Plan plan(searched_study(a), quantity_offer(), catalog);
  if (a.dry_run) {
    print_notes(plan, a.quiet);
    note_engine(plan, a, a.quiet);
    print_plan(plan, a);
    return 0;
  }
  Lines lines(Lines::Until::output_is_closed);
  if (a.ask) prepare_asking(plan, a);
  // The executor is made before the folder is locked, because only one process may lock the folder.
  const studies::Executor executor = a.ask ? asking_executor(plan, lines) : study_executor(plan, a);
  print_notes(plan, a.quiet || a.noted);  // only one process of a team reaches this line
  studies::JournalHead head = study_head(plan);
  std::vector<studies::Answers> answers = other_answers(plan, a, head.build);
  const StopOnSignal stop(StopOnSignal::Second::ends_the_process);  // installed before the folder is created
  const fs::path folder = studies::study_folder(a.out, "optimize-" + plan.study().name, holds_study(head));
  head.command = search_goes_on(a, folder);
  const studies::Lock lock(folder / "lock");
  std::error_code none;
  const bool begins = !std::filesystem::exists(folder / studies::kJournalFile, none);
  Journal journal(folder / studies::kJournalFile, head, taken_build(a));
  write_heights(plan, folder);
  keep_runs(plan, journal, folder, a.quiet);
  if (begins && !a.ask) {
    note_engine(plan, a, a.quiet || a.noted);
    print_own_gait(plan, a.quiet || a.noted);
  }

  const SearchEnd end = run_study(plan, journal, remembering(executor, answers), a);
  const auto interrupted = [&] {
    say(fmt::format("{}: interrupted: {} of {} runs are in the journal; continue with\n{}\n", folder.string(), journal.rows(),
                    plan.most_runs(), head.command));
    return 1;
  };
  if (a.ask && (end != SearchEnd::stopped || lines.ended() || lines.output_closed()))
    return finish_asked(plan, journal, folder, end, lines, a.quiet);
  if (end == SearchEnd::stopped) return interrupted();
  const studies::Results results = studies::results(journal);
  const auto tried = verify_best(plan, journal, results, executor, a.quiet);
  if (!tried) return interrupted();
  if (!add_faults(plan, journal, results, *tried, executor, a.quiet)) return interrupted();
  const int code = finish_search(plan, journal, results, *tried, folder, end, a.quiet);
  return stopped() ? interrupted() : code;
}

/// Searches with several seeds, each in a separate folder.
int optimize_seeds(const OptimizeArguments& a) {
  if (team())
    throw InputError(SourceLocation{"--seeds"}, "is not for gaitlab-mpi; expected one search per seed, with --seed N");
  Catalog catalog = standard_catalog();
  const Plan plan(searched_study(a), quantity_offer(), catalog);
  const std::int64_t first = plan.study().seed;
  if (a.dry_run) {
    fmt::print("{} searches, with seeds {} to {}; each:\n", a.seeds, first, first + a.seeds - 1);
    print_notes(plan, a.quiet);
    print_plan(plan, a);
    return 0;
  }
  const studies::JournalHead head = study_head(plan);
  SeedSearches searches{
      first, a.seeds, seeds_folder(a.out, "optimize-" + plan.study().name + "-seeds", first, holds_study(head)),
      "",    a.quiet, {}};
  searches.command = search_goes_on(a, searches.folder);
  searches.search = [&](std::int64_t seed, const fs::path& folder) {
    OptimizeArguments one = a;
    one.seed = seed;
    one.seeds = 0;
    one.noted = seed > first;
    one.out = folder.string();
    return optimize_once(one);
  };
  return search_seeds(searches);
}

int optimize_study(const OptimizeArguments& a) { return a.seeds > 0 ? optimize_seeds(a) : optimize_once(a); }

}  // namespace

void add_optimize(Commands& commands) {
  add_command<OptimizeArguments>(
      commands, "optimize", "Search the best point of a study, and verify it.", optimize_study,
      [](CLI::App& command, OptimizeArguments& a) {
        offering(command.add_option("STUDY", a.file), "the file of a study (YAML), or a name of {}", {.kinds = {"studies"}})
            ->required()
            ->check(not_empty)
            ->transform(named_file);
        command.add_option("--runs", a.runs, "budget, instead of the file's")->check(CLI::Range(1, 1000000000));
        command.add_option("--seed", a.seed, "seed, instead of the file's")
            ->check(CLI::Range(std::int64_t{0}, std::int64_t{999999999999999}));
        command
            .add_option(
                "--seeds", a.seeds,
                "run N searches, with seeds from --seed on, in folders seed-N, and print the median and the spread of their "
                "best values")
            ->check(CLI::Range(2, 99));
        command
            .add_option("--method", a.method,
                        "method, instead of the file's; `random` draws points, for comparison with a search")
            ->check(CLI::IsMember(known_methods()));
        add_study_sets(command, a.sets);
        command.add_flag("--dry-run", a.dry_run, "print the runs and the time that they take, and write nothing");
        add_study_run(command, a, "runs/optimize-NAME");
        CLI::Option* ask = command.add_flag(
            "--ask", a.ask, "print the points as lines of JSON, and read their results, instead of simulating them");
        for (const char* of_runs : {"--jobs", "--lanes", "--answers", "--dry-run", "--seeds"}) ask->excludes(of_runs);
        command.add_flag("--quiet", a.quiet, "print no progress and no summary");
      });
}

}  // namespace gaitlab::app
