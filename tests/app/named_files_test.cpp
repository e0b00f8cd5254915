// Messages on files that a scenario, study or recipe refers to quote only files of its folder.
#include "tests/app/study_fixture.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSecret = "name: hunter2\n1 2 swordfish\n";
constexpr const char* kHidden = "its text is not shown, because it lies outside the folder of the file that names it\n";

class NamedFiles : public StudyFixture {
 protected:
  NamedFiles() {
    fs::create_directories(folder_ / "theirs");
    fs::create_directory_symlink(kScenarios + "modules", folder_ / "theirs/modules");
    folder_.write("secret.dat", kSecret);
    folder_.write("theirs/own.dat", kSecret);
    fs::create_symlink("../secret.dat", folder_ / "theirs/link.dat");
  }
  /// Output of `check` for a scenario with this robot in the folder `theirs`.
  std::string said(const std::string& robot, const std::string& rest = "") {
    folder_.write("theirs/s.yaml", "gaitlab: 1\nrobot: {" + robot + "}\nduration: 1\n" + rest);
    return told("check theirs/s.yaml");
  }
  std::string told(const std::string& command) {
    const Result result = call(command);
    EXPECT_EQ(result.code, 2) << command;
    return result.err;
  }
  static void hides(const std::string& message, const std::string& expected) {
    EXPECT_EQ(message, expected + "; " + kHidden);
    EXPECT_FALSE(contains(message, "hunter2") || contains(message, "swordfish")) << message;
  }
};

TEST_F(NamedFiles, OfOtherFoldersAreNotQuoted) {
  fs::copy(folder_ / "secret.dat", folder_ / "secret.yaml");
  hides(said("modules: ../secret.yaml"), "secret.yaml:1:1: error: is not a module file");
  hides(said("modules: " + (folder_ / "secret.yaml")), folder_ / "secret.yaml:1:1: error: is not a module file");
  hides(said("modules: mtran, build: ../secret.dat"), "secret.dat:1:1: error: is not a build file");
  hides(said("modules: mtran, build: link.dat"), "theirs/link.dat:1:1: error: is not a build file");
  const std::string two = "modules: mtran, docks: [[1, 1, 4, 0, 0]]";
  hides(said(two, "ground: {type: heightfield, heightfield: {file: ../secret.dat}}\n"),
        "secret.dat:1:1: error: is not a file of heights");
  hides(said(two, "cpg: {type: table, model: {file: ../secret.dat}}\n"),
        "theirs/s.yaml:4:13: error: cpg does not take the file 'secret.dat'");
  hides(said(two, "controller: {type: rc_servo, model: ../secret.yaml}\n"), "secret.yaml:1:1: error: is not a servo file");
  fs::create_directory(folder_ / "theirs/servos");
  fs::create_symlink("../../secret.yaml", folder_ / "theirs/servos/link.yaml");
  hides(said(two, "controller: {type: rc_servo, model: link}\n"), "theirs/servos/link.yaml:1:1: error: is not a servo file");
  folder_.write("theirs/study.yaml",
                "gaitlab_study: 1\nscenario: ../secret.yaml\nparameters: {a: {low: 0, high: 1}}\nbudget: {runs: 2}\n");
  hides(told("sweep theirs/study.yaml"), "secret.yaml:1:1: error: is not a scenario");
  folder_.write("trace.csv", kSecret);
  folder_.write("theirs/figure.yaml",
                "gaitlab: 1\nruns: {a: ../trace.csv}\npanels: [{kind: curves, left: {columns: [com.x]}}]\n");
  hides(told("figure theirs/figure.yaml --out f.svg"), "trace.csv:2:1: error: is not a recording");
}

TEST_F(NamedFiles, OfTheirOwnFolderAreQuoted) {
  EXPECT_EQ(said("modules: mtran, build: own.dat"),
            "theirs/own.dat:1:1: error: the row has 2 numbers; expected 5: child_face child_module parent_face parent_module "
            "orientation\n"
            "theirs/own.dat:2:1: error: the row has 3 numbers; expected 5: child_face child_module parent_face parent_module "
            "orientation\n");
  EXPECT_TRUE(contains(said("modules: mtran, docks: [[1, 1, 4, 0, 0]]", "cpg: {type: table, model: {file: own.dat}}\n"),
                       "expected the column time; found 'name: hunter2'"));
}

// Module files and scenarios are quoted from any folder, because their first key identifies them.
TEST_F(NamedFiles, ThatSayWhatTheyAreAreQuoted) {
  folder_.write("odd.yaml", "gaitlab_module: 1\nname: odd one\n");
  EXPECT_TRUE(contains(said("modules: ../odd.yaml"), "odd.yaml:2:7: error: name 'odd one' is not allowed"));
  folder_.write("odd-scenario.yaml", "gaitlab: 1\nduration: soon\n");
  folder_.write("theirs/study.yaml",
                "gaitlab_study: 1\nscenario: ../odd-scenario.yaml\nparameters: {a: {low: 0, high: 1}}\nbudget: {runs: 2}\n");
  EXPECT_TRUE(contains(told("sweep theirs/study.yaml"), "odd-scenario.yaml:2:11: error: duration is 'soon'"));
}

}  // namespace
}  // namespace gaitlab::test
