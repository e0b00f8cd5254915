// `gaitlab study`, commands on the folder of a study: show, best, export, merge, rerun.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/shell/commands.h"
#include "app/study/study_quantities.h"
#include "app/study/study_text.h"
#include "core/settings/shell_word.h"
#include "core/settings/wording.h"
#include "kit/stored_scenario.h"
#include "studies/journal/study_folder.h"
#include "studies/plan/definition.h"
#include "studies/plan/worlds.h"
#include "studies/study/followers.h"
#include "studies/study/number.h"
#include "studies/study/scenarios.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;
using studies::Journal;

struct StudyArguments {
  std::string folder;
  std::int64_t most = 10;          ///< number of points that `best` lists
  std::string format, file;        ///< arguments of `export`
  std::int64_t run = 0;            ///< number of the run that `rerun` repeats
  std::optional<std::string> out;  ///< folder that `rerun` writes
  PluginArguments plugins;         ///< plugins that `rerun` may load
};

/// Opens the journal of a folder for reading.
Journal opened(const std::string& folder) {
  const fs::path file = fs::path(folder) / studies::kJournalFile;
  std::error_code none;
  if (!fs::exists(file, none)) {
    const bool shards = studies::shards_in(folder).count > 0;
    throw InputError(SourceLocation{folder},
                     std::string("holds no study: there is no ") + studies::kJournalFile +
                         (shards ? "; merge its shards first: gaitlab study merge " + shell_word(folder) : ""));
  }
  return Journal(file);
}

int show_study(const StudyArguments& a) {
  Journal journal = opened(a.folder);
  const studies::Results results = studies::results(journal);
  constexpr std::size_t kShown = 5;
  fmt::print("{}", study_summary(journal, results, a.folder, kShown));
  if (const studies::Effort effort = journal.effort(); effort.runs > 0 && effort.wall > 0 && !journal.head().told)
    fmt::print("{:.3g} runs per s and thread\n", static_cast<double>(effort.runs) / effort.wall);
  const std::string who = studies::Lock::holder(fs::path(a.folder) / "lock");
  if (!who.empty()) {
    fmt::print("{} is writing this study\n", who);
  } else if (results.runs < journal.head().runs) {
    fmt::print("continue with: {}\n", one_line(journal.head().command));
  }
  return 0;
}

int report_study(const StudyArguments& a) {
  Journal journal = opened(a.folder);
  const std::vector<std::string> files = write_study_files(journal, studies::results(journal), a.folder);
  fmt::print("files in {}: {}\n", a.folder, fmt::join(files, ", "));
  return 0;
}

int best_of_study(const StudyArguments& a) {
  Journal journal = opened(a.folder);
  const studies::Results results = studies::results(journal);
  const std::vector<studies::JournalObjective>& objectives = journal.head().objectives;
  std::vector<std::size_t> order = objectives.size() > 1 ? studies::front(results.points, objectives)
                                                         : studies::ranked(results.points, objectives.front().maximize);
  std::erase_if(order, [&](std::size_t k) { return !results.points[k].kept(); });
  if (order.empty()) {
    say(a.folder + ": no point is kept\n");
    return 3;
  }
  fmt::print("{}", points_table(journal, results, order, static_cast<std::size_t>(a.most)));
  return 0;
}

int export_study(const StudyArguments& a) {
  Journal journal = opened(a.folder);
  check_new(a.file);
  write_table(journal, a.file, Existing::refused);
  return 0;
}

/// A set of very many numbers, added in ascending order.
class Ranges {
 public:
  /// Adds the numbers `first` to `last`, which must be above all numbers added before.
  void add(std::uint64_t first, std::uint64_t last) {
    count_ += last - first + 1;
    if (!ranges_.empty() && ranges_.back().second + 1 == first) {
      ranges_.back().second = last;
    } else {
      ranges_.emplace_back(first, last);
    }
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Text in the form of Slurm's option --array: 3,17,20-99. At most 200 items.
  [[nodiscard]] std::string text() const {
    constexpr std::size_t kMost = 200;
    std::string all;
    for (std::size_t k = 0; k < std::min(kMost, ranges_.size()); ++k) {
      const auto& [first, last] = ranges_[k];
      all += (k > 0 ? "," : "") + (first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last));
    }
    if (ranges_.size() > kMost)
      all += fmt::format(" (and {}; merge again after these to see them)", counted(ranges_.size() - kMost, "more range"));
    return all;
  }

 private:
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges_;
  std::uint64_t count_ = 0;
};

/// Copies the rows of all shards in the folder into a common journal. Returns the numbers of the shards that are missing or
/// incomplete.
Ranges take_shards(std::optional<Journal>& all, const fs::path& folder, const studies::Shards& shards) {
  std::vector<std::uint64_t> rows;
  for (const std::uint64_t index : shards.indices) {
    Journal part(studies::shard_file(folder, {index, shards.count}));
    if (!all) all.emplace(folder / studies::kJournalFile, part.head(), Journal::Build::same);
    all->take(part);
    all->expect(part.head().runs);  // the budget of a study may have grown
    rows.push_back(part.rows());
  }
  const std::uint64_t runs = all->head().runs;
  Ranges missing;
  std::uint64_t next = 0;  // number of the next shard to check
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::uint64_t index = shards.indices[k];
    if (next < index) missing.add(next, index - 1);
    if (rows[k] < runs / shards.count + (index < runs % shards.count ? 1 : 0)) missing.add(index, index);
    next = index + 1;
  }
  if (next < shards.count) missing.add(next, shards.count - 1);
  return missing;
}

int merge_study(const StudyArguments& a) {
  const fs::path folder = a.folder;
  const fs::path file = folder / studies::kJournalFile;
  const studies::Shards shards = studies::shards_in(folder);
  std::error_code none;
  if (shards.count == 0 && !fs::exists(file, none)) {
    throw InputError(SourceLocation{a.folder},
                     "holds no shards; expected files shards/I-of-N.db, as gaitlab sweep --shard I/N writes them");
  }
  const studies::Lock lock(folder / "lock");
  std::optional<Journal> all;
  Ranges missing;
  if (shards.count > 0) {
    missing = take_shards(all, folder, shards);
  } else {
    all.emplace(file);  // a study without shards, such as an array with one task
  }
  const std::uint64_t rows = all->rows();
  fmt::print("{}: {} of {} runs\n", file.string(), rows, all->head().runs);
  write_study_files(*all, studies::results(*all), folder);
  if (missing.count() > 0) {
    say(a.folder, "error",
        fmt::format("{} of {} shards are missing or incomplete; run them again: --array={}", missing.count(), shards.count,
                    missing.text()));
  }
  const std::uint64_t lacking = shards.count == 0 && rows < all->head().runs ? all->head().runs - rows : 0;
  if (lacking > 0) {
    say(a.folder, "error",
        fmt::format("{} of {} runs have not finished; continue with: {}", lacking, all->head().runs, all->head().command));
  }
  return missing.count() > 0 || lacking > 0 ? 1 : 0;
}

/// Sentences on the differences between a row and the repeated run.
std::vector<std::string> differences(const std::vector<std::string>& names, const std::vector<std::string>& row,
                                     const studies::RunColumns& columns, const std::vector<double>& quantities,
                                     const Outcome& outcome, bool told) {
  std::vector<std::string> found;
  const auto cell = [&](const std::string& name) { return row[studies::place_in(names, name)]; };
  const bool done = cell("outcome") == "done";
  if (done != outcome.done() || (!done && cell("message") != outcome.message))
    found.push_back(fmt::format("outcome: then {}, now {}", clipped(done ? "done" : cell("message")), clipped(outcome.text())));
  if (!done || !outcome.done()) return found;
  const bool known = std::ranges::find(names, studies::kTorqueError) != names.end();
  const bool estimated = !known || !cell(studies::kTorqueError).empty();
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    if (!estimated && depends_on_estimate(columns.quantities[k])) continue;
    const std::string then = cell(columns.quantities[k]);
    if (told && then.empty()) continue;  // the other program did not give this value
    const std::string now = std::isfinite(quantities[k]) ? number_text(quantities[k] + 0.0) : "";
    const bool same = then.empty() ? now.empty() : !now.empty() && studies::number_of(then) == quantities[k];
    if (!same) {
      found.push_back(
          fmt::format("{}: then {}, now {}", columns.quantities[k], then.empty() ? "none" : then, now.empty() ? "none" : now));
    }
  }
  return found;
}

/// Resolved scenario of a row: the only one of the study, or the one whose name is in the row.
std::string scenario_of_row(const studies::JournalHead& head, const std::vector<std::string>& names,
                            const std::vector<std::string>& row) {
  if (head.scenarios.empty()) return head.scenario;
  const std::string& name = row[studies::place_in(names, "scenario")];
  for (studies::ScenarioText& one : studies::scenario_texts(head.scenario)) {
    if (one.name == name) return std::move(one.text);
  }
  throw InputError(SourceLocation{studies::kJournalFile},
                   "is not a journal that this program wrote: it lacks the scenario " + in_quotes(name) + " of a run");
}

/// Settings of a row relative to the scenario in the journal, so that the folder is sufficient to repeat a run.
std::vector<std::string> settings_of_row(const Journal& journal, const std::vector<std::string>& names,
                                         const std::vector<std::string>& row) {
  const studies::JournalHead& head = journal.head();
  std::vector<studies::Parameter> parameters;
  std::vector<std::string> values;
  std::vector<std::string> drawn;
  for (std::size_t k = 0; k < head.parameters.size(); ++k) {
    const studies::JournalParameter& p = head.parameters[k];
    const std::string& value = row[studies::place_in(names, journal.columns().parameters[k])];
    if (p.drawn) {
      drawn.push_back(p.key + "=" + value);
      continue;
    }
    parameters.emplace_back().key = p.key;
    parameters.back().words = p.words;
    values.push_back(value);
  }
  studies::read_followers(parameters, head.definition);
  Problems problems;
  const studies::Followers followers(parameters, problems);
  if (!problems.empty()) {
    throw InputError(SourceLocation{studies::kJournalFile},
                     "is not a journal that this program wrote: " + problems.list().front().text);
  }
  std::vector<std::string> sets;
  for (const auto& [key, value] : followers.settings(values)) sets.push_back(fmt::format("{}={}", key, value));
  sets.insert(sets.end(), drawn.begin(), drawn.end());
  return sets;
}

/// Places the errors of a run's settings in the journal, because they come from its row, and --set was not given.
InputError in_journal(const InputError& error, const StudyArguments& a) {
  std::vector<Problem> problems = error.problems();
  for (Problem& problem : problems) {
    constexpr std::string_view kSet = "--set ";
    if (!problem.place.file.starts_with(kSet)) continue;
    problem.text = fmt::format("run {} has {}: {}", a.run, problem.place.file.substr(kSet.size()), problem.text);
    problem.place = {(fs::path(a.folder) / studies::kJournalFile).string()};
  }
  return InputError(std::move(problems));
}

/// The scenario of a row, with its seed or, in a robust study, in its world.
Scenario scenario_in_row(const Journal& journal, const std::vector<std::string>& row, const StudyArguments& a,
                         Catalog& catalog) try {
  const std::vector<std::string> names = journal.columns().all();
  const studies::JournalHead& head = journal.head();
  std::vector<std::string> sets = settings_of_row(journal, names, row);
  const auto read = [&] {
    return read_stored({(fs::path(a.folder) / studies::kJournalFile).string(), scenario_of_row(head, names, row)}, catalog,
                       OtherPlugins::refused, sets);
  };
  const std::vector<std::string>& worlds = head.worlds;
  const std::uint64_t replicate = studies::run_number_of(row[2]);
  if (worlds.empty()) {
    sets.push_back("seed=" + row[3]);
  } else if (replicate > 0 && replicate <= worlds.size()) {
    for (const studies::World& world : studies::worlds(read())) {
      if (world.name == worlds[replicate - 1]) sets.insert(sets.end(), world.sets.begin(), world.sets.end());
    }
  }
  return read();
} catch (const InputError& error) {
  throw in_journal(error, a);
}

int rerun_study(const StudyArguments& a) {
  Journal journal = opened(a.folder);
  const studies::JournalHead& head = journal.head();
  const std::vector<std::string> row = journal.row(static_cast<std::uint64_t>(a.run));
  if (row.empty()) {
    throw InputError(SourceLocation{"RUN"}, fmt::format("{} is not in the journal of {}; it has {} of {} runs", a.run, a.folder,
                                                        journal.rows(), head.runs));
  }
  const std::vector<std::string> names = journal.columns().all();
  Catalog catalog = careful_catalog(a.plugins);
  const Scenario scenario = scenario_in_row(journal, row, a, catalog);
  RunArguments run_arguments;
  run_arguments.out = a.out.value_or((fs::path(a.folder) / fmt::format("run-{}", a.run)).string());
  const int code = run(scenario, run_arguments);
  std::optional<StoredRun> written;
  try {
    written = read_run(*run_arguments.out, catalog);
  } catch (const InputError&) {
    if (code != 1) throw;
    return 1;  // the error has been reported: the run could not be written
  }
  const StoredRun& again = *written;
  if (const auto cell = [&](const char* name) { return row[studies::place_in(names, name)]; }; cell("outcome") == "stopped") {
    fmt::print("the study ended this run early: {}; the repeated run has no such rule\n", one_line(cell("message")));
    return code == 2 ? 2 : 0;
  }
  const studies::RunMeasured measured = quantity_measure(head.quantities, scenario)(scenario, again.stored.recording);
  const std::vector<std::string> found =
      differences(names, row, journal.columns(), measured.quantities, again.stored.recording.outcome, journal.head().told);
  if (found.empty()) {
    fmt::print("the quantities are equal to those in the journal\n");
    const bool lost = code == 1 && again.stored.recording.outcome.done();  // true if some files of the run could not be written
    return code == 2 ? 2 : lost ? 1 : 0;
  }
  for (const std::string& difference : found) say(a.folder, "error", difference);
  return 4;
}

}  // namespace

void add_study(Commands& commands) {
  CLI::App* study = commands.app.add_subcommand("study", "Look at a study, merge its shards, or repeat one of its runs.");
  study->require_subcommand(1);
  const auto folder = [](CLI::App& command, StudyArguments& a) {
    command.add_option("DIR", a.folder, "folder of the study")->required()->check(not_empty);
  };
  add_command<StudyArguments>(commands, "show",
                              "Print progress, best and worst points and failures of a study, also while it runs.", show_study,
                              folder, study);
  add_command<StudyArguments>(commands, "report", "Write table and figures of a study again from its journal.", report_study,
                              folder, study);
  add_command<StudyArguments>(
      commands, "best", "Print the best points of a study that satisfy all constraints.", best_of_study,
      [&](CLI::App& command, StudyArguments& a) {
        folder(command, a);
        command.add_option("-n,--number", a.most, "number of points (default 10)")->check(CLI::Range(1, 1000000));
      },
      study);
  add_command<StudyArguments>(
      commands, "export", "Write all runs of a study as one table.", export_study,
      [&](CLI::App& command, StudyArguments& a) {
        folder(command, a);
        command.add_option("--to", a.format, "format of the file")->required()->check(CLI::IsMember({"csv"}));
        command.add_option("FILE", a.file, "file to write; must not exist")->required();
      },
      study);
  add_command<StudyArguments>(commands, "merge", "Merge the journals of all shards of a study.", merge_study, folder, study);
  add_command<StudyArguments>(
      commands, "rerun", "Repeat a run of a study, with its trace, and compare the quantities.", rerun_study,
      [&](CLI::App& command, StudyArguments& a) {
        folder(command, a);
        command.add_option("RUN", a.run, "number of the run")
            ->required()
            ->check(CLI::Range(std::int64_t{0}, std::int64_t{1000000000}));
        add_trust(command, a.plugins);
        command.add_option("--out", a.out, "run folder (default DIR/run-RUN); new or empty");
      },
      study);
}

}  // namespace gaitlab::app
