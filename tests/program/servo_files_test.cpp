// Tests of servos by name: every shipped file is a motor with its firmware, own keys and own files count first, and errors name
// the nearest servo.
#include "core/laws/dc_motor.h"
#include "core/plugin/plugin_instance.h"
#include "core/robot_files/servo_file.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/shipped_files.h"
#include "tests/program/fixture.h"
#include "tests/program/rod.h"

namespace gaitlab::test {
namespace {

std::string with(const std::string& actuator, const std::string& controller = {}) {
  return rod() + "actuator: {" + actuator + "}\n" + (controller.empty() ? "" : "controller: {" + controller + "}\n") +
         "duration: 1\n";
}

TEST(ServoFiles, EveryShippedServoIsAMotorWithItsFirmware) {
  int firmware = 0;
  for (const auto& [name, file] : shipped_files("servo")) {
    const Node document = read_yaml(file);
    const bool has_firmware = document.find("controller") != nullptr;
    firmware += has_firmware ? 1 : 0;
    const Scenario s =
        scenario(with("type: servo, model: " + name, has_firmware ? "type: rc_servo, model: " + name : "type: pid"));
    const DcMotor motor = make_motors(s)->dc_motors()[0];
    const double stall = std::stod(document.find("actuator")->find("stall_torque")->text);
    const double before_losses = motor.efficiency * motor.Kt * motor.gear * motor.u_max / motor.R;
    EXPECT_NEAR(before_losses, stall, 1e-9 * stall) << name;
    for (const Node& source : document.find("sources")->items)
      EXPECT_TRUE(contains(s.actuator_source, source.find("text")->text)) << s.actuator_source;
    EXPECT_FALSE(contains(resolved(s), "model:")) << "a recorded scenario needs no servo file";
  }
  EXPECT_GE(firmware, 4);
}

/// A run is read back with the source that it had, however often.
TEST(ServoFiles, TheSourceOfARecordIsNotNested) {
  const Folder folder;
  for (const std::string actuator : {"type: servo, model: s3003", "type: servo, model: mx-64, u_max: 9, source: measured",
                                     "type: servo, voltage: 5, stall_torque: 1, no_load_speed: 6, source: a sheet",
                                     "type: dc_motor, R: 4, source: a sheet"}) {
    const Scenario s = scenario(with(actuator));
    std::string text = resolved(s);
    for (int again = 0; again < 3; ++again) {
      const Scenario record = read_record(text, folder / "resolved.yaml", {}, catalog());
      EXPECT_EQ(record.actuator_source, s.actuator_source);
      text = resolved(record);
    }
    EXPECT_EQ(text, resolved(s));
  }
}

TEST(ServoFiles, AKeyOfTheScenarioCountsFirst) {
  const Scenario s =
      scenario(with("type: servo, model: s3003, u_max: 6, source: measured", "type: rc_servo, model: mx-64, P: 64"));
  EXPECT_EQ(make_motors(s)->dc_motors()[0].u_max, 6);
  EXPECT_TRUE(contains(s.actuator_source, "u_max: measured; the rest: Futaba S3003")) << s.actuator_source;
  const Scenario chosen = scenario(with("type: servo, model: mx-64, stall_torque: 70"));
  EXPECT_TRUE(contains(chosen.actuator_source, "chosen: stall_torque; the rest: Rhoban/bam")) << chosen.actuator_source;
  const auto controller = make_controller(s.controller, plugin_info(s));
  EXPECT_NEAR(controller->gains().at(0).P, 64 * 0.158, 1e-12);
}

TEST(ServoFiles, SetChangesTheServo) {
  const Scenario s = scenario(with("type: servo, model: s3003"), {"actuator.model=sg92r"});
  EXPECT_NEAR(make_motors(s)->dc_motors()[0].Ks, 4.8 / 8.7266, 1e-12);
}

TEST(ServoFiles, ARolloutWithAnotherServoIsThatOfThisServoAlone) {
  const Folder folder;
  const std::string file = folder.write("s.yaml", with("type: servo, model: s3003", "type: rc_servo, model: mx-64"));
  const ScenarioTemplate all(file, {}, catalog());
  for (const std::vector<std::string>& sets : {std::vector<std::string>{"actuator.model=ax-12"},
                                               {"actuator.model=mx-64"},
                                               {"controller.model=sts3215"},
                                               {"controller.gain=3"},
                                               {"controller.P=7"},
                                               {"actuator.efficiency=0.5"}}) {
    EXPECT_EQ(resolved(all.with(sets)), resolved(read_scenario(file, sets, catalog()))) << sets.front();
  }
}

TEST(ServoFiles, AStatedGainTakesThePlaceOfP) {
  const Scenario s =
      scenario(with("type: servo, model: xl330-m288, efficiency: 0.5", "type: rc_servo, model: xl330-m288, gain: 3"));
  EXPECT_EQ(make_controller(s.controller, plugin_info(s))->gains().at(0).P, 3);
}

TEST(ServoFiles, AHingeMayHaveItsOwnServo) {
  std::string text = with("type: servo, model: ax-12");
  text.replace(text.find("range: free"), 11, "range: free, actuator: {model: s3003}");
  const std::string actuator = "actuator: {type: servo, model: ax-12}\n";
  text.replace(text.rfind(actuator), actuator.size(), "");
  text.replace(text.find("    name: rod\n"), 14, "    name: rod\n    " + actuator);
  EXPECT_NEAR(make_motors(scenario(text))->dc_motors()[0].Ks, 4.8 / 4.553, 1e-12);
}

TEST(ServoFiles, AreFoundBesideTheScenario) {
  const Folder folder;
  std::filesystem::create_directory(folder / "servos");
  folder.write("servos/mine.yaml",
               "gaitlab_servo: 1\nname: mine\nsource: a bench\nactuator: {type: servo, voltage: 5, stall_torque: 1, "
               "no_load_speed: 6}\n");
  const std::string file = folder.write("s.yaml", with("type: servo, model: mine"));
  EXPECT_TRUE(read_scenario(file, {}, catalog()).actuator_source.ends_with("the rest: a bench"));
  folder.write("servos/mine.yaml", "gaitlab_servo: 1\nname: mine\nsource: a bench\nactuator: {type: servo, volts: 5}\n");
  try {
    read_scenario(file, {}, catalog());
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "servos/mine.yaml:4:32: error: unknown key 'volts'")) << error.what();
  }
  folder.write("servos/mine.yaml", "gaitlab_servo: 1\nname: mine\nsource: a bench\nactuator: {type: servo, model: s3003}\n");
  try {
    read_scenario(file, {}, catalog());
    ADD_FAILURE();
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1U) << error.what();
    EXPECT_TRUE(contains(error.what(), "a servo file cannot name another one")) << error.what();
  }
}

TEST(ServoFiles, ExplainIsATableOfNumbersWithTheirSources) {
  for (const auto& [name, file] : shipped_files("servo")) {
    const std::string text = gaitlab("explain servo " + name, "/tmp").out;
    const Node document = read_yaml(file);
    for (const char* const section : {"actuator", "controller"}) {
      const Node* const map = document.find(section);
      for (std::size_t i = 0; map != nullptr && i < map->keys.size(); ++i) {
        const std::string& key = map->keys[i].first;
        const std::size_t at = key == "type" ? 0 : text.find("  " + key + " ");
        ASSERT_NE(at, std::string::npos) << name << " " << key << "\n" << text;
        const std::string line = text.substr(at, text.find('\n', at) - at);
        if (key == "type") continue;
        EXPECT_TRUE(contains(line, "data sheet  [") || contains(line, "identified  [")) << line;
      }
    }
    for (const char* const key : {"dry_friction", "viscous_friction", "load_friction", "rotor_inertia"}) {
      if (document.find("actuator")->find(key) != nullptr) continue;
      const std::size_t at = text.find(key);
      ASSERT_NE(at, std::string::npos) << text;
      EXPECT_TRUE(contains(text.substr(at, text.find('\n', at) - at), "chosen")) << text;
    }
    EXPECT_TRUE(contains(text, "file: " + file)) << text;
  }
  const std::string text = gaitlab("explain servo xl330-m288", "/tmp").out;
  // P 400 of P / 256 PWM per 0.088 degree of 885: 400 / 256 * 4096 / (2 pi) / 885
  EXPECT_TRUE(contains(text, "1.151 /rad ")) << text;
  EXPECT_TRUE(contains(text, "0.0156 N m ")) << "3 % of 0.52 N m";
}

/// `gaitlab list servo` prints the origin of each servo's numbers, and their error.
TEST(ServoFiles, ListsHaveTheOriginOfTheNumbers) {
  std::string list;  // without the line breaks of a terminal
  for (const char c : gaitlab("list servo", "/tmp").out) list += c == '\n' ? ' ' : c;
  for (const char* const part :
       {"Dynamixel AX-12: data sheet with usual losses; the errors of three such servos are 43, 65 and 81 mrad",
        "Dynamixel MX-64: identified, error not stated: Rhoban/bam, commit 1b5a1cee, model M1",
        "Dynamixel XL330-M288-T, fitted: identified from 8 logs of Rhoban/bam, fitted to 23.3 mrad, held-out error 39.6 mrad "
        "on 8 "
        "logs (45.2 mrad before the fit), speeds up to 13 rad/s, torques up to 0.866 N m"})
    EXPECT_TRUE(contains(list, part)) << list;
  const std::string text = gaitlab("explain servo xl330-m288-fitted", "/tmp").out;
  EXPECT_TRUE(contains(text, "\nlogs\n  identified from 8 logs of Rhoban/bam")) << text;
}

TEST(ServoFiles, EveryNumberHasOneSource) {
  const Folder folder;
  std::filesystem::create_directory(folder / "servos");
  const std::string file = folder.write("s.yaml", with("type: servo, model: mine"));
  const auto expect = [&](const std::string& sources, const std::string& error) {
    folder.write("servos/mine.yaml", "gaitlab_servo: 1\nname: mine\n" + sources +
                                         "actuator: {type: servo, voltage: 5, stall_torque: 1, no_load_speed: 6}\n");
    try {
      const Scenario s = read_scenario(file, {}, catalog());
      EXPECT_EQ(error, "") << s.actuator_source;
    } catch (const InputError& wrong) {
      EXPECT_TRUE(!error.empty() && contains(wrong.what(), error)) << wrong.what();
    }
  };
  expect("sources: [{of: [voltage, stall_torque, no_load_speed], kind: data sheet, text: a sheet}]\n", "");
  expect("sources: [{of: [voltage, stall_torque], kind: identified, text: a bench}]\n",
         "servos/mine.yaml:4:54: error: 'no_load_speed' has no source; expected its name in an `of` of sources");
  expect("sources: [{of: [voltage, stall_torqe, no_load_speed], kind: chosen, text: a sheet}]\n",
         "servos/mine.yaml:3:26: error: the file states no 'stall_torqe'; did you mean 'stall_torque'?");
  expect("sources: [{of: [voltage, stall_torque, no_load_speed, voltage], kind: chosen, text: a sheet}]\n",
         "'voltage' has two sources; expected one");
  expect("source: a bench\nsources: [{of: [voltage, stall_torque, no_load_speed], kind: chosen, text: a sheet}]\n",
         "source and sources are both stated; expected one of them");
  expect("sources: [{of: [voltage, stall_torque, no_load_speed], kind: measured, text: a sheet}]\n", "measured");
  expect("", "source");
}

TEST(ServoFiles, AFileThatHidesAShippedOneHasANote) {
  const Folder folder;
  std::filesystem::create_directory(folder / "servos");
  const std::string own =
      "gaitlab_servo: 1\nname: s3003\nsource: a bench\nactuator: {type: servo, voltage: 5, stall_torque: 1, no_load_speed: "
      "6}\n";
  folder.write("servos/s3003.yaml", own);
  const std::string note =
      "'s3003' is the file '" + (folder / "servos/s3003.yaml") + "', not the one of that name that comes with gaitlab";
  const std::string file = folder.write("s.yaml", with("type: servo, model: s3003"));
  const auto hiding = [&](const Scenario& s) {
    return std::ranges::count_if(s.notes, [&](const Note& one) { return one.text == note && one.place.line > 0; });
  };
  EXPECT_EQ(hiding(read_scenario(file, {}, catalog())), 1);
  const ScenarioTemplate all(file, {}, catalog());
  EXPECT_EQ(hiding(all.with({"actuator.u_max=4"})), 1);
  EXPECT_EQ(hiding(all.with({"actuator.model=sg92r"})), 0);
  std::string module = with("");
  module.replace(module.find("actuator: {}\n"), 13, "");
  module.replace(module.find("    name: rod\n"), 14, "    name: rod\n    actuator: {type: servo, model: s3003}\n");
  EXPECT_EQ(hiding(read_scenario(folder.write("m.yaml", module), {}, catalog())), 1);
  folder.write("servos/s3003.yaml", read(shipped_files("servo").at("s3003")));
  EXPECT_EQ(hiding(read_scenario(file, {}, catalog())), 0) << "the same content hides nothing";
}

/// The continuous current of the servo of module y1 is not that of another servo.
TEST(ServoFiles, ValuesOfTheModuleThatStayAreNoted) {
  const auto noted = [](const std::vector<std::string>& sets) {
    const Scenario s = shipped("library/y1-snake.yaml", sets);
    return std::ranges::any_of(s.notes, [](const Note& one) {
      return contains(one.text, "of the motor of module type y1 stay") && contains(one.text, "i_continuous");
    });
  };
  EXPECT_FALSE(noted({}));
  EXPECT_TRUE(noted({"actuator.model=xl330-m288"}));
  EXPECT_FALSE(noted({"actuator.model=xl330-m288", "actuator.i_continuous=0"}));
}

TEST(ServoFiles, ErrorsNameTheNearestServo) {
  expect_refusal(with("type: servo, model: xl330-m28"), "no servo 'xl330-m28'; did you mean 'xl330-m288'?");
  expect_refusal(with("type: dc_motor, model: s3003"), "servo 's3003' is for actuator 'servo', not 'dc_motor'");
  expect_refusal(with("type: servo, model: s3003", "type: rc_servo, model: s3003"), "servo 's3003' has no controller");
  expect_refusal(with("type: servo, model: [s3003]"), "model is a list; expected the name of a servo (gaitlab list servo)");
  expect_refusal(with("type: servo, model: ./none.yaml"), "none.yaml");
  expect_refusal(with("type: servo, model: s3003", "type: rc_servo") + "at: [{t: 0.5, set: {controller.model: mx-64}}]\n",
                 "a servo cannot change within a run; expected the keys that change");
}

}  // namespace
}  // namespace gaitlab::test
