// A copy of any shipped scenario, alone in a folder, is what it is where it was: it names modules and robots, no files.
#include <regex>

#include "core/scenario/resolved.h"
#include "kit/shipped.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;

TEST(ShippedScenarios, AreTheSameAsCopiesInAnEmptyFolder) {
  const auto shipped = kit::shipped_files("scenario");
  EXPECT_GE(shipped.size(), 20U);
  for (const auto& [name, file] : shipped) {
    const Folder folder;
    const std::string copy = folder / "my.yaml";
    fs::copy_file(file, copy);
    EXPECT_EQ(gaitlab("check my.yaml", folder / "").code, 0) << name;
    EXPECT_EQ(resolved(read_scenario(copy, {}, catalog())), resolved(read_scenario(file, {}, catalog()))) << name;
  }
}

TEST(ShippedScenarios, AreRunAndApprovedAsCopies) {
  for (const char* name : {"hexapod", "octopod"}) {
    const Folder folder;
    std::string text =
        std::regex_replace(read(kScenarios + name + ".yaml"), std::regex("\nduration: [0-9]+"), "\nduration: 0.3");
    if (!contains(text, "\nphysics:")) text += "physics: {engine: articulated, accuracy: 0.001}\n";
    folder.write("my.yaml", text);
    const Result ran = gaitlab("run my.yaml --quiet --no-report", folder / "");
    EXPECT_EQ(ran.code, 0) << ran.err;
    const Result approved = gaitlab("approve my.yaml --reason copied", folder / "");
    EXPECT_EQ(approved.code, 0) << approved.err;
    EXPECT_EQ(gaitlab("test my.yaml", folder / "").code, 0) << name;
  }
}

}  // namespace
}  // namespace gaitlab::test
