// Fixture of the tests of studies: a folder with a small scenario, in which tests call the program.
#pragma once
#include <cstdlib>
#include <map>
#include <sstream>

#include "tests/program/fixture.h"

namespace gaitlab::test {

class StudyFixture : public ::testing::Test {
 protected:
  StudyFixture() {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder_ / "modules");
    folder_.write("two.yaml",
                  "gaitlab: 1\nname: two\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncontact: {on: all}\n"
                  "physics: {engine: articulated}\ncpg: {type: phase_oscillator, frequency: 1}\ntrace: {period: 0.015}\n"
                  "duration: 0.3\n");
  }
  Result call(const std::string& arguments) { return gaitlab(arguments, folder_.path()); }
  void refused(const std::string& arguments, const std::string& message, int code = 2) {
    const Result result = call(arguments);
    EXPECT_EQ(result.code, code) << arguments;
    EXPECT_EQ(result.err, message + "\n") << arguments;
  }
  /// Rows of table.csv without the line of names. A row is a map from the column name to the text of the cell.
  std::vector<std::map<std::string, std::string>> table(const std::string& out) {
    std::istringstream text(read(folder_ / (out + "/table.csv")));
    const auto cells = [](const std::string& line) {
      std::vector<std::string> all(1);
      bool quoted = false;
      for (const char c : line) {
        if (c == '"') {
          quoted = !quoted;
        } else if (c == ',' && !quoted) {
          all.emplace_back();
        } else {
          all.back() += c;
        }
      }
      return all;
    };
    std::string line;
    std::getline(text, line);
    const std::vector<std::string> names = cells(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(text, line)) {
      const std::vector<std::string> values = cells(line);
      std::map<std::string, std::string> row;
      for (std::size_t k = 0; k < names.size() && k < values.size(); ++k) row[names[k]] = values[k];
      rows.push_back(row);
    }
    return rows;
  }

  Folder folder_;
};

/// Environment variables, which the constructor sets and the destructor removes.
class Environment {
 public:
  explicit Environment(std::map<std::string, std::string> set) : set_(std::move(set)) {
    for (const auto& [name, value] : set_) ::setenv(name.c_str(), value.c_str(), 1);
  }
  ~Environment() {
    for (const auto& [name, value] : set_) ::unsetenv(name.c_str());
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::map<std::string, std::string> set_;
};

}  // namespace gaitlab::test
