// A copy of any shipped scenario, alone in a folder, is the same scenario, because it names modules and robots instead of
// files.
#include <regex>

#include "core/scenario/resolved.h"
#include "core/settings/shipped_files.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongShippedScenarios(
    "ShippedScenarios.AreRunAndApprovedAsCopies:ShippedScenarios.AreTheSameAsCopiesInAnEmptyFolder", "long");

namespace fs = std::filesystem;

TEST(ShippedScenarios, AreTheSameAsCopiesInAnEmptyFolder) {
  const auto shipped = shipped_files("scenario");
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

constexpr const char* kBody = "gaitlab_module: 1\nname: y1\nbodies: {a: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}\n";

/// Output of `check` on stderr for a scenario with this robot, alone with the files in the folder.
std::string said_of(const Folder& folder, const std::string& robot) {
  folder.write("s.yaml", "gaitlab: 1\nrobot: {" + robot + "}\nactuator: {type: none}\ncontact: {on: none}\nduration: 1\n");
  const Result result = gaitlab("check s.yaml", folder / "");
  EXPECT_EQ(result.code, 0) << result.err;
  return result.err;
}

// A name always means a file of that name rather than a shipped one, with a note, and never a folder.
TEST(ShippedNames, OfModulesComeAfterFilesOfThatName) {
  const Folder folder;
  fs::create_directory(folder / "y1");
  EXPECT_FALSE(contains(said_of(folder, "modules: y1"), "comes with gaitlab"));
  folder.write("y1.yaml", "gaitlab: 1\nrobot: {modules: y1}\nduration: 1\n");  // a scenario is not a module type
  EXPECT_FALSE(contains(said_of(folder, "modules: y1"), "comes with gaitlab"));
  folder.write("y1.yaml", kBody);
  EXPECT_TRUE(contains(said_of(folder, "modules: y1"),
                       "s.yaml:2:18: note: 'y1' is the file 'y1.yaml', not the one of that name that comes with gaitlab\n"));
  fs::copy_file(kScenarios + "modules/y1.yaml", folder / "y1.yaml", fs::copy_options::overwrite_existing);
  EXPECT_FALSE(contains(said_of(folder, "modules: y1"), "comes with gaitlab"));  // a copy hides nothing
}

TEST(ShippedNames, OfRobotsComeAfterFilesOfThatName) {
  const Folder folder;
  fs::create_directory(folder / "hexapod");
  EXPECT_EQ(said_of(folder, "modules: mtran, build: hexapod").find("comes with gaitlab"), std::string::npos);
  fs::create_directory(folder / "robots");
  folder.write("robots/hexapod.dat", "1 1 4 0 0\n");
  EXPECT_TRUE(contains(
      said_of(folder, "modules: mtran, build: hexapod"),
      "s.yaml:2:32: note: 'hexapod' is the file 'robots/hexapod.dat', not the one of that name that comes with gaitlab\n"));
}

TEST(ShippedNames, OfNewScenariosFollowTheSameOrder) {
  const Folder folder;
  fs::create_directory(folder / "y1");
  EXPECT_EQ(gaitlab("new scenario a --module y1 --count 2", folder / "").err, "");
  EXPECT_TRUE(contains(read(folder / "a.yaml"), "modules: y1"));
  fs::remove(folder / "y1");
  std::string own = read(kScenarios + "modules/y1.yaml");
  folder.write("y1", own + "# mine\n");
  const Result file = gaitlab("new scenario b --module y1 --count 2", folder / "");
  EXPECT_TRUE(contains(file.err, "y1: note: 'y1' is the file './y1', not the module type that comes with gaitlab\n"))
      << file.err;
  EXPECT_TRUE(contains(read(folder / "b.yaml"), "modules: ./y1")) << read(folder / "b.yaml");
  fs::rename(folder / "y1", folder / "y1.yaml");
  const Result named = gaitlab("new scenario c --module y1 --count 2", folder / "");
  EXPECT_TRUE(
      contains(named.err, "--module: note: 'y1' is the file 'y1.yaml', not the one of that name that comes with gaitlab\n"))
      << named.err;
  EXPECT_TRUE(contains(read(folder / "c.yaml"), "modules: y1"));
}

}  // namespace
}  // namespace gaitlab::test
