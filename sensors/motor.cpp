#include "sensors/motor.h"

#include <array>

#include "sensors/parts.h"

namespace gaitlab::sensors {

namespace {
constexpr const char* kCurrent = "current";
constexpr const char* kTorque = "torque";
constexpr std::array kMotorWords{kCurrent, kTorque};
}  // namespace

const char* const MotorSensor::kManual = R"(Current and torque of the motors of joints.

    current: the motor's current, A               torque: the motor's torque on the joint, N m

CPG and controller get the measured torque of these joints in place of the true one. The current is a separate value
(Measured::channels). Trace columns joint.J.measured_current and joint.J.measured_torque. Both are left limits: they belong to
the command in force before the tick. Each has the keys of a channel (docs/real-robot.md) and, for every joint, its own draws.
Source: none; the quantities are those of the actuator. Default (chosen): an exact sensor.

    sensors:
      motors: {type: motor, joints: "*", measures: current, current: {noise: 0.01, range: [-2, 2]}})";

void MotorSensor::Settings::fields(Fields& f) {
  f.names("joints", joints, Among::motors, "Joints with a motor: a name, a pattern, or a list of names and patterns.");
  f.words("measures", measures, kMotorWords, "Quantities that are measured: `current`, `torque`, or both.");
  f.group(kCurrent, current, "Channel of the current.");
  f.group(kTorque, torque, "Channel of the torque.");
}

MotorSensor::MotorSensor(const SensorSite& site, const Settings& settings) {
  for (const std::size_t j : matching(settings.joints, joint_names_of(site.robot))) {
    if (site.robot.joints[j].driven) joints_.push_back(j);
  }
  const auto add = [&](const char* quantity, const char* column, const ChannelKeys& keys, Replaces replaces) {
    if (!measures(settings.measures, quantity)) return;
    for (const std::size_t j : joints_) {
      const std::string& joint = site.robot.joints[j].name;
      const std::string name = site.name + "." + joint + "." + quantity;
      channels_.add(Channel(keys, site, name));
      readings_.push_back({name, joint_column(j, column), keys.unit.value,
                           std::string(quantity) + " measured by the sensor, in force just before t, of joint " + joint,
                           replaces, j});
    }
  };
  add(kCurrent, "measured_current", settings.current, Replaces::nothing);
  currents_ = readings_.size();
  add(kTorque, "measured_torque", settings.torque, Replaces::torque);
}

void MotorSensor::sense(const Truth& truth, Out state, Out values) const {
  const auto one = [&](std::size_t i) { return (i < currents_ ? truth.current : truth.torque).subspan(readings_[i].part, 1); };
  channels_.sense(truth.tick, one, state, values);
}

}  // namespace gaitlab::sensors
