// Tests of bad input: complete messages, exit code 2, and no written files; and of a run that diverges.
#include <regex>

#include "core/recording/h5.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongProgram("Program.ConvergeShowsErrorOrderAndTheStepThatIsGood", "long");

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
    folder.write("good.yaml", "gaitlab: 1\nrobot: {modules: mtran}\nduration: 0.1\n");
  }

  /// Calls `gaitlab run` with these arguments. Expects this message, exit code 2 and no run folder.
  void expect_refused(const std::string& arguments, const std::string& message) {
    const Result result = gaitlab("run " + arguments, folder / "");
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_EQ(result.err, message + "\n");
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder / "runs"));
  }
  void expect_refused_text(const std::string& text, const std::string& message) {
    folder.write("bad.yaml", text);
    expect_refused("bad.yaml", message);
  }
  void expect_refused_rows(const std::string& rows, const std::string& message) {
    folder.write("bad.dat", rows);
    expect_refused_text("gaitlab: 1\nrobot: {modules: mtran, build: bad.dat}\nduration: 1\n", message);
  }

  Folder folder;
};

TEST_F(Program, BuildFileErrorsNameTheRow) {
  expect_refused_rows(
      "1 1 1 0 0\n",
      "bad.dat:1:1: error: wrong gender: face 1 of module 1 and face 1 of module 0 are both active; active docks on "
      "passive, so module 1 could take face 3, 4, 5");
  expect_refused_rows("1 1 4 0 0\n\n# comment\n0 2 4 0 0\n",
                      "bad.dat:4:1: error: face 4 of module 0 is used twice: a face docks once\n"
                      "bad.dat:1:1: note: this face is already docked here");
  expect_refused_rows("1 1 4 7 0\n",
                      "bad.dat:1:1: error: unknown parent module 7: it is neither module 0 nor the child of a row");
  expect_refused_rows("1 1 4 0 0\n1 2 4 1 0\n0 2 3 0 0\n",
                      "bad.dat:3:1: error: this dock closes a ring: module 2 and module 0 are already connected by other "
                      "docks; docks must form a tree, closed chains are not supported\n"
                      "bad.dat:2:1: note: its first parent is given here");
  expect_refused_rows("1 1 4 0 0\n1 2 4 3 0\n1 3 4 2 0\n",
                      "bad.dat:2:1: error: loop: modules 2 - 3 - 2 are docked in a ring, but none of them to module 0");
  expect_refused_rows(
      "1 1 4 0 0\n1 3 4 1 0\n",
      "bad.dat:2:1: error: gap in the numbering: there is a module 3 but no module 2; modules are numbered 0 to n-1");
  expect_refused_rows("1 1 4 0 4\n",
                      "bad.dat:1:1: error: orientation 4 is not a quarter turn: expected 0, 1, 2 or 3 (times pi/2)");
  expect_refused_rows(
      "1 1 3 0 0\n1 2 5 1 0\n1 3 5 2 0\n1 4 5 3 0\n",
      "bad.dat:4:1: error: overlapping cells: m0/active and m4/active are in the same lattice cell at zero angles");
}

TEST_F(Program, ScenarioErrors) {
  expect_refused_text("gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\ncontact: {stifness: 1e4}\n",
                      "bad.yaml:4:11: error: unknown key 'stifness'; did you mean 'stiffness'?");
  expect_refused_text("gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\nduration: 2\n",
                      "bad.yaml:4:1: error: duplicate key 'duration'\nbad.yaml:3:1: note: it is given here first");
  expect_refused_text("gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\ncontroller: {period: 0.0151}\nphysics: {step: 4e-5}\n",
                      "bad.yaml:4:22: error: control period 0.0151 s is not a whole multiple of the step 4e-05 s (377.5 "
                      "steps); steps that fit: 2.5e-05, 5e-05; periods that fit: 0.01508, 0.01512");
  expect_refused_text("gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\ncpg: {frequency: .nan}\n",
                      "bad.yaml:4:18: error: frequency is .nan; expected a finite number in Hz");
  expect_refused("missing.yaml", "missing.yaml: error: cannot be read: No such file or directory");
  expect_refused_text("gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\ntrace: {columns: [joint.0.torqe]}\n",
                      "bad.yaml:4:18: error: 'joint.0.torqe' matches no column; did you mean 'joint.0.torque'?");
}

TEST_F(Program, ABaseCannotStartWithAVelocityItCannotHave) {
  expect_refused_text("gaitlab: 1\nrobot: {modules: mtran, base: fixed}\nduration: 1\ninitial: {base_velocity: [1, 0, 0]}\n",
                      "bad.yaml:4:26: error: a fixed base does not move");
  expect_refused_text(
      "gaitlab: 1\nrobot: {modules: mtran, base: planar}\nduration: 1\ninitial: {base_angular_velocity: [1, 2, 0]}\n",
      "bad.yaml:4:34: error: a planar base moves along x and z and turns about y");
}

TEST_F(Program, AConstantSetPointOutsideItsRangeIsRefused) {
  expect_refused_text(
      "gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\ncpg: {type: sine, amplitude: 0, offset: 2}\n",
      "bad.yaml:4:13: error: cpg 'sine': joint m0/active would hold its offset, outside its range (amplitude 0)");
}

TEST_F(Program, OutputFolders) {
  folder.write("full", "");
  std::filesystem::remove(folder / "full");
  std::filesystem::create_directory(folder / "full");
  folder.write("full/mine.txt", "do not touch");
  expect_refused("good.yaml --out full", "--out full: error: exists and is not empty");
  EXPECT_EQ(read(folder / "full/mine.txt"), "do not touch");
  expect_refused("good.yaml --out /proc/nothing/here",
                 "--out /proc/nothing/here: error: cannot be made: No such file or directory");
}

TEST_F(Program, NumbersDefaultRunFolders) {
  ASSERT_EQ(gaitlab("run good.yaml", folder / "").code, 0);
  ASSERT_EQ(gaitlab("run good.yaml", folder / "").code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/good/summary.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/good-2/summary.json"));
}

TEST_F(Program, DivergingRunKeepsWhatItHas) {
  folder.write(
      "wild.yaml",
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.1\nactuator: {type: torque, limit: 0}\n"
      "controller: {type: hold, period: 0.05, command: {default: 0, m1/passive: 1e6}}\ntrace: {period: 2.5e-5}\n"
      "physics: {step: 2.5e-5}\n");
  const Result result = gaitlab("run wild.yaml --out out", folder / "");
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err,
            "wild.yaml: error: diverged at step 1, t = 2.5e-05 s: joint m1/passive turns at 3.36e+05 rad/s; the rows up to "
            "that time are in out\n");
  const Trace trace = read_h5(folder / "out/trace.h5").trace;
  EXPECT_GE(trace.rows(), 1U);
}

TEST_F(Program, ConvergeShowsErrorOrderAndTheStepThatIsGood) {
  const std::string arguments =
      "converge '" + kScenarios + "caterpillar.yaml' --quiet -j 2 --set duration=0.2 --set physics.step=2.5e-5";
  const Result r = gaitlab(arguments + " --columns 'joint.1?.torque'", folder / "");
  const auto shows = [&](const std::string& what) { return std::regex_search(r.out, std::regex(what)); };
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(shows("error against step 6.25e-06 s")) << r.out;
  EXPECT_TRUE(shows("joint.15.torque ")) << r.out;
  EXPECT_FALSE(shows("joint.9.torque ")) << r.out;
  EXPECT_TRUE(shows("worst: joint[.]1[0-5][.]torque +0[.]0[0-9]+ % +0[.]0[0-9]+ % +(0[.]9|1[.][01])\n")) << r.out;
  EXPECT_TRUE(shows("step 2.5e-05 s is accurate to 1 %")) << r.out;

  for (const std::string odd : {"\"a'b\"", "'a\"b'", "'a, b'"}) {
    const Result none = gaitlab(arguments + " --columns " + odd, folder / "");
    EXPECT_EQ(none.code, 2) << odd;
    EXPECT_NE(none.err.find("matches no column"), std::string::npos) << none.err;
  }
  const Result wrong = gaitlab(arguments + " --columns 'joint.1.tork'", folder / "");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("did you mean 'joint.1.torque'?"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace gaitlab::test
