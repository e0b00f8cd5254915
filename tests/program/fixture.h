// Helpers of the tests of the whole program: scenarios from text, runs in memory, calls of the program's executable.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

#include "app/app.h"
#include "core/scenario/read_scenario.h"
#include "core/simulation/simulation.h"
#include "tests/folder.h"
#include "tests/folders.h"

namespace gaitlab::test {

inline const std::string kScenarios = std::string(gaitlab::test::source_folder()) + "/scenarios/";

/// Catalog of the standard plugins, which exists until the end of the process because scenarios refer to it.
inline Catalog& catalog() {
  static Catalog all = app::standard_catalog();
  return all;
}

inline Scenario shipped(const std::string& name, const std::vector<std::string>& sets = {}) {
  return read_scenario(kScenarios + name, sets, catalog());
}

/// All scenarios of scenarios/library, in the order of their names.
inline std::vector<Scenario> shipped_library() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(kScenarios + "library")) {
    if (file.path().extension() == ".yaml") names.push_back("library/" + file.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  std::vector<Scenario> all;
  for (const std::string& name : names) all.push_back(shipped(name));
  return all;
}

/// Scenario that is read from a text, which can use the shipped module types.
inline Scenario scenario(const std::string& text, const std::vector<std::string>& sets = {}) {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  std::filesystem::create_directory_symlink(kScenarios + "robots", folder / "robots");
  return read_scenario(folder.write("test.yaml", text), sets, catalog());
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline void expect_refusal(const std::string& text, const std::string& expected) {
  try {
    scenario(text);
    ADD_FAILURE() << text << " is accepted";
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), expected)) << error.what();
  }
}

inline Recording run(const Scenario& scenario) {
  Simulation simulation({&scenario, 1});
  simulation.run();
  return simulation.take_recording(0);
}

/// Access to the columns of a trace by name. A missing column is a test failure.
class Table {
 public:
  explicit Table(const Trace& trace) : trace_(trace) {}
  [[nodiscard]] double operator()(double t, const std::string& name) const {
    const double period = trace_.at(1, 0) - trace_.at(0, 0);
    return at(static_cast<std::size_t>(std::llround(t / period)), name);
  }
  [[nodiscard]] double at(std::size_t row, const std::string& name) const {
    const std::size_t column = trace_.find(name);
    if (column == trace_.columns.size()) throw std::out_of_range("no column " + name);
    return trace_.at(row, column);
  }

 private:
  const Trace& trace_;
};

inline double end(const Recording& record, const std::string& column) {
  return Table(record.trace).at(record.trace.rows() - 1, column);
}

inline const std::string kEq12 = "closed form of eq. 12 (docs/equations.md, 6)";

struct Result {
  int code = 0;
  std::string out, err;
};

/// The text without lines of progress, such as `59 % done` and `7/32 runs`: a command writes them after 10 s, and so on a slow
/// machine only.
inline std::string without_progress(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t number = line.find_first_not_of("0123456789");
    const bool counts = number > 0 && number != std::string::npos;
    if (counts && (line.compare(number, 7, " % done") == 0 || (line[number] == '/' && contains(line, " runs")))) continue;
    kept += line;
    if (!lines.eof()) kept += '\n';
  }
  return kept;
}

/// Calls the executable gaitlab with `folder` as the working directory. Returns its exit code and outputs, without progress.
inline Result gaitlab(const std::string& arguments, const std::string& folder) {
  const Folder capture;
  const std::string command = "cd '" + folder + "' && '" + std::string(gaitlab::test::build_folder()) + "/bin/gaitlab' " +
                              arguments + " >'" + (capture / "out") + "' 2>'" + (capture / "err") + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(capture / "out"), without_progress(read(capture / "err"))};
}

}  // namespace gaitlab::test
