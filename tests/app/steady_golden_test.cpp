// Goldens of robots that stand, stay straight or roll, some columns of which are constant; columns that the user selects.
#include "golden/natural_scales.h"
#include "tests/app/golden_command.h"

namespace gaitlab::test {

using namespace golden;
namespace {

const std::string kOnGround = "contact: {on: all}\nphysics: {engine: articulated, accuracy: 0.001}\n";
const std::string kBare =
    "actuator: {load_friction: 0, dry_friction: 0, viscous_friction: 0, rotor_inertia: 0}\n";  // the sheet's line alone
/// Two blocks that stand, three modules that creep in a plane, and an arm that holds its weight.
const std::pair<const char*, std::string> kSteady[] = {
    {"stands.yaml", "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.3\n" + kOnGround},
    {"straight.yaml",
     "gaitlab: 1\nrobot: {modules: y1, docks: [[0, 1, 1, 0, 0], [0, 2, 1, 1, 0]]}\nduration: 0.3\n"
     "cpg: {type: sine, frequency: 1, amplitude: 0.1, phase_lag: 0}\n" +
         kBare + kOnGround},
    {"holds.yaml",
     "gaitlab: 1\nrobot: {base: fixed, position: [0, 0, 1], modules: y1, docks: [[0, 1, 1, 0, 0]]}\nground: {type: none}\n"
     "contact: {on: none}\nphysics: {engine: articulated, accuracy: 0.001}\ninitial: {angles: 0.4}\nduration: 0.3\n"},
};

class SteadyGolden : public ::testing::Test {
 protected:
  SteadyGolden() { std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules"); }
  Result call(const std::string& arguments) { return gaitlab(arguments, folder / ""); }
  /// Names of the columns of a golden.
  std::vector<std::string> columns_of(const std::string& name) {
    std::vector<std::string> names;
    for (const Column& column : read_golden(folder / name).run.trace.columns) names.push_back(column.name);
    return names;
  }
  Folder folder;
};

TEST_F(SteadyGolden, IsApprovedAndKept) {
  for (const auto& [file, text] : kSteady) {
    folder.write(file, text);
    const Result result = call(std::string("approve ") + file + " --reason steady");
    EXPECT_EQ(result.code, 0) << file << result.err;
  }
  const Result same = call("test .");
  EXPECT_EQ(same.code, 0) << same.out << same.err;
}

/// A golden of a steady robot still refuses a torque that changes by more than 1e-5 of the motor's, and names that scale.
TEST_F(SteadyGolden, NoticesAnotherTorque) {
  const auto& [file, text] = kSteady[2];
  folder.write(file, text);
  ASSERT_EQ(call(std::string("approve ") + file + " --reason steady").code, 0);
  folder.write(file, text + "tolerances: {mass: 0}\nas_built: {mass: 1.001}\n");
  const Result heavier = call(std::string("test ") + file);
  EXPECT_EQ(heavier.code, 4) << heavier.out << heavier.err;
  EXPECT_NE(heavier.out.find("hinge torque"), std::string::npos) << heavier.out;
}

TEST_F(SteadyGolden, HoldsWhatTheUserSelects) {
  const std::string& text = kSteady[1].second;
  folder.write("snake.yaml", text);
  ASSERT_EQ(call("approve snake.yaml --reason usual").code, 0);
  EXPECT_EQ(columns_of("snake.golden").size(), 1U + 9 + 7) << "torque, current, angle and the pose of the base";

  ASSERT_EQ(call("approve snake.yaml --reason torques --columns 'joint.*.torque' --columns base.z").code, 0);
  const std::vector<std::string> selected{"t", "joint.0.torque", "joint.1.torque", "joint.2.torque", "base.z"};
  EXPECT_EQ(columns_of("snake.golden"), selected);
  EXPECT_EQ(call("test snake.yaml").code, 0);
  const Result again = call("approve snake.yaml --reason 'as before'");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("nothing has changed"), std::string::npos) << again.out;
  EXPECT_EQ(columns_of("snake.golden"), selected) << "a renewal keeps the selection";

  folder.write("snake.yaml", text + "trace: {columns: [joint.1.*, com.*]}\n");
  EXPECT_EQ(call("test snake.yaml").code, 0) << "the golden decides";
  ASSERT_EQ(call("approve snake.yaml --reason traced --replace").code, 0);
  EXPECT_EQ(columns_of("snake.golden"), (std::vector<std::string>{"t", "joint.1.angle", "joint.1.current", "joint.1.torque"}));
  EXPECT_EQ(call("test snake.yaml").code, 0);
}

TEST_F(SteadyGolden, RefusesASelectionOfNothing) {
  folder.write("snake.yaml", kSteady[1].second + "trace: {columns: [com.*]}\n");
  const Result none = call("approve snake.yaml --reason none");
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.err.substr(0, none.err.find(';')),
            "snake.yaml:8:18: error: matches no column that a golden holds: joint.*.torque, joint.*.current, joint.*.angle, "
            "base.x, base.y, base.z, base.qw, base.qx, base.qy, base.qz");
  const Result unknown = call("approve snake.yaml --reason unknown --columns joint.*.torc");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(unknown.err.starts_with("--columns: error: 'joint.*.torc' matches no column")) << unknown.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "snake.golden"));
}

TEST_F(SteadyGolden, SaysThatLineEndsChanged) {
  folder.write("holds.yaml", kSteady[2].second);
  ASSERT_EQ(call("approve holds.yaml --reason steady").code, 0);
  for (const char* file : {"trace.golden", "golden.json"}) {
    const std::string path = std::string("holds.golden/") + file;
    std::string damaged;
    for (const char c : read(folder / path)) damaged += c == '\n' ? std::string("\r\n") : std::string(1, c);
    folder.write(path, damaged);
    const Result result = call("test holds.yaml");
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(
        result.err,
        path + ": error: has other line ends than when it was written; `*.golden/** -text` in .gitattributes preserves them\n");
  }
}

/// The scale of a joint's column belongs to its own motor.
TEST(NaturalScales, AreThoseOfRobotAndMotors) {
  const Scenario s = scenario(
      "gaitlab: 1\nrobot: {modules: y1, docks: [[0, 1, 1, 0, 0]]}\nphysics: {engine: articulated}\nduration: 1\n"
      "actuator: {stall_torque: [0.2, 0.4], i_max: [0, 0.05]}\n");
  const ColumnList columns{{{"t", "s", {}},
                            {"joint.0.torque", "N m", {}},
                            {"joint.1.torque", "N m", {}},
                            {"joint.1.current", "A", {}},
                            {"joint.1.voltage_command", "V", {}},
                            {"contact.0.fn", "N", {}},
                            {"base.qz", "", {}},
                            {"base.x", "m", {}}}};
  const std::vector<double> found = natural_scales(s, columns);
  ASSERT_EQ(found.size(), columns.size());
  EXPECT_EQ(found[0], 0) << "time has no scale";
  EXPECT_NEAR(found[1], 0.2, 1e-12);
  EXPECT_LT(found[2], 0.4) << "limited by its current";
  EXPECT_NEAR(found[3], 0.05, 1e-12);
  EXPECT_EQ(found[4], 4.8);
  EXPECT_NEAR(found[5], 0.1 * 9.81, 1e-9) << "two modules of 50 g";
  EXPECT_EQ(found[6], 1);
  EXPECT_GT(found[7], 2 * 0.072) << "two modules in a row";
  EXPECT_LT(found[7], 0.2);
}

}  // namespace
}  // namespace gaitlab::test
