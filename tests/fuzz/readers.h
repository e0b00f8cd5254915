// Readers of files that may be hostile, each as a function of bytes. The only permitted error is an InputError. The fuzz target
// and the test of the corpus call these functions.
#pragma once
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "core/files/hash.h"
#include "core/recording/csv.h"
#include "core/recording/h5.h"
#include "core/recording/run_files.h"
#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "core/scenario/state_file.h"
#include "interchange/robot_module.h"
#include "report/figures/paper/recipe.h"
#include "report/remedy/remedy_text.h"
#include "tests/fuzz/study_readers.h"
#include "tests/golden/golden_sample.h"

namespace gaitlab::fuzz {

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

/// Reads the recipe of a figure.
inline void recipe(const std::string& text) { (void)report::read_recipe(folder().write("recipe.yaml", text)); }

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
  std::string head = "gaitlab-trace-1\nHDF5 follows at byte 512. Bytes in all: " + std::to_string(kUserBlock + rest.size()) +
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
  const std::string shown = report::shown_remedy(text, "0123456789abcdef", Word::infeasible);
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

inline void urdf(const std::string& text) { (void)interchange::module_of_robot(folder().write("robot.urdf", text), "robot"); }
inline void mjcf(const std::string& text) { (void)interchange::module_of_robot(folder().write("robot.xml", text), "robot"); }

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
                                     Reader{"urdf", urdf},
                                     Reader{"mjcf", mjcf}};

/// Calls a reader and ignores an InputError, the only exception that a reader may throw.
inline void take(const Reader& reader, const std::string& bytes) {
  try {
    reader.read(bytes);
  } catch (const InputError&) {
    return;
  }
}

}  // namespace gaitlab::fuzz
