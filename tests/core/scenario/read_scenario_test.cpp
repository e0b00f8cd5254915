// Tests of read_scenario with complete scenarios.
#include "core/scenario/read_scenario.h"

#include <gtest/gtest.h>

#include "core/scenario/plugin_files.h"
#include "core/scenario/resolved.h"
#include "tests/core/scenario/fixture.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

using fakes::kShort;
using fakes::kTwo;
using fakes::ScenarioTest;

TEST_F(ScenarioTest, EveryKeyButRobotAndDurationHasADefault) {
  const Scenario s = read(kShort);
  EXPECT_EQ(s.name, "s");
  EXPECT_EQ(s.robot->modules.size(), 1U);
  EXPECT_EQ(s.base, Base::floating);
  EXPECT_TRUE(s.on_ground);
  EXPECT_EQ(s.physics.engine->name, "bullet");
  EXPECT_EQ(s.physics.step, 2.5e-5);
  EXPECT_EQ(s.physics.integrator->name, "semi_implicit");
  EXPECT_EQ(s.physics.gravity.z(), -9.81);
  EXPECT_TRUE(s.ground.is_plane());
  EXPECT_EQ(s.contact.on, ContactSet::feet);
  EXPECT_EQ(s.actuator.entry->name, "dc_motor");
  EXPECT_EQ(s.controller.entry->name, "pid");
  EXPECT_EQ(s.cpg.entry, nullptr);
  EXPECT_EQ(s.control_period, 0.015);
  EXPECT_EQ(s.trace.period, 0.005);
  EXPECT_EQ(s.seed, 1);
  EXPECT_EQ(error("{}"), "DIR/s.yaml:1:1: error: missing key 'robot'\nDIR/s.yaml:1:1: error: missing key 'duration'");
}

TEST_F(ScenarioTest, AllErrorsAtOnceInTheFilesOrder) {
  EXPECT_EQ(error("robot: {modules: duo, bse: fixed}\n"
                  "physics: {step: fast, engin: bullet}\n"
                  "contact: {stifness: 3, on: foot, exponent: .nan}\n"
                  "actuator: {R: -4, R: 4}\n"
                  "cpg: {type: phase_osc}\n"
                  "duration: .inf\n"
                  "sensors: [imu]\n"
                  "phyics: {}\n"),
            "DIR/s.yaml:1:23: error: unknown key 'bse'; did you mean 'base'?\n"
            "DIR/s.yaml:2:17: error: step is 'fast'; expected a number in s, or auto\n"
            "DIR/s.yaml:2:23: error: unknown key 'engin'; did you mean 'engine'?\n"
            "DIR/s.yaml:3:11: error: unknown key 'stifness'; did you mean 'stiffness'?\n"
            "DIR/s.yaml:3:28: error: on 'foot' is unknown; known names: none, feet, all\n"
            "DIR/s.yaml:3:44: error: exponent is .nan; expected a finite number\n"
            "DIR/s.yaml:4:15: error: R is -4 Ohm; expected 0.001 to 1000 Ohm\n"
            "DIR/s.yaml:4:19: error: duplicate key 'R'\n"
            "DIR/s.yaml:4:12: note: it is given here first\n"
            "DIR/s.yaml:5:13: error: type 'phase_osc' is unknown; did you mean 'phase_oscillator'?\n"
            "DIR/s.yaml:6:11: error: duration is .inf; expected a finite number in s\n"
            "DIR/s.yaml:7:10: error: sensors is a list of 1; expected a map of sensors by name, such as {imu: "
            "{type: imu, body: m0/active}}, or {} for none\n"
            "DIR/s.yaml:8:1: error: unknown key 'phyics'; did you mean 'physics'?");
}

/// A message prints 200 problems. The search for a name, which costs most, ends there.
TEST_F(ScenarioTest, UnknownKeysBeyondThoseThatArePrintedGetNoOffer) {
  std::string text = kShort;
  for (int k = 0; k < 300; ++k) text += "durations" + std::to_string(k) + ": 1\n";
  try {
    read(text);
    FAIL();
  } catch (const InputError& e) {
    ASSERT_EQ(e.problems().size(), 300U);
    EXPECT_EQ(e.problems()[199].text, "unknown key 'durations199'; did you mean 'duration'?");
    EXPECT_EQ(e.problems()[200].text, "unknown key 'durations200'");
  }
}

TEST_F(ScenarioTest, VersionAndName) {
  EXPECT_EQ(error("gaitlab: 2\nfuture: 1\n"), "DIR/s.yaml:1:10: error: gaitlab is 2; expected 1, the only format version");
  EXPECT_EQ(error(kShort + "name: a/b\n"),
            "DIR/s.yaml:3:7: error: name 'a/b' is not allowed; expected letters, digits, `_`, `.` and `-`, but no `.` at the "
            "start");
  EXPECT_EQ(error(kShort + "name: ..\n"),
            "DIR/s.yaml:3:7: error: name '..' is not allowed; expected letters, digits, `_`, `.` and `-`, but no `.` at the "
            "start");
  EXPECT_EQ(folder_.shown(test::message_of([&] { read_scenario(folder_.write("my walk.yaml", kShort), {}, catalog_); })),
            "DIR/my walk.yaml: error: name 'my walk' is not allowed; expected letters, digits, `_`, `.` and `-`, but no `.` at "
            "the start (it is the file's name; give another with name:)");
}

TEST_F(ScenarioTest, AMissingFile) {
  EXPECT_EQ(folder_.shown(test::message_of([&] { read_scenario(folder_.path() + "/none.yaml", {}, catalog_); })),
            "DIR/none.yaml: error: cannot be read: No such file or directory");
  EXPECT_EQ(error("robot: {modules: duo, build: none.dat}\nduration: 1\n"),
            "DIR/s.yaml:1:30: error: file 'DIR/none.dat' cannot be read: No such file or directory");
  EXPECT_EQ(error("robot: {modules: ./foot.yaml}\nduration: 1\n"),
            "DIR/s.yaml:1:18: error: file 'DIR/foot.yaml' cannot be read: No such file or directory");
}

TEST_F(ScenarioTest, ModuleTypes) {
  const std::string two = "  docks: [[1, 1, 4, 0, 0]]\nduration: 1\n";
  const std::string missing = error("robot: {modules: due}\nduration: 1\n");
  EXPECT_EQ(missing.find("DIR/s.yaml:1:18: error: no module type 'due'; did you mean 'duo'?\n"
                         "DIR/s.yaml:1:18: note: looked in DIR/modules, "),
            0U)
      << missing;
  std::string other = fakes::kDuo;
  other.replace(other.find("mass: 1,"), 8, "mass: 2,");
  folder_.write("other.yaml", other);
  const Scenario s = read("robot:\n  modules: {1: ./other.yaml, default: duo}\n" + two);
  ASSERT_EQ(s.robot->types.size(), 2U);
  EXPECT_EQ(s.robot->types[1].bodies[0].mass, 2);
  EXPECT_EQ(s.robot->modules[1].type, 1U);
  EXPECT_NE(resolved(s).find("  modules: {default: duo, 1: duo-2}\n"), std::string::npos);
  expect_stable(s);
  EXPECT_EQ(error("robot:\n  modules: {0: duo, 2: duo}\n" + two),
            "DIR/s.yaml:2:12: error: modules has no type for module 1; add it, or default: TYPE\n"
            "DIR/s.yaml:2:21: error: there is no module 2; the robot has modules 0 to 1");
  EXPECT_EQ(error("robot:\n  modules: {defualt: duo}\n" + two),
            "DIR/s.yaml:2:12: error: modules has no type for module 0; add it, or default: TYPE\n"
            "DIR/s.yaml:2:13: error: unknown key 'defualt' in modules; expected the number of a module, or `default`");
}

TEST_F(ScenarioTest, TheDefaultTypeIsMtran) {
  folder_.write("modules/mtran.yaml", fakes::kDuo);
  EXPECT_EQ(read("robot: {}\nduration: 1\n").robot->modules.size(), 1U);
}

TEST_F(ScenarioTest, ASmallTextAsksForNoHugeRobot) {
  EXPECT_NE(error("robot: {modules: duo, docks: [[1, 10000, 4, 0, 0]]}\nduration: 1\n").find("gap in the numbering"),
            std::string::npos);
}

TEST_F(ScenarioTest, InlineModuleTypes) {
  std::string indented;
  for (const char c : std::string(fakes::kDuo)) indented += c == '\n' ? "\n    " : std::string(1, c);
  const Scenario s = read("robot:\n  modules:\n    " + indented + "\nduration: 1\n");
  EXPECT_EQ(s.robot->types[0].name, "duo");
  expect_stable(s);
  EXPECT_EQ(error("robot: {modules: {name: x, bodies: {a: {mass: 0}}}}\nduration: 1\n"),
            "DIR/s.yaml:1:37: error: body 'a' has no mass; only a body between two hinges may have mass 0");
}

TEST_F(ScenarioTest, ErrorsOfABrokenModuleFileAreShownOnce) {
  folder_.write("bad.yaml", "gaitlab_module: 1\nname: bad\nbodies: {a: {mass: 1, mass: 2}}\n");
  EXPECT_EQ(error("robot: {modules: bad.yaml, docks: [[1, 1, 4, 0, 0]]}\nduration: 1\nsede: 1\n"),
            "DIR/s.yaml:3:1: error: unknown key 'sede'; did you mean 'seed'?\n"
            "DIR/bad.yaml:3:23: error: duplicate key 'mass'\nDIR/bad.yaml:3:14: note: it is given here first\n"
            "DIR/bad.yaml:3:10: error: body 'a' has neither inertia nor shape; expected inertia, or shape, from which it "
            "follows");
}

TEST_F(ScenarioTest, BuildFilesAndAssemblyErrorsKeepTheirPlace) {
  folder_.write("two.dat", "# one connection\n  1 1 4 0 0\n");
  EXPECT_EQ(read("robot: {modules: duo, build: two.dat}\nduration: 1\n").robot->modules.size(), 2U);
  folder_.write("two.dat", "# one connection\n  1 1 4 0 7\n");
  const std::string text = error("robot: {modules: duo, build: two.dat}\nduration: -1\n");
  EXPECT_EQ(
      text.find("DIR/s.yaml:2:11: error: duration is -1 s; expected more than 0 and up to 1000000 s\nDIR/two.dat:2:3: error: "),
      0U)
      << text;
  EXPECT_EQ(error("robot: {modules: duo, build: two.dat, docks: []}\nduration: 1\n"),
            "DIR/s.yaml:1:30: error: robot has both build and docks; expected one\nDIR/s.yaml:1:46: note: docks is here");
}

TEST_F(ScenarioTest, WhereTheBaseStands) {
  const Scenario s = read("robot: {modules: duo, base: fixed, position: [0, 0, 1.2]}\nduration: 1\n");
  EXPECT_EQ(s.base, Base::fixed);
  EXPECT_FALSE(s.on_ground);
  EXPECT_EQ(s.position.z(), 1.2);
  expect_stable(s);
  EXPECT_TRUE(read("robot: {modules: duo, base: planar, on_ground: true}\nduration: 1\n").on_ground);
}

TEST_F(ScenarioTest, APositionOfTwoNumbersKeepsOnGround) {
  for (const char* on_ground : {"", ", on_ground: true"}) {
    const Scenario s = read(std::string("robot: {modules: duo, position: [0.5, -2]") + on_ground + "}\nduration: 1\n");
    EXPECT_TRUE(s.on_ground);
    EXPECT_EQ(s.position, Vec3(0.5, -2, 0));
    expect_stable(s);
    EXPECT_NE(resolved(s).find("\n  on_ground: true\n  position: [0.5, -2]\n"), std::string::npos) << resolved(s);
  }
  const Scenario high = read("robot: {modules: duo, position: [0.5, -2, 3], on_ground: false}\nduration: 1\n");
  EXPECT_FALSE(high.on_ground);
  EXPECT_EQ(high.position, Vec3(0.5, -2, 3));
  EXPECT_NE(resolved(high).find("\n  on_ground: false\n  position: [0.5, -2, 3]\n"), std::string::npos);
  // A position at the origin is the default, so that the resolved scenario is the same.
  const Scenario origin = read("robot: {modules: duo, position: [0, 0]}\nduration: 1\n");
  EXPECT_TRUE(origin.on_ground);
  EXPECT_EQ(resolved(origin), resolved(read("robot: {modules: duo}\nduration: 1\n")));
  EXPECT_EQ(read("robot: {modules: duo, on_ground: false}\nduration: 1\n").position, Vec3(0, 0, 0));
}

TEST_F(ScenarioTest, ErrorsOfAPositionNameBothForms) {
  EXPECT_EQ(error("robot: {modules: duo, on_ground: true, position: [0, 0, 1]}\nduration: 1\n"),
            "DIR/s.yaml:1:50: error: position has a height, but on_ground is true; expected [x, y], or no on_ground\n"
            "DIR/s.yaml:1:34: note: on_ground is here");
  EXPECT_EQ(error("robot: {modules: duo, on_ground: false, position: [0, 1]}\nduration: 1\n"),
            "DIR/s.yaml:1:51: error: position has no height, but on_ground is false; expected [x, y, z], or no on_ground\n"
            "DIR/s.yaml:1:34: note: on_ground is here");
  const std::string forms = "; expected [x, y] (on_ground gives the height) or [x, y, z] (on_ground is off)";
  EXPECT_EQ(error("robot: {modules: duo, position: []}\nduration: 1\n"),
            "DIR/s.yaml:1:33: error: position has 0 numbers" + forms);
  EXPECT_EQ(error("robot: {modules: duo, position: [1]}\nduration: 1\n"),
            "DIR/s.yaml:1:33: error: position has 1 number" + forms);
  EXPECT_EQ(error("robot: {modules: duo, on_ground: false, position: [1, 2, 3, 4]}\nduration: 1\n"),
            "DIR/s.yaml:1:51: error: position has 4 numbers" + forms);
  EXPECT_EQ(error("robot: {modules: duo, position: 3}\nduration: 1\n"),
            "DIR/s.yaml:1:33: error: position is 3; expected a list of numbers in m");
  EXPECT_EQ(error("robot: {modules: duo, position: [0, far]}\nduration: 1\n"),
            "DIR/s.yaml:1:37: error: position[1] is 'far'; expected a number in m");
}

TEST_F(ScenarioTest, LimitsThatContradictOneAnother) {
  EXPECT_EQ(read(kShort + "limits: {touch: 0.002}\n").limits.touch, 0.002);  // equal to limits.collision, thus no warnings
  const std::string text = "limits.touch, above which bodies that touch are a warning, is ";
  EXPECT_EQ(error(kShort + "limits: {touch: 0.02, collision: 0.01}\n"),
            "DIR/s.yaml:3:17: error: " + text +
                "0.02 m, and limits.collision, above which they are a failure, is 0.01 m; expected limits.touch of at most "
                "0.01 m, or limits.collision of at least 0.02 m\nDIR/s.yaml:3:34: note: limits.collision is here");
  EXPECT_EQ(error(kShort + "limits: {touch: 0.02}\n"),
            "DIR/s.yaml:3:17: error: " + text +
                "0.02 m, and limits.collision, above which they are a failure, is 0.002 m by default; expected limits.touch of "
                "at most 0.002 m, or limits.collision of at least 0.02 m");
  EXPECT_EQ(error(kShort, {"limits.collision=1e-4"}),
            "--set limits.collision=1e-4: error: " + text +
                "0.0005 m by default, and limits.collision, above which they are a failure, is 0.0001 m; expected limits.touch "
                "of at most 0.0001 m, or limits.collision of at least 0.0005 m");
  // The resolved scenario of an old run is read as a record, which permits touch above collision.
  const Scenario old = read_record(kShort + "limits: {touch: 0.02, collision: 0.01}\n", folder_ / "old.yaml", {}, catalog_);
  EXPECT_EQ(old.limits.touch, 0.02);
  EXPECT_EQ(old.limits.meeting(), 0.01);
}

TEST_F(ScenarioTest, LimitsBeyondWhatTheyAreSharesOf) {
  EXPECT_EQ(error(kShort + "limits: {energy_residual: 1.1}\n"),
            "DIR/s.yaml:3:27: error: energy_residual is 1.1; expected 0 to 1");
  EXPECT_EQ(error(kShort + "limits: {saturated_share: 1.1, warn_share: 1.2}\n"),
            "DIR/s.yaml:3:27: error: saturated_share is 1.1; expected 0 to 1\n"
            "DIR/s.yaml:3:44: error: warn_share is 1.2; expected 0 to 1");
  EXPECT_EQ(error(kShort + "limits: {tracking_error: 0}\n"),
            "DIR/s.yaml:3:26: error: tracking_error is 0 rad; expected more than 0 and up to 1000 rad");
}

TEST_F(ScenarioTest, PeriodsAreWholeMultiples) {
  EXPECT_EQ(
      error(kShort + "physics: {step: 7e-5}\ntrace: {period: 0.0049}\n"),
      "DIR/s.yaml:2:11: error: duration 1 s is not a whole multiple of the step 7e-05 s (14285.7142857 steps); steps that "
      "fit: 5e-05, 0.0001; periods that fit: 0.99995, 1.00002\n"
      "DIR/s.yaml:3:17: error: control period 0.015 s is not a whole multiple of the step 7e-05 s (214.285714286 steps); "
      "steps that fit: 5e-05, 0.0001");
  EXPECT_EQ(
      error(kShort + "cpg: {step: 0.004}\n"),
      "DIR/s.yaml:3:13: error: control period 0.015 s is not a whole multiple of the CPG step 0.004 s (3.75 steps); steps "
      "that fit: 0.00375, 0.005");
  EXPECT_EQ(error(kShort + "controller: {period: 0.01501}\n"),
            "DIR/s.yaml:3:22: error: control period 0.01501 s is not a whole multiple of the step 2.5e-05 s (600.4 steps); "
            "periods that fit: 0.015, 0.015025");
}

TEST_F(ScenarioTest, CommandUnitsMustAgree) {
  EXPECT_EQ(error(kShort + "actuator: {type: torque}\ncontroller: {type: pid}\n"),
            "DIR/s.yaml:4:20: error: controller 'pid' commands V, but actuator 'torque' takes N m\n"
            "DIR/s.yaml:3:18: note: actuator 'torque' takes N m");
  EXPECT_EQ(error(kShort + "actuator: {type: torque}\n"),
            "DIR/s.yaml:3:18: error: the default controller 'pid' commands V, but actuator 'torque' takes N m\n"
            "DIR/s.yaml:3:18: note: add for example controller: {unit: N m, Kp: ...}");
  EXPECT_EQ(error(kShort + "actuator: {type: torque}\ncontroller: {type: hold}\n"), test::kNoError);
}

TEST_F(ScenarioTest, WithoutAnActuatorThereIsNoController) {
  const Scenario s = read(kShort + "actuator: {type: none}\n");
  EXPECT_EQ(s.actuator.entry, nullptr);
  EXPECT_EQ(s.controller.entry, nullptr);
  expect_stable(s);
  EXPECT_EQ(error(kShort + "actuator: {type: none}\ncontroller: {type: pid}\n"),
            "DIR/s.yaml:4:1: error: a controller is given, but there is no actuator to command; remove this section\n"
            "DIR/s.yaml:3:18: note: the actuator is none");
  EXPECT_EQ(error(kShort + "actuator: {type: none, R: 3}\n"),
            "DIR/s.yaml:3:24: error: unknown key 'R'; R is a key of actuator dc_motor, torque");
}

TEST_F(ScenarioTest, TheModuleTypesMotor) {
  folder_.write("modules/strong.yaml",
                std::string(fakes::kDuo) + "actuator: {type: dc_motor, R: 2, i_max: 3, source: chosen}\n");
  folder_.write("modules/weak.yaml", std::string(fakes::kDuo) + "actuator: {type: torque}\n");
  const auto motor = [](const Scenario& s) { return static_cast<fakes::Motor::Settings*>(s.actuator.settings.get()); };
  const Scenario s = read("robot: {modules: strong}\nactuator: {R: 5}\nduration: 1\n");
  EXPECT_EQ(motor(s)->R[0], 5);
  EXPECT_EQ(motor(s)->i_max, 3);
  expect_stable(s);
  EXPECT_EQ(read("robot: {modules: weak}\ncontroller: {type: hold}\nduration: 1\n").actuator.entry->name, "torque");
  EXPECT_EQ(read("robot: {modules: weak}\nactuator: {type: dc_motor}\nduration: 1\n").actuator.entry->name, "dc_motor");
  const std::string both = "robot:\n  modules: {0: strong, 1: weak}\n  docks: [[1, 1, 4, 0, 0]]\nduration: 1\n";
  EXPECT_EQ(error(both),
            "DIR/s.yaml:1:1: error: the module types have different actuators; choose one: add actuator: {type: ...}\n"
            "DIR/modules/strong.yaml:19:11: note: one is here\n"
            "DIR/modules/weak.yaml:19:11: note: one is here");
  EXPECT_EQ(read(both + "actuator: {type: dc_motor}\n").actuator.entry->name, "dc_motor");
  folder_.write("modules/strong.yaml", std::string(fakes::kDuo) + "actuator: {type: dc_motor, Rr: 2}\n");
  EXPECT_EQ(error("robot: {modules: strong}\nduration: 1\n"),
            "DIR/modules/strong.yaml:19:28: error: unknown key 'Rr'; did you mean 'R'?");
}

TEST_F(ScenarioTest, InitialAnglesStayInTheHingesRange) {
  EXPECT_EQ(error(kTwo + "initial: {angles: 1.6}\n"),
            "DIR/s.yaml:5:19: error: the initial angle of joint 'm0/h' is 1.6 rad; expected -1.5 to 1.5 rad; 1 more joint "
            "is also outside the range");
  EXPECT_EQ(error(kTwo + "initial: {angles: [0, -1.6]}\n"),
            "DIR/s.yaml:5:23: error: the initial angle of joint 'm1/h' is -1.6 rad; expected -1.5 to 1.5 rad");
  EXPECT_EQ(error(kTwo + "initial: {angles: {m1/h: 2}}\n"),
            "DIR/s.yaml:5:26: error: the initial angle of joint 'm1/h' is 2 rad; expected -1.5 to 1.5 rad");
  EXPECT_EQ(error(kTwo + "initial: {angles: [0]}\n"),
            "DIR/s.yaml:5:19: error: angles has 1 number; expected one for each of the robot's 2 joints");
}

TEST_F(ScenarioTest, WhatAPluginRefusesIsBadInput) {
  EXPECT_EQ(error(kShort + "cpg: {type: picky}\n"), "DIR/s.yaml:3:13: error: cpg 'picky': needs six legs; the robot has none");
}

TEST_F(ScenarioTest, Engines) {
  EXPECT_EQ(error(kShort + "physics: {engine: bulet, integrator: rk4}\n"),
            "DIR/s.yaml:3:19: error: engine 'bulet' is unknown; did you mean 'bullet'?");
  EXPECT_EQ(error(kShort + "physics: {integrator: rk5}\n"),
            "DIR/s.yaml:3:23: error: integrator 'rk5' is unknown; did you mean 'rk4'?");
}

TEST_F(ScenarioTest, NoOtherEngineReplacesTheDefaultWhereThatIsNotBuiltIn) {
  Catalog catalog;
  fakes::fill(catalog, "articulated");
  const auto refusal = [&](const std::string& text) {
    return folder_.shown(test::message_of([&] { read_scenario(folder_.write("s.yaml", text), {}, catalog); }));
  };
  const std::string remedy =
      "this program was built without the default engine 'bullet'; write physics: {engine: articulated}, or add --set "
      "physics.engine=articulated";
  EXPECT_EQ(refusal(kShort), "DIR/s.yaml:1:1: error: " + remedy);
  EXPECT_EQ(refusal(kShort + "physics: {engine: bullet, integrator: rk4}\n"),
            "DIR/s.yaml:3:19: error: engine 'bullet' is unknown; known names: articulated");
  const Scenario s = read_scenario(folder_.write("s.yaml", kShort), {"physics.engine=articulated"}, catalog);
  EXPECT_EQ(s.physics.engine->name, "articulated");
}

TEST_F(ScenarioTest, SetIsValidatedLikeTheFile) {
  const Scenario s = read(kShort + "cpg: {model: {rate: 3}}\n", {"cpg.type=hopf", "seed=7", "actuator.i_max=0.8"});
  EXPECT_EQ(s.cpg.entry->name, "hopf");
  EXPECT_EQ(s.seed, 7);
  ASSERT_EQ(s.notes.size(), 1U);
  EXPECT_EQ(s.notes[0].text, "cpg: type changed from phase_oscillator to hopf; dropped model.rate");
  EXPECT_EQ(error(kShort, {"phyics.step=1", "duration=x", "seed"}),
            "--set seed: error: found no '='; expected KEY.PATH=VALUE, for example physics.step=2.5e-05\n"
            "--set duration=x: error: duration is 'x'; expected a number in s\n"
            "--set phyics.step=1: error: unknown key 'phyics'; did you mean 'physics'?");
}

TEST_F(ScenarioTest, TheCpgsNoteIsPassedOn) {
  const Scenario s = read(kShort + "cpg: {}\n");
  EXPECT_EQ(s.notes, (std::vector<Note>{{{s.file}, "cpg: starts at phase 0"}}));
}

TEST_F(ScenarioTest, PlacesOfGivenKeys) {
  const Scenario s = read(kShort + "physics: {step: 1e-3}\n", {"seed=3"});
  EXPECT_EQ(folder_.shown(to_string(s.place("physics.step"))), "DIR/s.yaml:3:17");
  EXPECT_EQ(to_string(s.place("seed")), "--set seed=3");
  EXPECT_EQ(folder_.shown(to_string(s.place("trace.columns"))), "DIR/s.yaml");
}

TEST_F(ScenarioTest, Plugins) {
  EXPECT_EQ(error(kShort + "plugins: [./libnone.so]\n"),
            "DIR/s.yaml:3:11: error: plugin './libnone.so' cannot be loaded: No such file or directory (tried "
            "'DIR/libnone.so')");
  folder_.write("libx.so", "not a library");
  EXPECT_EQ(file_hash(folder_.path() + "/libx.so"), "4f13f3f320fa745a");
  EXPECT_EQ(error(kShort + "plugins: [{path: libx.so, hash: \"0123456789abcdef\"}]\n"),
            "DIR/s.yaml:3:18: error: plugin 'libx.so' is not the recorded file: its hash is 4f13f3f320fa745a, but "
            "0123456789abcdef is recorded");
  EXPECT_EQ(error(kShort + "plugins: [libx.so]\n"), "DIR/s.yaml:3:11: error: plugin 'libx.so' is not a library (.so)");
  EXPECT_EQ(error(kShort + "plugins: libx.so\n"), "DIR/s.yaml:3:10: error: plugins is 'libx.so'; expected a list of paths");
}

}  // namespace
}  // namespace gaitlab
