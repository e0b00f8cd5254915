// The types of sensors, each against its equation.
#include <gtest/gtest.h>

#include <cmath>

#include "core/model/frames.h"
#include "sensors/encoder.h"
#include "sensors/imu.h"
#include "sensors/load.h"
#include "sensors/motor.h"

namespace gaitlab::sensors {
namespace {

constexpr double kTick = 0.015;  // s

/// Two modules of two bodies and a joint each; the joint of module 1 has no motor.
RobotInfo two() {
  RobotInfo robot;
  for (const char* name : {"m0/h", "m1/h"}) robot.joints.push_back({name});
  robot.joints[1].driven = false;
  robot.modules.resize(2);
  for (const char* name : {"m0/a", "m0/b", "m1/a", "m1/b"}) robot.bodies.push_back({name, name[1] - '0'});
  return robot;
}

/// A sensor with its state, and true values that a test sets.
template <class T>
class Bench {
 public:
  explicit Bench(const typename T::Settings& settings)
      : sensor({robot, "s", 1, kTick}, settings), state(sensor.states(), NAN), values(sensor.readings().size(), NAN) {}
  const std::vector<double>& tick() {
    sensor.sense({now++, angle, speed, torque, current, module_load, body_load, load, {&motion, 1}}, state, values);
    return values;
  }
  [[nodiscard]] double operator[](const std::string& column) const {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (sensor.readings()[i].column == column) return values[i];
    }
    throw std::out_of_range(column);
  }

  const RobotInfo robot = two();
  std::vector<double> angle{0.1, 0.2}, speed{3, 4}, torque{5, 6}, current{7, 8}, module_load{9, 10}, body_load{1, 8, 4, 6},
      load{8, 6};
  BodyMotion motion;
  T sensor;
  std::vector<double> state, values;
  std::int64_t now = 0;
};

TEST(Encoder, SpeedIsTheDifferenceOfTheAngles) {
  EncoderSensor::Settings settings;
  settings.period = 2 * kTick;
  Bench<EncoderSensor> bench(settings);
  EXPECT_EQ(bench.tick(), (std::vector<double>{0.1, 0.2, 0, 0}));
  bench.angle = {0.4, 0.1};
  EXPECT_EQ(bench.tick(), (std::vector<double>{0.1, 0.2, 0, 0})) << "no sample at this tick";
  bench.tick();
  EXPECT_EQ(bench["joint.0.measured"], 0.4);
  EXPECT_EQ(bench["joint.0.measured_speed"], (0.4 - 0.1) / (2 * kTick));
  EXPECT_EQ(bench["joint.1.measured_speed"], (0.1 - 0.2) / (2 * kTick));
  bench.angle = {9, 9};
  bench.tick();
  EXPECT_EQ(bench["joint.0.measured_speed"], (0.4 - 0.1) / (2 * kTick)) << "held";
}

TEST(Encoder, ATachometerMeasuresTheSpeed) {
  EncoderSensor::Settings settings;
  settings.joints = {"m1/*"};
  settings.speed = true;
  settings.tachometer.resolution = 3;
  Bench<EncoderSensor> bench(settings);
  EXPECT_EQ(bench.tick(), (std::vector<double>{0.2, 3}));
  EXPECT_EQ(bench.sensor.streams().size(), 2U);
  EXPECT_EQ(bench.sensor.streams()[1].name, "s.m1/h.speed");
}

TEST(Motor, MeasuresJointsWithMotorsAlone) {
  Bench<MotorSensor> both((MotorSensor::Settings()));
  EXPECT_EQ(both.tick(), (std::vector<double>{7, 5}));
  EXPECT_EQ(both["joint.0.measured_current"], 7);
  EXPECT_EQ(both["joint.0.measured_torque"], 5);
  EXPECT_TRUE(both.sensor.needs_current());
  MotorSensor::Settings torque;
  torque.measures = {"torque"};
  Bench<MotorSensor> one(torque);
  EXPECT_EQ(one.tick(), std::vector<double>{5});
  EXPECT_FALSE(one.sensor.needs_current());
}

TEST(Load, TouchesWithHysteresis) {
  LoadSensor::Settings settings;
  settings.modules = {"m1"};
  settings.bodies = {"m0/?"};
  Bench<LoadSensor> bench(settings);
  EXPECT_EQ(bench.tick(), (std::vector<double>{10, 1, 8, 1}));
  EXPECT_EQ(bench["sensor.s.m1"], 10);
  EXPECT_EQ(bench["sensor.s.m0/b"], 8);
  const double loads[] = {0.7, 0.4, 0.7, 1.0, 1.1, 0.5};
  const double touches[] = {1, 0, 0, 0, 1, 1};
  for (std::size_t i = 0; i < 6; ++i) {
    bench.module_load[1] = loads[i];
    bench.tick();
    EXPECT_EQ(bench["sensor.s.m1.touching"], touches[i]) << loads[i];
  }
}

void set_rotation(BodyMotion& motion, const Mat3& R) {
  for (Eigen::Index i = 0; i < 9; ++i) motion.rotation[static_cast<std::size_t>(i)] = R(i / 3, i % 3);
}

TEST(LoadSensor, MeasuresJointsAndLegs) {
  LoadSensor::Settings settings;
  settings.modules.clear();
  settings.joints = {"m1/*"};
  Bench<LoadSensor> bench(settings);
  EXPECT_EQ(bench.tick(), (std::vector<double>{6}));
  EXPECT_EQ(bench.sensor.readings()[0].column, "sensor.s.m1/h.link");
  EXPECT_EQ(bench.sensor.readings()[0].replaces, Replaces::load);
  EXPECT_EQ(bench.sensor.readings()[0].part, 1U);

  RobotInfo robot = two();
  robot.legs.push_back({.name = "front", .joints = {0}, .bodies = {1, 3}});
  settings.joints.clear();
  settings.legs = {"f*"};
  const LoadSensor legs({robot, "feet", 1, kTick}, settings);
  std::vector<double> state(legs.states()), values(legs.readings().size());
  const std::vector<double> of_bodies{1, 8, 4, 6}, none(2);
  legs.sense({0, none, none, none, none, none, of_bodies, none, {}}, state, values);
  EXPECT_EQ(values, (std::vector<double>{14}));
  EXPECT_EQ(legs.readings()[0].name, "feet.front");
  settings.legs = {"rear"};
  EXPECT_THROW(LoadSensor({robot, "feet", 1, kTick}, settings), SettingError);
}

TEST(Imu, MeasuresInTheAxesOfTheBody) {
  ImuSensor::Settings settings;
  settings.body = {"m0/b"};
  Bench<ImuSensor> bench(settings);
  ASSERT_EQ(bench.sensor.points().size(), 1U);
  EXPECT_EQ(bench.sensor.points()[0].body, 1U);
  const Vec3 angles(0.3, -0.8, 2.5);  // roll, pitch, yaw
  const Mat3 R = rpy(angles);
  set_rotation(bench.motion, R);
  bench.motion.gravity = {0, 0, -9.81};
  bench.motion.angular_velocity = {1, 2, 3};
  bench.motion.velocity = {5, 6, 7};
  const auto expect = [&](const char* prefix, const Vec3& v) {
    const std::string head = std::string("sensor.s.") + prefix;
    constexpr double kRounding = 1e-14;  // rounding error of sums of three products below 20
    EXPECT_NEAR(bench[head + "_x"], v.x(), kRounding);
    EXPECT_NEAR(bench[head + "_y"], v.y(), kRounding);
    EXPECT_NEAR(bench[head + "_z"], v.z(), kRounding);
  };
  bench.tick();
  expect("gyro", R.transpose() * Vec3(1, 2, 3));
  expect("accelerometer", R.transpose() * Vec3(0, 0, 9.81));  // the velocity before is unknown
  EXPECT_NEAR(bench["sensor.s.roll"], angles.x(), 1e-15);
  EXPECT_NEAR(bench["sensor.s.pitch"], angles.y(), 1e-15);
  // In free fall, v changes by g Ts.
  bench.motion.velocity = {5, 6, 7 - 9.81 * kTick};
  bench.tick();
  constexpr double kDifference = 1e-12;  // rounding error of velocities of 7 m/s, divided by 15 ms
  EXPECT_NEAR(
      Vec3(bench["sensor.s.accelerometer_x"], bench["sensor.s.accelerometer_y"], bench["sensor.s.accelerometer_z"]).norm(), 0,
      kDifference);
}

TEST(Imu, MeasuresTheQuantitiesAskedFor) {
  ImuSensor::Settings settings;
  settings.body = {"m1/a"};
  settings.measures = {"tilt"};
  Bench<ImuSensor> bench(settings);
  set_rotation(bench.motion, Mat3::Identity());
  EXPECT_EQ(bench.tick(), (std::vector<double>{0, 0}));
  EXPECT_EQ(bench.sensor.streams().size(), 1U);
  EXPECT_EQ(bench.sensor.streams()[0].name, "s.tilt");
}

}  // namespace
}  // namespace gaitlab::sensors
