// The section `sensors`: forms, defaults, --set, the resolved text, and messages for wrong input.
#include <gtest/gtest.h>

#include "core/scenario/schema.h"
#include "core/scenario/sensor_section.h"
#include "sensors/encoder.h"
#include "sensors/register.h"
#include "tests/core/scenario/fixture.h"

namespace gaitlab {
namespace {

class SensorsTest : public fakes::ScenarioTest {
 protected:
  SensorsTest() { sensors::register_sensors(catalog_); }

  /// Scenario of two modules, with joints m0/h and m1/h and bodies m0/a, m0/b, m1/a, m1/b; the text begins in line 5.
  static std::string with(const std::string& sensors) { return fakes::kTwo + sensors + "\n"; }
  std::string wrong(const std::string& sensors, const std::vector<std::string>& sets = {}) {
    return error(with(sensors), sets);
  }
  static const sensors::EncoderSensor::Settings& encoder(const Scenario& s, std::size_t index = 0) {
    return *static_cast<const sensors::EncoderSensor::Settings*>(s.sensors.at(index).plugin.settings.get());
  }
};

TEST_F(SensorsTest, NoneIsAnEmptyMapOrList) {
  const std::string none = resolved(read(fakes::kTwo));
  for (const char* text : {"sensors: {}", "sensors: []"}) {
    const Scenario s = read(with(text));
    EXPECT_TRUE(s.sensors.empty());
    EXPECT_EQ(resolved(s), none);
  }
}

TEST_F(SensorsTest, SingleOrByName) {
  const Scenario one = read(with("sensors: {type: encoder, noise: 0.0035}"));
  ASSERT_EQ(one.sensors.size(), 1U);
  EXPECT_EQ(one.sensors[0].name, "encoder");
  EXPECT_EQ(encoder(one).noise, 0.0035);
  EXPECT_EQ(encoder(one).joints, std::vector<std::string>{"*"});
  const Scenario named = read(with("sensors: {encoder: {type: encoder, noise: 0.0035}}"));
  EXPECT_EQ(resolved(one), resolved(named));
  expect_stable(one);
}

TEST_F(SensorsTest, ResolvedHasEveryKey) {
  const Scenario s =
      read(with("sensors:\n"
                "  feet: {type: load, modules: [m1, m0], bodies: m1/b, period: 0.03}\n"
                "  joints: {type: encoder, joints: [m0/h], delay: [0.015, 0.045], range: [-1, 1]}\n"
                "  head: {type: imu, body: m1/a, measures: [tilt, gyro], gyro: {noise: 0.01}}\n"
                "  drives: {type: motor, measures: current}"));
  expect_stable(s);
  const std::string text = resolved(s);
  for (const char* part :
       {"\n  columns: [joint.*, base.*, com.*, sensor.*]\n",
        "\n  feet:\n    type: load\n    joints: []\n    legs: []\n    modules: [m1, m0]\n    bodies: m1/b\n",
        "\n    joints: m0/h\n", "\n    delay: [0.015, 0.045]\n", "\n    range: [-1, 1]\n", "\n    measures: [tilt, gyro]\n",
        "\n    gyro:\n      period: 0\n", "\n    measures: current\n", "\n    tachometer:\n"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << text;
  }
  EXPECT_EQ(read(with("sensors: {type: encoder}")).trace.columns.size(), 3U) << "an encoder belongs to joints";
  EXPECT_EQ(read(with("sensors: {type: load}\ntrace: {columns: [t]}")).trace.columns.size(), 1U);
}

TEST_F(SensorsTest, SetReachesEveryKey) {
  const std::string text = with("sensors: {a: {type: encoder, noise: 0.1}, b: {type: imu, body: m0/a}}");
  EXPECT_EQ(encoder(read(text, {"sensors.a.noise=0.2"})).noise, 0.2);
  EXPECT_EQ(encoder(read(text, {"sensors.a.delay=[0, 0.03]"})).delay_most, 0.03);
  EXPECT_TRUE(read(text, {"sensors={}"}).sensors.empty());
  EXPECT_EQ(read(fakes::kTwo, {"sensors.e.type=encoder"}).sensors.size(), 1U);
  EXPECT_EQ(error(text, {"sensors.a.noise=-1"}),
            "--set sensors.a.noise=-1: error: noise is -1 rad; expected 0 to 1000000000 rad");
}

TEST_F(SensorsTest, ATemplateReadsTheSectionAgain) {
  const std::string path = folder_.write("t.yaml", with("sensors: {a: {type: encoder, delay: 0.03}}"));
  const ScenarioTemplate text(path, {}, catalog_);
  EXPECT_EQ(encoder(text.with({"sensors.a.delay=0.045"})).delay_least, 0.045);
  EXPECT_EQ(encoder(text.with({"seed=7"})).delay_least, 0.03);
  EXPECT_EQ(resolved(text.with({"sensors={}"})), resolved(read_scenario(path, {"sensors={}"}, catalog_)));
  EXPECT_EQ(folder_.shown(test::message_of([&] { static_cast<void>(text.with({"controller.period=0.02"})); })),
            "DIR/t.yaml:5:37: error: delay is 0.03 s; expected a whole multiple of the control period 0.02 s: delay: 0.02 or "
            "0.04, or controller.period: 0.015 or 0.03");
}

TEST_F(SensorsTest, ChannelsHaveNames) {
  const Scenario s = read(with("sensors: {e: {type: encoder}, f: {type: load, bodies: m1/b}, d: {type: motor}}"));
  EXPECT_EQ(plugin_info(s).channels, (std::vector<std::string>{"f.m0", "f.m1", "f.m1/b", "d.m0/h.current", "d.m1/h.current"}));
}

TEST_F(SensorsTest, SchemaListsTypesAndKeys) {
  const std::string schema = scenario_schema(catalog_);
  EXPECT_NE(schema.find("\"tachometer\""), std::string::npos);
  EXPECT_NE(schema.find("#/definitions/sensor"), std::string::npos);
}

TEST_F(SensorsTest, WrongForms) {
  EXPECT_EQ(
      wrong("sensors: [imu]"),
      "DIR/s.yaml:5:10: error: sensors is a list of 1; expected a map of sensors by name, such as {imu: {type: imu, body: "
      "m0/active}}, or {} for none");
  EXPECT_EQ(wrong("sensors: imu"),
            "DIR/s.yaml:5:10: error: sensors is 'imu'; expected a map of sensors by name, such as {imu: {type: imu, body: "
            "m0/active}}, or {} for none");
  EXPECT_EQ(wrong("sensors: {imu: 3}"), "DIR/s.yaml:5:16: error: sensors.imu is 3; expected a map");
  EXPECT_EQ(wrong("sensors: {imu: {body: m0/a}}"),
            "DIR/s.yaml:5:16: error: sensor 'imu' has no key 'type'; known types: encoder, imu, load, motor, steering");
  EXPECT_EQ(wrong("sensors: {e: {type: encodr}}"), "DIR/s.yaml:5:21: error: type 'encodr' is unknown; did you mean 'encoder'?");
  EXPECT_EQ(
      wrong("sensors: {1st: {type: encoder}}"),
      "DIR/s.yaml:5:11: error: '1st' is not a name of a sensor; expected a letter, then letters, digits, `_` and `-`, but not "
      "`type`");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, nose: 1}}"),
            "DIR/s.yaml:5:30: error: unknown key 'nose'; did you mean 'noise'?");
  EXPECT_EQ(wrong("sensors: {b: {type: imu, body: m0/a, gyro: {nose: 1}}}"),
            "DIR/s.yaml:5:45: error: unknown key 'nose'; did you mean 'noise'?");
}

TEST_F(SensorsTest, WrongNumbers) {
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, resolution: -1}}"),
            "DIR/s.yaml:5:42: error: resolution is -1 rad; expected 0 to 1000000000 rad");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, noise: small}}"),
            "DIR/s.yaml:5:37: error: noise is 'small'; expected a number in rad");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, lost: 1.5}}"), "DIR/s.yaml:5:36: error: lost is 1.5; expected 0 to 1");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, delay: -0.015}}"),
            "DIR/s.yaml:5:37: error: delay is -0.015 s; expected 0 to 10 s");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, range: [1]}}"),
            "DIR/s.yaml:5:37: error: range has 1 number; expected [smallest, largest], or [] for no limit");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, range: [1, -1]}}"),
            "DIR/s.yaml:5:37: error: range has no width; expected [smallest, largest]");
  EXPECT_EQ(wrong("sensors: {f: {type: load, touch: 1, release: 2}}"),
            "DIR/s.yaml:5:46: error: release is above touch; expected at most touch");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, tachometer: {noise: 1}}}"),
            "DIR/s.yaml:5:42: error: tachometer is given, but the speed is the difference of the angles; remove it, or add "
            "speed: true");
}

TEST_F(SensorsTest, TimesAreWholeControlPeriods) {
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, delay: 0.02}}"),
            "DIR/s.yaml:5:37: error: delay is 0.02 s; expected a whole multiple of the control period 0.015 s: delay: 0.015 or "
            "0.03, or controller.period: 0.01 or 0.02");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, delay: [0.015, 0.02]}}"),
            "DIR/s.yaml:5:45: error: delay is 0.02 s; expected a whole multiple of the control period 0.015 s: delay: 0.015 or "
            "0.03, or controller.period: 0.01 or 0.02");
  EXPECT_EQ(
      wrong("sensors: {b: {type: imu, body: m0/a, tilt: {period: 0.05}}}"),
      "DIR/s.yaml:5:53: error: period is 0.05 s; expected a whole multiple of the control period 0.015 s: period: 0.045 or "
      "0.06, or controller.period: 0.0125 or 0.025");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, delay: [0.03, 0.015]}}"),
            "DIR/s.yaml:5:37: error: delay is [0.03, 0.015]; expected the smaller number first");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, delay: [0, 0.015, 0.03]}}"),
            "DIR/s.yaml:5:37: error: delay has 3 numbers; expected one, or a range [a, b]");
}

TEST_F(SensorsTest, UnknownParts) {
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, joints: m2/h}}"),
            "DIR/s.yaml:5:38: error: no joint 'm2/h'; joints are m0/h, m1/h");
  EXPECT_EQ(wrong("sensors: {e: {type: encoder, joints: [m0/h, '*/x']}}"),
            "DIR/s.yaml:5:45: error: no joint matches '*/x'; did you mean '*/h'?");
  EXPECT_EQ(wrong("sensors: {f: {type: load, modules: [m9]}}"), "DIR/s.yaml:5:37: error: no module 'm9'; did you mean 'm0'?");
  EXPECT_EQ(wrong("sensors: {f: {type: load, bodies: [m0/c]}}"),
            "DIR/s.yaml:5:36: error: no body 'm0/c'; did you mean 'm0/a'?");
  EXPECT_EQ(wrong("sensors: {b: {type: imu, body: m9/a}}"), "DIR/s.yaml:5:32: error: no body 'm9/a'; did you mean 'm0/a'?");
  EXPECT_EQ(wrong("sensors: {b: {type: imu, body: '*'}}"),
            "DIR/s.yaml:5:32: error: '*' is a pattern; expected the name of one body");
  EXPECT_EQ(wrong("sensors: {b: {type: imu, body: [m0/a, m1/a]}}"), "DIR/s.yaml:5:32: error: body is a list; expected a body");
  EXPECT_EQ(wrong("sensors: {b: {type: imu}}"), "DIR/s.yaml:5:14: error: missing key 'body'");
  EXPECT_EQ(wrong("sensors: {b: {type: imu, body: m0/a, measures: [gryo]}}"),
            "DIR/s.yaml:5:49: error: measures 'gryo' is unknown; did you mean 'gyro'?");
  EXPECT_EQ(wrong("sensors: {b: {type: imu, body: m0/a, measures: []}}"),
            "DIR/s.yaml:5:11: error: sensor 'b' measures nothing: it has no parts or no quantities to measure; remove it");
}

TEST_F(SensorsTest, JointsWithoutMotor) {
  std::string passive = fakes::kDuo;
  passive.replace(passive.find("range: [-1.5, 1.5]"), 18, "range: [-1.5, 1.5], drive: none");
  passive.replace(passive.find("gaitlab_module: 1"), 17, "gaitlab_module: 1");
  passive.replace(passive.find("name: duo"), 9, "name: free");
  folder_.write("modules/free.yaml", passive);
  const std::string robot = "robot: {modules: {0: duo, 1: free}, docks: [[1, 1, 4, 0, 0]]}\nduration: 1\n";
  // The fake motor states no limits, which a robot with passive joints requires. This problem precedes the others.
  EXPECT_TRUE(error(robot + "sensors: {d: {type: motor, joints: m1/h}}\n")
                  .ends_with("\nDIR/s.yaml:3:36: error: joint 'm1/h' has no motor (drive: none)"));
  EXPECT_TRUE(error(robot + "sensors: {d: {type: motor, joints: 'm1/*'}}\n")
                  .ends_with("\nDIR/s.yaml:3:36: error: no joint that matches 'm1/*' has a motor"));
}

TEST_F(SensorsTest, TwoSensorsOfOneValue) {
  EXPECT_EQ(wrong("sensors:\n  a: {type: encoder}\n  b: {type: encoder, joints: m1/h}"),
            "DIR/s.yaml:7:3: error: the angle of joint 'm1/h' has two sensors, 'a' and 'b'; expected one\n"
            "DIR/s.yaml:6:3: note: 'a' is here");
  EXPECT_EQ(wrong("sensors:\n  a: {type: load}\n  b: {type: load, modules: m1}"),
            "DIR/s.yaml:7:3: error: the load of module 'm1' has two sensors, 'a' and 'b'; expected one\n"
            "DIR/s.yaml:6:3: note: 'a' is here");
  EXPECT_EQ(wrong("sensors:\n  a: {type: motor}\n  b: {type: motor, joints: m1/h, measures: torque}"),
            "DIR/s.yaml:7:3: error: the torque of joint 'm1/h' has two sensors, 'a' and 'b'; expected one\n"
            "DIR/s.yaml:6:3: note: 'a' is here");
  EXPECT_EQ(wrong("sensors:\n  a: {type: motor}\n  b: {type: motor, measures: current}"),
            "DIR/s.yaml:7:3: error: column 'joint.0.measured_current' has two sensors, 'a' and 'b'; expected one\n"
            "DIR/s.yaml:6:3: note: 'a' is here");
}

TEST_F(SensorsTest, MotorsOfARobotWithoutMotors) {
  const std::string told = wrong("sensors: {d: {type: motor}}", {"actuator={type: none}"});
  EXPECT_NE(told.find("error: sensor 'd' measures motors, but the robot has none (actuator.type: none); remove it"),
            std::string::npos)
      << told;
}

// Two names with one hash, found among a million names.
TEST_F(SensorsTest, TwoChannelsOfOneHash) {
  EXPECT_EQ(
      wrong("sensors:\n  gyro_left_22: {type: imu, body: m0/a, measures: gyro}\n"
            "  imu_leg_3248: {type: imu, body: m1/a, measures: gyro}"),
      "DIR/s.yaml:7:3: error: the channels 'gyro_left_22.gyro' and 'imu_leg_3248.gyro' have the same hash (FNV-1a, c3740940) "
      "and would have the same noise; rename a sensor\n"
      "DIR/s.yaml:6:3: note: 'gyro_left_22.gyro' is here");
}

}  // namespace
}  // namespace gaitlab
