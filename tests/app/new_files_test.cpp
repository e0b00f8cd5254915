// `gaitlab new module` and `new scenario` write files that are valid and run as they stand.
#include <cstdlib>
#include <regex>
#include <sstream>
#include <tuple>

#include "app/new/chain.h"
#include "core/laws/data_sheet.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/shipped_files.h"
#include "report/figures/paper/paper_panel.h"
#include "report/figures/run/run_footfalls.h"
#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongNewFiles(
    "NewFiles.EveryModuleWithAMotorGetsAFeasibleGait:NewFiles.ThePrintedCommandsRun:NewFiles.ImportedRobotsRun:NewFiles."
    "AModuleAndItsScenarioAreFeasibleAsTheyStand",
    "long");

class NewFiles : public ::testing::Test {
 protected:
  Result call(const std::string& words) { return gaitlab("new " + words, folder / ""); }
  /// Message of a command that is refused and writes nothing.
  std::string refused(const std::string& words) {
    const Result result = call(words);
    EXPECT_EQ(result.code, 2) << words;
    EXPECT_EQ(result.out, "") << words;
    return result.err;
  }
  /// Word of the verdict on a scenario.
  std::string verdict(const std::string& scenario) {
    const Result result = gaitlab("run " + scenario + " --quiet --no-report --out run", folder / "");
    EXPECT_EQ(result.code, 0) << scenario << result.err;
    const std::string json = read(folder / "run/verdict.json");
    std::filesystem::remove_all(folder / "run");
    const std::string key = "\"verdict\": \"";
    const std::size_t at = json.find(key) + key.size();
    return json.substr(at, json.find('"', at) - at);
  }
  Folder folder;
};

TEST_F(NewFiles, AModuleAndItsScenarioAreFeasibleAsTheyStand) {
  const Result made = call("module demo");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.out,
            "demo.yaml: a module of two bodies and a hinge; replace its numbers by yours; next:\n"
            "  gaitlab explain module demo.yaml\n"
            "  gaitlab new scenario demo-walk --module demo.yaml\n"
            "  gaitlab run demo-walk.yaml\n");
  EXPECT_EQ(gaitlab("explain module demo.yaml", folder / "").code, 0);
  const Result walk = call("scenario demo-walk --module demo.yaml");
  EXPECT_EQ(walk.code, 0) << walk.err;
  EXPECT_EQ(walk.out,
            "demo-walk.yaml: 4 modules demo in a row; next:\n"
            "  gaitlab check demo-walk.yaml --page demo-walk.html\n"
            "  gaitlab run demo-walk.yaml\n");
  EXPECT_EQ(read(folder / "demo-walk.yaml").find('@'), std::string::npos);
  EXPECT_EQ(verdict("demo-walk.yaml"), "feasible");
}

/// The commands that `new module` prints, with and without --from, run as printed.
TEST_F(NewFiles, ThePrintedCommandsRun) {
  const std::string link =
      "'><inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>"
      "<visual><origin xyz='0 0 -0.1'/><geometry><box size='0.1 0.1 0.1'/></geometry></visual></link>";
  const auto urdf = [&](const std::string& name, const std::string& effort) {
    folder.write(name,
                 "<robot name='r'><link name='a" + link + "<link name='b" + link +
                     "<joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 1 0'/><limit effort='" +
                     effort + "' velocity='5' lower='-1' upper='1'/></joint></robot>");
  };
  urdf("driven.urdf", "9");
  urdf("passive.urdf", "0");
  for (const std::string words : {"module one", "module two --from driven.urdf", "module three --from passive.urdf"}) {
    const Result made = call(words);
    std::istringstream lines(made.out);
    int commands = 0;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("  ")) continue;
      ++commands;
      folder.write("next.sh",
                   "gaitlab() { '" + std::string(gaitlab::test::build_folder()) + "/bin/gaitlab' \"$@\"; }\n" + line + "\n");
      const std::string shell = "cd '" + (folder / "") + "' && bash next.sh >>out 2>>err";
      EXPECT_EQ(std::system(shell.c_str()), 0) << line << read(folder / "err");
    }
    EXPECT_EQ(commands, 3) << made.out;
  }
}

/// Small files with the habits of public robots become modules, and run in the scenario that is written for them.
TEST_F(NewFiles, ImportedRobotsRun) {
  const std::string imports = std::string(source_folder()) + "/tests/data/imports/";
  struct Row {
    const char* file;
    std::vector<std::string> notes;  ///< after the name of the file
    const char* base;                ///< expected in the scenario; empty for a floating base
  };
  const Row rows[] = {
      {"visual_is_not_contact",
       {": note: Changed: effort and velocity become the ends of a motor's line",
        ":3:3: note: Not carried over: the visual shapes of link 'body'; those of collision are drawn and touch",
        ": note: may_overlap lists 1 pair of bodies that overlap at all angles, the first 'body' and 'tail'"},
       ""},
      {"overlap_at_rest",
       {": note: Changed: effort and velocity become the ends of a motor's line",
        ":3:3: note: Changed: link 'base' has no collision; its visual shapes are its contact",
        ":4:3: note: Changed: link 'hip' has no collision; its visual shapes are its contact",
        ":5:3: note: Changed: link 'leg' has no collision; its visual shapes are its contact",
        ": note: may_overlap lists 3 pairs of bodies that overlap at all angles, the first 'base' and 'hip'"},
       ""},
      {"continuous_joint_without_limit",
       {": note: Changed: effort and velocity become the ends of a motor's line",
        (":2:3: note: Changed: link 'world' is the ground: the module has no contacts, so that new scenario writes base: fixed "
         "and no ground"),
        ":4:3: note: Changed: link 'link1' has no collision; its visual shapes are its contact",
        // 2 m g L = 2 1 kg 9.81 m/s^2 0.45 m
        ":5:3: note: Changed: joint 'joint1' has no limit of a motor; 8.83 N m at rest and 20 rad/s without load are chosen",
        ":6:3: note: Changed: link 'link2' has no collision; its visual shapes are its contact"},
       "  base: fixed "},
  };
  for (const Row& row : rows) {
    const std::string file = imports + row.file + ".urdf";
    const Result made = call("module m --from " + file);
    std::string expected;
    std::size_t changes = 0;
    for (const std::string& note : row.notes) {
      expected += file + note + "\n";
      changes += contains(note, "Changed") ? 1 : 0;
    }
    EXPECT_EQ(made.code, 0) << row.file;
    EXPECT_EQ(made.err, expected) << row.file;
    EXPECT_TRUE(made.out.ends_with(fmt::format("{} change{}; read the head of m.yaml\n", changes, changes == 1 ? "" : "s")))
        << made.out;
    EXPECT_EQ(call("scenario walk --module m.yaml").code, 0) << row.file;
    EXPECT_TRUE(contains(read(folder / "walk.yaml"), row.base)) << row.file;
    EXPECT_EQ(contains(read(folder / "walk.yaml"), "base: fixed"), *row.base != 0) << row.file;
    const Result run = gaitlab("run walk.yaml --quiet --no-report --out run", folder / "");
    EXPECT_EQ(run.code, 0) << row.file << run.err;
    for (const char* const name : {"m.yaml", "walk.yaml", "run"}) std::filesystem::remove_all(folder / name);
  }
}

/// From the URDF file of a quadruped to a verdict in three commands: the feet are on their ways, and the robot goes forwards.
TEST_F(NewFiles, AQuadrupedWalks) {
  ASSERT_EQ(call("module dog --from " + std::string(source_folder()) + "/scenarios/robots/dog.urdf").code, 0);
  ASSERT_EQ(call("scenario walk --module dog.yaml").code, 0);
  const std::string text = read(folder / "walk.yaml");
  EXPECT_TRUE(contains(text, "# Scenario walk: a trot of dog.")) << text;
  EXPECT_TRUE(contains(text, "  period: 0.002 ")) << text;
  const Scenario scenario = read_scenario(folder / "walk.yaml", {"duration=4"}, catalog());
  const RobotInfo robot = plugin_info(scenario);
  ASSERT_EQ(robot.legs.size(), 4U);
  EXPECT_EQ(robot.legs[2].name, "rear_left");
  Simulation simulation({&scenario, 1}, Loads::recorded);
  simulation.run();
  const Recording record = simulation.take_recording(0);
  const report::Summary summary = report::summarise(scenario, record, 0);
  ASSERT_TRUE(summary.fall && *summary.fall);
  EXPECT_FALSE((*summary.fall)->time) << "it falls";
  // Half of stride times frequency over the time after the ramp, as asked of imported robots; it goes at 0.95 of it.
  EXPECT_TRUE(contains(text, "frequency: 1.9 ") && contains(text, "stride: 0.1 ")) << text;
  EXPECT_GT(Table(record.trace)(4, "base.x") - Table(record.trace)(1, "base.x"), 0.5 * 0.1 * 1.9 * 3);
  EXPECT_LT(std::abs(Table(record.trace)(4, "base.y") - Table(record.trace)(1, "base.y")), 0.05);
  // The footfalls of a robot of one module are those of its legs, from the loads of its bodies. A trot stands for half of the
  // time.
  const std::vector<double> time = report::row_times(record);
  const std::vector<report::Footfall> falls = report::footfalls(scenario, record, robot.legs, time, 1);
  ASSERT_EQ(falls.size(), 4U);
  for (const report::Footfall& leg : falls) EXPECT_NEAR(leg.duty_factor, 0.5, 0.15) << leg.name;
  EXPECT_EQ(falls[1].name, "front right");
  // The start follows from the gait again where the resolved text is read, and where settings change.
  const std::string again = resolved(scenario);
  EXPECT_FALSE(contains(again, "  angles:")) << again;
  const Scenario same = read_scenario(folder.write("again.yaml", again), {}, catalog());
  EXPECT_EQ(same.initial.angles, scenario.initial.angles);
  EXPECT_EQ(plugin_info(same).legs[0].foot, robot.legs[0].foot);
  const Scenario lower = read_scenario(folder / "again.yaml", {"cpg.model.stance=0.6"}, catalog());
  const auto knee = static_cast<std::size_t>(robot.legs[0].joints.back());
  EXPECT_LT(lower.initial.angles[knee], scenario.initial.angles[knee] - 0.1) << "the knee bends more";
  EXPECT_TRUE(contains(message_of([&] {
                         read_scenario(folder / "again.yaml", {"cpg.model.stance=0.6", "initial.angles=0"}, catalog());
                       }),
                       "stance and initial.angles are both given"));
}

/// The robots that come with the program are as these commands write them, except for names and the first line.
TEST_F(NewFiles, ShippedImportsAreAsWritten) {
  for (const auto& [name, file, scenario] :
       {std::tuple{"dog12", "dog.urdf", "dog-trot"}, {"beetle18", "beetle.xml", "beetle-tripod"}}) {
    ASSERT_EQ(
        call("module my_robot --out my_robot_" + std::string(name) + ".yaml --from " + kScenarios + "robots/" + file).code, 0);
    const std::string made =
        std::regex_replace(read(folder / ("my_robot_" + std::string(name) + ".yaml")), std::regex("my_robot"), name);
    EXPECT_EQ(made, read(kScenarios + "modules/" + name + ".yaml"));
    ASSERT_EQ(call("scenario " + std::string(scenario) + " --module " + name).code, 0);
    const auto after_head = [](const std::string& text) { return text.substr(text.find('\n')); };
    EXPECT_EQ(after_head(read(folder / (std::string(scenario) + ".yaml"))),
              after_head(read(kScenarios + "imported/" + scenario + ".yaml")));
  }
}

/// Without --from, --lock has no joints; a pattern that matches none, and what is refused, leave no file.
TEST_F(NewFiles, LockNeedsJoints) {
  const std::string file = std::string(source_folder()) + "/tests/data/imports/prismatic_fingers.urdf";
  EXPECT_EQ(refused("module m --lock x"),
            "gaitlab new module: error: --from is missing: URDF or MJCF file of the robot, instead of an example; expected "
            "gaitlab new "
            "module NAME\n");
  const std::string sliding =
      file +
      ":14:3: error: joint 'finger_left' is prismatic; a module has hinges; they are fixed at 0 by --lock "
      "finger_left --lock finger_right\n" +
      file + ":17:3: error: joint 'finger_right' is prismatic; a module has hinges\n";
  EXPECT_EQ(refused("module m --from " + file), sliding);
  EXPECT_EQ(refused("module m --from " + file + " --lock wrists"),
            "--lock: error: no joint 'wrists'; did you mean 'wrist'?\n" + sliding);
  EXPECT_FALSE(std::filesystem::exists(folder / "m.yaml"));
  EXPECT_EQ(call("module m --from " + file + " --lock 'finger*'").code, 0);
}

TEST_F(NewFiles, TheGainOfTheExampleIsTheUsualOne) {
  EXPECT_EQ(call("module demo").code, 0);
  EXPECT_TRUE(contains(read(folder / "demo.yaml"), fmt::format("Kp: {:.2g} ", gain_of_share(kUsualShare, 4.8, 4.553, 0.015))));
}

TEST_F(NewFiles, EveryModuleWithAMotorGetsAFeasibleGait) {
  for (const auto& [name, file] : shipped_files("module")) {
    const Result made = call("scenario s --module " + name);
    if (name == "revolve_brick" || name == "revolve_core") {
      EXPECT_EQ(made.err,
                file + ": error: module '" + name +
                    "' has no hinge with a motor, but a gait needs one; dock it to modules that have one, in their scenario\n");
      continue;
    }
    ASSERT_EQ(made.code, 0) << name << made.err;
    const std::string err = gaitlab("check s.yaml", folder / "").err;
    EXPECT_EQ(std::regex_replace(err, std::regex("^s.yaml: note: cpg: [46] legs: .*\n"), ""), "") << name;
    EXPECT_EQ(made.err, "") << name;
    EXPECT_EQ(verdict("s.yaml"), "feasible") << name;
    std::filesystem::remove(folder / "s.yaml");
  }
}

/// A hinge of 0.5 rad/s and 1 N m is between bodies of 5 kg and 0.2 m. With the usual friction it reaches 0.42 rad/s. Half of
/// this speed is 0.4 rad * 2 pi * 0.084 Hz. The weight of n modules of 10 kg and 0.4 m bends the row by n^2 10 kg 9.81 m/s^2
/// 0.4 m / 8 = 4.9 N m n^2, so that the row has one module. Its weight on each of four points is 24.5 N, under which 1e4 N/m
/// sink by 2.45 mm.
TEST_F(NewFiles, AGaitFitsTheMotorsAndTheWeight) {
  const std::string box = "mass: 5, shape: [{box: [0.2, 0.2, 0.2], origin: [";
  folder.write(
      "slow.yaml",
      "gaitlab_module: 1\nname: slow\nbodies:\n  a: {" + box + "-0.1, 0, 0]}]}\n  b: {" + box +
          "0.1, 0, 0]}]}\nhinges:\n  - {name: hinge, parent: a, child: b, axis: [0, 0, 1], range: [-1, 1]}\n"
          "actuator: {type: servo, voltage: 5, stall_torque: 1, no_load_speed: 0.5}\ncontacts: {all: shapes}\n"
          "faces:\n  - {id: 0, body: a, gender: none, origin: [-0.2, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}\n"
          "  - {id: 1, body: b, gender: none, origin: [0.2, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}\n");
  const Result made = call("scenario slow-walk --module slow.yaml");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(made.out.starts_with("slow-walk.yaml: one module slow; next:\n")) << made.out;
  const std::string text = read(folder / "slow-walk.yaml");
  EXPECT_TRUE(contains(text, "  frequency: 0.084 ")) << text;
  EXPECT_TRUE(contains(text, "duration: 48 ")) << text;
  EXPECT_TRUE(contains(text, "  stiffness: 30000 ")) << text;
  EXPECT_TRUE(contains(text, "  damping: 300000 ")) << text;
}

TEST_F(NewFiles, AFileStatesWhyItsGaitIsNotFeasible) {
  folder.write(
      "weak.yaml",
      "gaitlab_module: 1\nname: weak\nbodies:\n  a: {mass: 1, shape: [{box: [0.1, 0.1, 0.1], origin: [-0.05, 0, 0]}]}\n"
      "  b: {mass: 1, shape: [{box: [0.1, 0.1, 0.1], origin: [0.05, 0, 0]}]}\n"
      "hinges:\n  - {name: hinge, parent: a, child: b, axis: [0, 1, 0], range: [-1, 1]}\n"
      "actuator: {type: servo, voltage: 5, stall_torque: 0.01, no_load_speed: 5}\ncontacts: {all: shapes}\n");
  const Result made = call("scenario walk --module weak.yaml");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(made.err.starts_with("walk.yaml: note: as it stands infeasible: ")) << made.err;
  const std::string text = read(folder / "walk.yaml");
  EXPECT_TRUE(contains(text, "# Scenario walk: a wave along one module weak. As it stands infeasible: ")) << text;
  EXPECT_TRUE(contains(text, "amplitude: 0.4 ")) << text;
  EXPECT_EQ(verdict("walk.yaml"), "infeasible");
}

TEST_F(NewFiles, AFileIsNeverReplaced) {
  folder.write("demo.yaml", "mine");
  EXPECT_EQ(refused("module demo"), "demo.yaml: error: exists; nothing was written\n");
  EXPECT_EQ(refused("scenario demo"), "demo.yaml: error: exists; nothing was written\n");
  EXPECT_EQ(read(folder / "demo.yaml"), "mine");
  EXPECT_EQ(call("module demo --out other.yaml").code, 0);
  EXPECT_NE(read(folder / "other.yaml").find("name: demo\n"), std::string::npos);
}

TEST_F(NewFiles, NamesAreChecked) {
  const std::string rule = " is not allowed; expected letters, digits, `_` and `-`, beginning with a letter\n";
  EXPECT_EQ(refused("module 3legs"), "gaitlab new module: error: name '3legs'" + rule);
  EXPECT_EQ(refused("module ../up"), "gaitlab new module: error: name '../up'" + rule);
  EXPECT_EQ(refused("scenario a.b"), "gaitlab new scenario: error: name 'a.b'" + rule);
  EXPECT_EQ(refused("module y1"), "gaitlab new module: error: module 'y1' comes with the program; choose another name\n");
  EXPECT_EQ(refused("scenario walk --module y2"), "--module: error: no module 'y2'; did you mean 'y1'?\n");
  // A word that YAML reads as another type is quoted.
  EXPECT_EQ(call("module null").code, 0);
  EXPECT_EQ(call("scenario true --module null.yaml").code, 0);
  EXPECT_EQ(gaitlab("check true.yaml", folder / "").code, 0);
}

TEST_F(NewFiles, TheModuleIsNamedFromTheFolderOfTheScenario) {
  std::filesystem::create_directory(folder / "my modules");
  std::filesystem::create_directory(folder / "walks");
  EXPECT_EQ(call("module demo --out 'my modules/demo.yaml'").code, 0);
  const Result made = call("scenario far --module 'my modules/demo.yaml' --out walks/far.yaml");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(contains(read(folder / "walks/far.yaml"), "modules: \"../my modules/demo.yaml\"\n"))
      << read(folder / "walks/far.yaml");
  EXPECT_EQ(gaitlab("check walks/far.yaml", folder / "").code, 0);
}

/// The gait of a leg whose knee bends only one way stays within the range. Without faces and contact elements, the leg has a
/// fixed base.
TEST_F(NewFiles, AGaitFitsTheRangesOfTheHinges) {
  folder.write("leg.yaml",
               "gaitlab_module: 1\nname: leg\nbodies:\n"
               "  hip: {mass: 1, inertia: [0.01, 0.01, 0.01, 0, 0, 0]}\n"
               "  thigh: {mass: 0.1, com: [0, 0, -0.05], inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]}\n"
               "  shin: {mass: 0.1, com: [0, 0, -0.05], inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]}\n"
               "hinges:\n"
               "  - {name: hip, parent: hip, child: thigh, axis: [0, 1, 0], range: [-1, 1]}\n"
               "  - {name: knee, parent: thigh, child: shin, origin: [0, 0, -0.1], axis: [0, 1, 0], range: [0.2, 0.8]}\n");
  const Result made = call("scenario step --module leg.yaml");
  EXPECT_EQ(made.code, 0) << made.err;
  const std::string text = read(folder / "step.yaml");
  EXPECT_TRUE(contains(text, "initial: {angles: {default: 0, \"*/knee\": 0.5}}")) << text;
  EXPECT_TRUE(contains(text, "amplitude: {default: 0.4, \"*/knee\": 0.24}")) << text;
  EXPECT_TRUE(contains(text, "offset: {default: 0, \"*/knee\": 0.5}")) << text;
  EXPECT_TRUE(contains(text, "  base: fixed")) << text;
  EXPECT_EQ(verdict("step.yaml"), "feasible");
}

TEST_F(NewFiles, AModuleWithFeetAloneStandsOnThem) {
  folder.write("foot.yaml",
               "gaitlab_module: 1\nname: foot\nbodies:\n  sole: {mass: 1, shape: [{box: [0.2, 0.2, 0.02]}]}\n"
               "  mast: {mass: 0.1, com: [0, 0, 0.05], shape: [{box: [0.01, 0.01, 0.1], origin: [0, 0, 0.05]}]}\n"
               "hinges:\n  - {name: ankle, parent: sole, child: mast, origin: [0, 0, 0.02], axis: [0, 1, 0], range: [-1, 1]}\n"
               "contacts: {feet: shapes, all: []}\nactuator: {type: servo, voltage: 5, stall_torque: 1, no_load_speed: 5}\n");
  EXPECT_EQ(call("scenario stand --module foot.yaml").code, 0);
  EXPECT_TRUE(contains(read(folder / "stand.yaml"), "  on: feet ")) << read(folder / "stand.yaml");
  EXPECT_EQ(gaitlab("check stand.yaml", folder / "").code, 0);
}

TEST_F(NewFiles, AModuleWithFaultsIsRefusedWithThem) {
  folder.write("bad.yaml", "gaitlab_module: 1\nname: bad\nbodies: {b: {mass: -1}}\n");
  EXPECT_EQ(refused("scenario walk --module bad.yaml"), "bad.yaml:3:20: error: mass is -1 kg; expected at least 0 kg\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "walk.yaml"));
}

/// The docks are those of the shipped build files of rows.
TEST(Chain, IsThatOfTheBuildFiles) {
  const auto docks = [](const std::string& module) {
    return app::chain(read_module(kScenarios + "modules/" + module + ".yaml", catalog()), 3);
  };
  const std::vector<Dock> mtran = docks("mtran");
  ASSERT_EQ(mtran.size(), 2U);
  EXPECT_EQ(mtran[1].child_module, 2);
  EXPECT_EQ(mtran[1].parent_module, 1);
  EXPECT_EQ(mtran[1].child_face, 1) << "end to end: 1 on 4 (docs/modules.md)";
  EXPECT_EQ(mtran[1].parent_face, 4);
  EXPECT_EQ(docks("atron").size(), 1U) << "its faces point 45 degrees up and down";
  EXPECT_TRUE(docks("rod").empty());
}

}  // namespace
}  // namespace gaitlab::test
