// Readers of the files of studies, and of the lines that other programs exchange with a study.
#pragma once
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "app/study/study_quantities.h"
#include "app/study/study_text.h"
#include "core/errors.h"
#include "studies/journal/results.h"
#include "studies/journal/study_folder.h"
#include "studies/plan/definition.h"
#include "studies/plan/plan.h"
#include "studies/run/question.h"
#include "studies/run/told.h"
#include "studies/study/study_file.h"
#include "tests/fuzz/reader.h"

namespace gaitlab::fuzz {

/// Reads a study file, and applies it to the scenario `two.yaml` in the folder of the study file.
inline void study(const std::string& text) {
  folder().write("two.yaml", kTwo);
  studies::Study read = studies::read_study(folder().write("study.yaml", text), studies::Purpose::sweep);
  const studies::Plan plan(std::move(read), app::quantity_offer(), catalog());
  if (!studies::is_search(plan.study().method) && plan.points().runs() > 0) (void)plan.sets(plan.points().runs() - 1);
}

/// Reads a line of input of `gaitlab evaluate`, for two parameters.
inline void question(const std::string& line) {
  studies::Parameter frequency;
  frequency.key = "cpg.frequency";
  frequency.low = 0.1;
  frequency.high = 2;
  studies::Parameter type;
  type.key = "cpg.type";
  type.values = {"hopf", "sine"};
  type.words = true;
  (void)studies::read_question(line, {"stdin", 1, 1}, {frequency, type});
}

/// Reads a line of input of `gaitlab evaluate` for a study with five parameters of different kinds, and composes its answer.
inline void question_kinds(const std::string& line) {
  static const std::vector<studies::Parameter> parameters = [] {
    std::vector<studies::Parameter> all(5);
    all[0].key = "cpg.frequency";
    all[0].low = 0.1;
    all[0].high = 10;
    all[0].log = true;
    all[1].key = "cpg.amplitude";
    all[1].values = {"0.1", "1e-05", "1"};
    all[2].key = "cpg.type";
    all[2].values = {"hopf", "sine"};
    all[2].words = true;
    all[3].key = "controller.gains[m3/*].P";
    all[3].low = -1e300;
    all[3].high = 1e300;
    all[4].key = "legs";
    all[4].low = 0;
    all[4].high = 1;
    all[4].sets.emplace_back().key = "cpg.offset";
    return all;
  }();
  const studies::Question question = studies::read_question(line, {"stdin", 1, 1}, parameters);
  if (question.values.size() != parameters.size()) std::abort();
  studies::JournalHead head;
  head.objectives.resize(1);
  (void)studies::answer(question, head, {}, {}, {});
}

/// Reads a line of results of another program, for `gaitlab optimize --ask` of a study with two objectives. Aborts if a number
/// of the result is not known to be finite.
inline void told(const std::string& line) {
  const studies::Told result = studies::read_told(line, {"stdin", 1, 1}, 2);
  if (!std::isfinite(result.score.violation) || !std::isfinite(result.simulated)) std::abort();
}

/// Bytes of the journal of a small completed study: four points with two replicates each. One run has failed.
inline const std::string& good_journal() {
  static const std::string bytes = [] {
    folder().write("two.yaml", kTwo);
    const std::string text =
        "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.frequency: {low: 0.1, high: 2}, cpg.type: {values: [hopf, "
        "phase_oscillator]}}\nmethod: {type: random}\nbudget: {runs: 8}\nreplicates: {count: 2, combine: mean}\n"
        "objective: [{maximize: speed}, {minimize: torque.rms}]\nconstraints: [speed >= 0.1]\n";
    const studies::Plan plan(studies::read_study(folder().write("study.yaml", text), studies::Purpose::sweep),
                             app::quantity_offer(), catalog());
    const std::string file = folder() / "good.db";
    {
      studies::Journal made(file, studies::journal_head(plan), studies::Journal::Build::same);
      std::vector<studies::Row> rows;
      for (std::uint64_t run = 0; run < plan.points().runs(); ++run) {
        studies::Row& row = rows.emplace_back(plan.row(run));
        row.outcome = run == 5 ? "diverged" : "done";
        row.message = run == 5 ? "at t = 0.1 s" : "";
        row.simulated = 0.3;
        row.verdict = run == 5 ? Word::failed : Word::feasible;
        if (run == 5) continue;
        row.quantities.assign(plan.columns().size(), 0.1 * static_cast<double>(run));
        row.score = studies::Score{{}, run == 2 ? 0.5 : 0};
        for (double& objective : row.score->objectives) objective = 0.1 * static_cast<double>(run);
      }
      made.write(rows, {0, rows.size(), "2026-01-01T00:00:00Z", 0.5, "machine", 12});
      const studies::Generation generation{0, 0, 0, 0, 8, 4, 2, 0.5, 0.25, 0.1};
      made.write({&generation, 1});
      const studies::Verification verification{0, studies::TrialKind::half_step, "", {0.1, 0.2}, 0, Word::feasible, ""};
      made.write({&verification, 1});
    }
    return test::read(file);
  }();
  return bytes;
}

/// Aborts if a tag of a figure contains the number nan or inf. Texts between tags are not checked.
inline void check_svg(const std::string& svg) {
  bool tag = false;
  for (std::size_t at = 0; at < svg.size(); ++at) {
    if (svg[at] == '<' || svg[at] == '>') tag = svg[at] == '<';
    const bool word = tag && (svg.compare(at, 3, "nan") == 0 || svg.compare(at, 3, "inf") == 0);
    const auto letter = [&](std::size_t k) { return svg[k] >= 'a' && svg[k] <= 'z'; };
    if (!word || letter(at - 1) || (at + 3 < svg.size() && letter(at + 3))) continue;
    std::fprintf(stderr, "%s\n", svg.c_str());
    std::abort();
  }
}

/// Changes a valid study.db by lines of SQL, one statement each, and writes the summary and the figures of the result.
inline void journal_rows(const std::string& lines) {
  const std::string file = folder().write("rows.db", good_journal());
  for (const char* behind : {"-wal", "-shm", "-journal"}) std::filesystem::remove(file + behind);
  std::istringstream text(lines);
  std::string line;
  constexpr int kMost = 20;
  for (int k = 0; k < kMost && std::getline(text, line); ++k) {
    const auto begins = [&](const char* word) { return line.starts_with(word); };
    if (!begins("UPDATE ") && !begins("INSERT ") && !begins("DELETE ") && !begins("ALTER ") && !begins("DROP ")) continue;
    if (line.find_first_of(";(") != std::string::npos && line.find("SELECT") != std::string::npos) continue;  // may not end
    try {
      studies::Database(file, studies::Database::Mode::write).execute(line);
    } catch (const InputError&) {  // line that is not valid SQL
    } catch (const RunError&) {    // value that violates a constraint of a table
    }
  }
  studies::Journal journal(file);
  const studies::Results results = studies::results(journal);
  constexpr std::size_t kShown = 5;
  (void)app::study_summary(journal, results, folder().path(), kShown);
  const std::filesystem::path drawn = folder().path() / "drawn";
  std::filesystem::remove_all(drawn);
  std::filesystem::create_directory(drawn);
  (void)app::write_study_files(journal, results, drawn);
  for (const auto& entry : std::filesystem::directory_iterator(drawn)) {
    if (entry.path().extension() == ".svg") check_svg(test::read(entry.path().string()));
  }
}

/// Opens the folder of a study that contains files of arbitrary names. Each line creates an entry: `shard NAME`, `file NAME`,
/// `folder NAME`, `link NAME` or `lock TEXT`. Aborts if a file of the user (`file NAME`) changes.
inline void names(const std::string& lines) {
  namespace fs = std::filesystem;
  const fs::path study = folder().path() / "named";
  fs::remove_all(study);
  fs::create_directories(study / "shards");
  std::istringstream text(lines);
  std::string line;
  std::vector<fs::path> mine;
  constexpr int kMost = 50;
  constexpr const char* kMine = "mine, and nobody else's";
  for (int k = 0; k < kMost && std::getline(text, line); ++k) {
    const std::string kind = line.substr(0, line.find(' '));
    const std::string name = line.substr(std::min(line.size(), kind.size() + 1));
    if (kind == "lock") folder().write("named/lock", name.empty() ? "" : name + "\n");
    constexpr std::size_t kLongest = 200;
    if (name.empty() || name.size() > kLongest || name == "." || name == ".." ||
        name.find_first_of(std::string("/\0", 2)) != std::string::npos)
      continue;
    std::error_code none;
    if (fs::exists(fs::symlink_status(study / name, none))) continue;
    if (kind == "shard") folder().write("named/shards/" + name, good_journal());
    if (kind == "folder") fs::create_directory(study / name, none);
    if (kind == "link") fs::create_symlink("nowhere", study / name, none);
    if (kind != "file") continue;
    folder().write("named/" + name, kMine);
    mine.push_back(study / name);
  }
  const auto as_they_were = [&] {
    for (const fs::path& file : mine) {
      if (test::read(file.string()) != kMine) std::abort();
    }
  };
  try {
    const fs::path claimed = studies::study_folder(study, "named", {});
    const studies::Lock lock(claimed / "lock");
  } catch (const InputError&) {
  }
  as_they_were();
  (void)studies::Lock::holder(study / "lock");
  const studies::Shards shards = studies::shards_in(study);
  for (const std::uint64_t index : shards.indices) {
    if (index >= shards.count || !fs::exists(studies::shard_file(study, {index, shards.count}))) std::abort();
  }
}

/// Reads the bytes of a study.db.
inline void journal(const std::string& bytes) {
  studies::Journal read(folder().write("study.db", bytes));
  (void)studies::results(read);
  (void)read.generations();
  (void)read.verifications();
}

}  // namespace gaitlab::fuzz
