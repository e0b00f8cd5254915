// Fixture of the tests of scenarios: a temporary folder, a catalog of fakes, and scenarios that are read from texts.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "tests/core/scenario/fakes.h"
#include "tests/messages.h"

namespace gaitlab::fakes {

class ScenarioTest : public testing::Test {
 protected:
  ScenarioTest() { fill(catalog_); }

  Scenario read(const std::string& text, const std::vector<std::string>& sets = {}) {
    return read_scenario(folder_.write("s.yaml", text), sets, catalog_);
  }
  std::string error(const std::string& text, const std::vector<std::string>& sets = {}) {
    return folder_.shown(test::message_of([&] { read(text, sets); }));
  }
  /// Expects resolved(read(resolved(s))) == resolved(s) if the resolved scenario s is read from a different folder.
  void expect_stable(const Scenario& scenario) {
    const std::string once = resolved(scenario);
    EXPECT_EQ(once.find(folder_.path()), std::string::npos);
    const Folder elsewhere;
    const std::string path = elsewhere.write("r.yaml", once);
    EXPECT_EQ(resolved(read_scenario(path, {}, catalog_)), once);
  }

  Folder folder_;
  Catalog catalog_;
};

inline const std::string kShort = "robot: {modules: duo}\nduration: 1\n";
inline const std::string kTwo = "robot:\n  modules: duo\n  docks: [[1, 1, 4, 0, 0]]\nduration: 1\n";

}  // namespace gaitlab::fakes
