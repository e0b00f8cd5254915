// Readers of files that may be hostile, each as a function of bytes. The only permitted error is an InputError. The fuzz target
// and the test of the corpus call these functions.
#pragma once
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "app/app.h"
#include "app/study/study_quantities.h"
#include "app/study/study_text.h"
#include "core/errors.h"
#include "core/files/hash.h"
#include "core/recording/csv.h"
#include "core/recording/h5.h"
#include "core/recording/run_files.h"
#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "core/scenario/state_file.h"
#include "interchange/urdf_module.h"
#include "report/figures/paper/recipe.h"
#include "report/remedy/remedy_text.h"
#include "studies/journal/results.h"
#include "studies/journal/study_folder.h"
#include "studies/plan/definition.h"
#include "studies/plan/plan.h"
#include "studies/run/question.h"
#include "studies/run/told.h"
#include "studies/study/study_file.h"
#include "tests/folder.h"
#include "tests/golden/golden_sample.h"

namespace gaitlab::fuzz {

struct Reader {
  std::string_view name;
  void (*read)(const std::string& bytes);
};

inline const test::Folder& folder() {
  static const test::Folder made;
  return made;
}

inline Catalog& catalog() {
  static Catalog made = app::standard_catalog();
  return made;
}

/// Text as a YAML scalar in double quotes.
inline std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
      continue;
    }
    out += c;
  }
  return out + '"';
}

/// Reads a scenario, resolves it, and resolves the result again. Aborts if the two resolved scenarios differ.
inline Scenario read_whole(const std::string& scenario) {
  Scenario read = read_scenario(folder().write("scenario.yaml", scenario), {}, catalog());
  const std::string once = resolved(read);
  const std::string twice = resolved(read_scenario(folder().write("resolved.yaml", once), {}, catalog()));
  if (once == twice) return read;
  std::fprintf(stderr, "resolved:\n%s\nresolved again:\n%s\n", once.c_str(), twice.c_str());
  std::abort();
}

inline void scenario(const std::string& text) { (void)read_whole(text); }

inline void build(const std::string& text) {
  folder().write("robot.dat", text);
  (void)read_whole("gaitlab: 1\nrobot: {modules: mtran, build: robot.dat}\nduration: 1\n");
}

inline void module(const std::string& text) {
  folder().write("module.yaml", text);
  (void)read_whole("gaitlab: 1\nrobot: {modules: module.yaml}\nduration: 1\n");
}

/// Reads the heights of a heightfield from bytes: a text, a matrix of NumPy or a grey PNG.
inline void heights(const std::string& bytes) {
  folder().write("heights", bytes);
  (void)read_whole(
      "gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\nground: {type: heightfield, heightfield: {file: heights, scale: "
      "1e-3}}\n");
}

/// Reads a CPG of equations, and evaluates its output and derivative once.
inline void equations(const std::string& text) {
  const Scenario scenario = read_whole(
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 1\n"
      "cpg: {type: equations, model: {parameters: {a: 2}, states: {phi: " +
      quoted(text) + ", r: \"a*(amplitude - r)\"}, initial: {phi: phase}, output: \"r*sin(phi)\"}}\n");
  const void* settings = scenario.cpg.settings.get();
  const std::unique_ptr<Cpg> cpg(static_cast<Cpg*>(scenario.cpg.entry->make(info(*scenario.robot), {&settings, 1})));
  const std::vector<double> zeros(scenario.robot->joints.size(), 0.0);
  const Measured measured{0, 0.015, zeros, zeros, zeros, zeros};
  std::vector<double> state(cpg->states());
  std::vector<double> rate(cpg->states());
  std::vector<double> setpoint(scenario.robot->joints.size());
  cpg->start(state);
  cpg->output(0, state, setpoint);
  cpg->derivative(measured, state, rate);
}

inline constexpr const char* kTwo =
    "gaitlab: 1\nname: two\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
    "cpg: {type: phase_oscillator}\nduration: 0.3\n";

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
        row.verdict = run == 5 ? "failed" : "feasible";
        if (run == 5) continue;
        row.quantities.assign(plan.columns().size(), 0.1 * static_cast<double>(run));
        row.score = studies::Score{{}, run == 2 ? 0.5 : 0};
        for (double& objective : row.score->objectives) objective = 0.1 * static_cast<double>(run);
      }
      made.write(rows, {0, rows.size(), "2026-01-01T00:00:00Z", 0.5, "machine", 12});
      const studies::Generation generation{0, 0, 0, 0, 8, 4, 2, 0.5, 0.25, 0.1};
      made.write({&generation, 1});
      const studies::Verification verification{0, "half step", {0.1, 0.2}, 0, "feasible", ""};
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

/// Reads the recipe of a figure.
inline void recipe(const std::string& text) { (void)report::read_recipe(folder().write("recipe.yaml", text)); }

/// Reads the bytes of a study.db.
inline void journal(const std::string& bytes) {
  studies::Journal read(folder().write("study.db", bytes));
  (void)studies::results(read);
  (void)read.generations();
  (void)read.verifications();
}

/// Reads the text of a golden.json next to a valid trace. Its checksum is corrected first.
inline void golden(const std::string& text) {
  static const bool made = [] {
    golden::write_golden(test::sample_golden(test::walk(21)), folder().path() / "walk.golden");
    return true;
  }();
  (void)made;
  constexpr std::string_view kChecksum = ",\n  \"checksum\": \"";
  const std::string content = text.substr(0, text.rfind(kChecksum));
  folder().write("walk.golden/golden.json", content + std::string(kChecksum) + hash(content) + "\"\n}\n");
  const golden::Golden read = golden::read_golden(folder().path() / "walk.golden");
  if (read.history.empty()) std::abort();
}

/// Reads the bytes of a trace.golden. Size and checksum are corrected first.
inline void golden_trace(const std::string& bytes) {
  std::size_t body = bytes.find('\n');
  if (body != std::string::npos) body = bytes.find('\n', body + 1);
  const std::string rest = body == std::string::npos ? bytes : bytes.substr(body + 1);
  const auto with = [&](std::size_t size) {
    std::string digits = std::to_string(size);
    digits.insert(0, 20 - digits.size(), ' ');
    return "gaitlab-golden-1\nbytes in all: " + digits + "; FNV-1a of what follows: " + hash(rest) + "\n" + rest;
  };
  (void)golden::unpack(with(with(0).size()), "trace.golden");
}

/// Reads the bytes of a trace.h5. Size and checksum are corrected first.
inline void trace(const std::string& bytes) {
  constexpr std::size_t kUserBlock = 512;
  const std::string rest = bytes.size() > kUserBlock ? bytes.substr(kUserBlock) : bytes;
  std::string head = "gaitlab-trace-2\nHDF5 follows at byte 512. Bytes in all: " + std::to_string(kUserBlock + rest.size()) +
                     "; hash from byte 512 on: " + hash_words(rest) + "\n";
  head.resize(kUserBlock, '\0');
  (void)read_h5(folder().write("trace.h5", head + rest));
}

/// Reads the summary.json of a run folder.
inline void summary(const std::string& text) {
  folder().write("summary.json", text);
  (void)read_summary(folder().path()).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Reads a remedy.json for the page of the run that it belongs to. A remedy that is not shown counts as refused.
inline void remedy(const std::string& text) {
  const std::string shown = report::shown_remedy(text, "0123456789abcdef", report::Word::infeasible);
  if (shown.empty()) throw InputError(SourceLocation{"remedy.json"}, "is not shown");
  const nlohmann::json json = nlohmann::json::parse(shown);
  if (json.at("text").size() != json.at("tones").size()) std::abort();
}

inline void csv(const std::string& text) { (void)read_csv(folder().write("trace.csv", text)); }

/// Reads a state file of `gaitlab dynamics`.
inline void state(const std::string& text) {
  const Scenario two = read_scenario(folder().write("two.yaml", kTwo), {}, catalog());
  RobotState start;
  start.q.assign(two.robot->joints.size(), 0.0);
  start.qd = start.q;
  (void)read_state_file(folder().write("state.json", text), *two.robot, two.base, start);
}

inline void urdf(const std::string& text) { (void)interchange::module_of_urdf(folder().write("robot.urdf", text), "robot"); }

inline constexpr std::array kReaders{Reader{"scenario", scenario},
                                     Reader{"build", build},
                                     Reader{"module", module},
                                     Reader{"heights", heights},
                                     Reader{"grey_heights", heights},
                                     Reader{"equations", equations},
                                     Reader{"study", study},
                                     Reader{"question", question},
                                     Reader{"question_kinds", question_kinds},
                                     Reader{"told", told},
                                     Reader{"journal", journal},
                                     Reader{"journal_rows", journal_rows},
                                     Reader{"names", names},
                                     Reader{"recipe", recipe},
                                     Reader{"golden", golden},
                                     Reader{"golden_trace", golden_trace},
                                     Reader{"trace", trace},
                                     Reader{"summary", summary},
                                     Reader{"remedy", remedy},
                                     Reader{"csv", csv},
                                     Reader{"state", state},
                                     Reader{"urdf", urdf}};

/// Calls a reader and ignores an InputError, the only exception that a reader may throw.
inline void take(const Reader& reader, const std::string& bytes) {
  try {
    reader.read(bytes);
  } catch (const InputError&) {
    return;
  }
}

}  // namespace gaitlab::fuzz
