// Everything that reads what a user or a stranger wrote, each as one function of bytes. Bad input is an InputError; anything
// else that happens is a finding. The fuzz target and the test of the corpus call the same functions.
#pragma once
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "app/app.h"
#include "app/study_figures.h"
#include "core/errors.h"
#include "core/files/hash.h"
#include "core/recording/csv.h"
#include "core/recording/h5.h"
#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "core/scenario/state_file.h"
#include "studies/plan.h"
#include "studies/question.h"
#include "studies/results.h"
#include "studies/study_file.h"
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

/// A YAML scalar in double quotes.
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

/// What is taken can be resolved, and resolved again is itself.
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

/// Read, and one tick of the CPG: whatever its equations give, it comes back.
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

/// Read, and bound to its scenario: `two.yaml` lies beside it.
inline void study(const std::string& text) {
  folder().write("two.yaml", kTwo);
  studies::Study read = studies::read_study(folder().write("study.yaml", text), studies::Purpose::sweep);
  const studies::Plan plan(std::move(read), app::figure_offer(), catalog());
  if (!studies::is_search(plan.study().method) && plan.points().runs() > 0) (void)plan.sets(plan.points().runs() - 1);
}

/// A question of the program that asks `evaluate`.
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

/// study.db.
inline void journal(const std::string& bytes) {
  studies::Journal read(folder().write("study.db", bytes));
  (void)studies::results(read);
  (void)read.generations();
  (void)read.verifications();
}

/// golden.json beside a trace, its checksum made right.
inline void golden(const std::string& text) {
  static const bool made = [] {
    write_golden(test::sample_golden(test::walk(21)), folder().path() / "walk.golden");
    return true;
  }();
  (void)made;
  constexpr std::string_view kChecksum = ",\n  \"checksum\": \"";
  const std::string content = text.substr(0, text.rfind(kChecksum));
  folder().write("walk.golden/golden.json", content + std::string(kChecksum) + hash(content) + "\"\n}\n");
  const Golden read = read_golden(folder().path() / "walk.golden");
  if (read.history.empty()) std::abort();
}

/// trace.golden, its size and checksum made right.
inline void golden_trace(const std::string& bytes) {
  std::size_t body = bytes.find('\n');
  if (body != std::string::npos) body = bytes.find('\n', body + 1);
  const std::string rest = body == std::string::npos ? bytes : bytes.substr(body + 1);
  const auto with = [&](std::size_t size) {
    std::string digits = std::to_string(size);
    digits.insert(0, 20 - digits.size(), ' ');
    return "gaitlab-golden-1\nbytes in all: " + digits + "; FNV-1a of what follows: " + hash(rest) + "\n" + rest;
  };
  (void)unpack(with(with(0).size()), "trace.golden");
}

/// trace.h5, its size and checksum made right.
inline void trace(const std::string& bytes) {
  constexpr std::size_t kUserBlock = 512;
  const std::string rest = bytes.size() > kUserBlock ? bytes.substr(kUserBlock) : bytes;
  std::string head = "gaitlab-trace-2\nHDF5 follows at byte 512. Bytes in all: " + std::to_string(kUserBlock + rest.size()) +
                     "; hash from byte 512 on: " + hash_words(rest) + "\n";
  head.resize(kUserBlock, '\0');
  (void)read_h5(folder().write("trace.h5", head + rest));
}

inline void csv(const std::string& text) { (void)read_csv(folder().write("trace.csv", text)); }

/// The state file of `gaitlab dynamics`.
inline void state(const std::string& text) {
  const Scenario two = read_scenario(folder().write("two.yaml", kTwo), {}, catalog());
  RobotState start;
  start.q.assign(two.robot->joints.size(), 0.0);
  start.qd = start.q;
  (void)read_state_file(folder().write("state.json", text), *two.robot, two.base, start);
}

inline constexpr std::array kReaders{
    Reader{"scenario", scenario},   Reader{"build", build},   Reader{"module", module},
    Reader{"equations", equations}, Reader{"study", study},   Reader{"question", question},
    Reader{"journal", journal},     Reader{"golden", golden}, Reader{"golden_trace", golden_trace},
    Reader{"trace", trace},         Reader{"csv", csv},       Reader{"state", state}};

/// InputError is what every reader may say; a journal also that the file cannot be read.
inline void take(const Reader& reader, const std::string& bytes) {
  try {
    reader.read(bytes);
  } catch (const InputError&) {
    return;
  }
}

}  // namespace gaitlab::fuzz
