// Tests of servos by name: every shipped file is a motor with its firmware, own keys and own files count first, and errors name
// the nearest servo.
#include "core/plugin/plugin_instance.h"
#include "core/robot_files/servo_file.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/resolved.h"
#include "core/settings/shipped_files.h"
#include "tests/program/fixture.h"
#include "tests/program/rod.h"

namespace gaitlab::test {
namespace {

std::string with(const std::string& actuator, const std::string& controller = {}) {
  return rod() + "actuator: {" + actuator + "}\n" + (controller.empty() ? "" : "controller: {" + controller + "}\n") +
         "duration: 1\n";
}

void expect_no_servo(const std::string& text, const std::string& expected) {
  try {
    scenario(text);
    ADD_FAILURE() << text << " is accepted";
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), expected)) << error.what();
  }
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
    EXPECT_TRUE(contains(s.actuator_source, document.find("source")->text.substr(0, 20))) << s.actuator_source;
    EXPECT_FALSE(contains(resolved(s), "model:")) << "a recorded scenario needs no servo file";
  }
  EXPECT_GE(firmware, 4);
}

TEST(ServoFiles, AKeyOfTheScenarioCountsFirst) {
  const Scenario s =
      scenario(with("type: servo, model: s3003, u_max: 6, source: measured", "type: rc_servo, model: mx-64, P: 64"));
  EXPECT_EQ(make_motors(s)->dc_motors()[0].u_max, 6);
  EXPECT_TRUE(s.actuator_source.ends_with("the rest: measured")) << s.actuator_source;
  const auto controller = make_controller(s.controller, info(*s.robot));
  EXPECT_NEAR(controller->gains().at(0).P, 64 * 0.158, 1e-12);
}

TEST(ServoFiles, SetChangesTheServo) {
  const Scenario s = scenario(with("type: servo, model: s3003"), {"actuator.model=sg92r"});
  EXPECT_NEAR(make_motors(s)->dc_motors()[0].Ks, 4.8 / 8.7266, 1e-12);
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
    EXPECT_TRUE(contains(error.what(), "servos/mine.yaml:4:25: error: unknown key 'volts'")) << error.what();
  }
}

TEST(ServoFiles, ErrorsNameTheNearestServo) {
  expect_no_servo(with("type: servo, model: xl330-m28"), "no servo 'xl330-m28'; did you mean 'xl330-m288'?");
  expect_no_servo(with("type: dc_motor, model: s3003"), "servo 's3003' is for actuator 'servo', not 'dc_motor'");
  expect_no_servo(with("type: servo, model: s3003", "type: rc_servo, model: s3003"), "servo 's3003' has no controller");
  expect_no_servo(with("type: servo, model: [s3003]"), "model is a list; expected the name of a servo (gaitlab list servo)");
  expect_no_servo(with("type: servo, model: ./none.yaml"), "none.yaml");
}

}  // namespace
}  // namespace gaitlab::test
