#include "sensors/imu.h"

#include <cmath>
#include <initializer_list>

#include "sensors/parts.h"

namespace gaitlab::sensors {

namespace {

constexpr const char* kGyro = "gyro";
constexpr const char* kAccelerometer = "accelerometer";
constexpr const char* kTilt = "tilt";
constexpr std::array kImuWords{kGyro, kAccelerometer, kTilt};

/// Converts a vector from world axes to the axes of the body.
std::array<double, 3> in_body(const BodyMotion& motion, const std::array<double, 3>& v) {
  const std::array<double, 9>& R = motion.rotation;
  return {R[0] * v[0] + R[3] * v[1] + R[6] * v[2], R[1] * v[0] + R[4] * v[1] + R[7] * v[2],
          R[2] * v[0] + R[5] * v[1] + R[8] * v[2]};
}

}  // namespace

const char* const ImuSensor::kManual = R"(An inertial measurement unit on a body: gyroscope, accelerometer and tilt.

    gyro = R^T w                                        rad/s, body axes
    accelerometer = R^T ((v_k - v_(k-1)) / Ts - g)      m/s^2, body axes, at `position`
    roll = atan2(R32, R33), pitch = atan2(-R31, sqrt(R32^2 + R33^2))        rad

R: body axes to world axes; w: angular velocity; v: velocity of the point; Ts: control period; g: gravity. At rest the
accelerometer gives -g. The accelerometer measures the mean over the last control period, so that it works with any contact law
and engine. Roll and pitch do not contain the turn about the vertical. A gyroscope of noise density N has noise: N/sqrt(T),
where T is the time between samples, and walk: K. All values are separate channels (Measured::channels). Trace columns
sensor.NAME.gyro_x, sensor.NAME.accelerometer_x, sensor.NAME.roll ...
Each quantity has the keys of a channel (docs/real-robot.md), and its numbers have common losses and delay.
Source: IEEE Std 952-1997 (gyroscopes), IEEE Std 1293 (accelerometers). Default (chosen): an exact sensor.

    sensors:
      imu: {type: imu, body: m0/active, gyro: {noise: 0.01}, accelerometer: {noise: 0.05, range: [-20, 20]}})";

void ImuSensor::Settings::fields(Fields& f) {
  f.name("body", body, Among::bodies, "Body that carries the sensor; required.");
  f.vector("position", position, {"m", -1000, 1000, "Place of the sensor, from the origin of the body's frame, body axes."});
  f.words("measures", measures, kImuWords, "Quantities that are measured: `gyro`, `accelerometer`, `tilt`, or some of them.");
  f.group(kGyro, gyro, "Channel of the angular velocity.");
  f.group(kAccelerometer, accelerometer, "Channel of the specific force.");
  f.group(kTilt, tilt, "Channel of roll and pitch.");
}

ImuSensor::ImuSensor(const SensorSite& site, const Settings& settings) : period_(site.period) {
  for (const std::size_t body : matching(settings.body, body_names_of(site.robot))) point_ = {body, settings.position};
  const std::string of = settings.body.empty() ? "" : ", in force just before t, of body " + settings.body.front();
  const auto add = [&](const char* word, const ChannelKeys& keys, Quantity quantity, const std::string& what,
                       std::initializer_list<const char*> numbers) {
    if (!measures(settings.measures, word)) return;
    channels_.add(Channel(keys, site, site.name + "." + word, numbers.size()));
    quantities_.push_back(quantity);
    for (const char* number : numbers) {
      const std::string name = site.name + "." + number;
      readings_.push_back({name, "sensor." + name, keys.unit.value, what + of});
    }
  };
  add(kGyro, settings.gyro, gyro, "angular velocity measured by the sensor, body axes", {"gyro_x", "gyro_y", "gyro_z"});
  add(kAccelerometer, settings.accelerometer, specific_force, "specific force measured by the sensor, body axes",
      {"accelerometer_x", "accelerometer_y", "accelerometer_z"});
  add(kTilt, settings.tilt, tilt, "tilt measured by the sensor", {"roll", "pitch"});
}

void ImuSensor::sense(const Truth& truth, Out state, Out values) const {
  const BodyMotion& motion = truth.motion[0];
  const Out before = state.subspan(channels_.states(), 3);
  Numbers acceleration{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (truth.tick > 0) acceleration[i] = (motion.velocity[i] - before[i]) / period_;
    before[i] = motion.velocity[i];
  }
  Numbers numbers{};
  const auto true_value = [&](std::size_t i) {
    numbers = quantities_[i](motion, acceleration);
    return In(numbers);
  };
  channels_.sense(truth.tick, true_value, state, values);
}

ImuSensor::Numbers ImuSensor::gyro(const BodyMotion& motion, const Numbers&) {
  return in_body(motion, motion.angular_velocity);
}

ImuSensor::Numbers ImuSensor::specific_force(const BodyMotion& motion, const Numbers& acceleration) {
  const Numbers& g = motion.gravity;
  return in_body(motion, {acceleration[0] - g[0], acceleration[1] - g[1], acceleration[2] - g[2]});
}

ImuSensor::Numbers ImuSensor::tilt(const BodyMotion& motion, const Numbers&) {
  const std::array<double, 9>& R = motion.rotation;
  return {math::atan2(R[7], R[8]), math::atan2(-R[6], std::sqrt(R[7] * R[7] + R[8] * R[8])), 0};
}

}  // namespace gaitlab::sensors
