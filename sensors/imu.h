// Sensor `imu`: gyroscope, accelerometer and tilt of a body.
#pragma once
#include "sensors/channel_bank.h"

namespace gaitlab::sensors {

/// With R from body to world axes, w the angular velocity and v the velocity of the sensor's point:
///
///     gyro = R^T w,    accelerometer = R^T ((v_k - v_(k-1)) / Ts - g),    v_(-1) = v_0
///     roll = atan2(R_32, R_33),    pitch = atan2(-R_31, (R_32^2 + R_33^2)^1/2)
///
/// The accelerometer gives the mean specific force over the last control period, not the momentary one, because no sensor
/// passes the peaks that stiff contacts cause.
class ImuSensor final : public Sensor {
 public:
  struct Settings {
    std::vector<std::string> body;     ///< one name
    std::array<double, 3> position{};  ///< m, body axes
    std::vector<std::string> measures{"gyro", "accelerometer", "tilt"};
    ChannelKeys gyro{kRadianPerSecond}, accelerometer{kAcceleration}, tilt{kRadian};
    void fields(Fields& f);
  };
  static const char* const kManual;

  ImuSensor(const SensorSite& site, const Settings& settings);
  [[nodiscard]] const std::vector<SensorReading>& readings() const override { return readings_; }
  [[nodiscard]] std::vector<SensorStream> streams() const override { return channels_.streams(); }
  [[nodiscard]] bool quantises() const override { return channels_.quantises(); }
  [[nodiscard]] bool draws() const override { return channels_.draws(); }
  [[nodiscard]] std::span<const BodyPoint> points() const override { return {&point_, 1}; }
  [[nodiscard]] std::size_t states() const override { return channels_.states() + 3; }
  void sense(const Truth& truth, Out state, Out values) const override;

 private:
  using Numbers = std::array<double, 3>;
  using Quantity = Numbers (*)(const BodyMotion& motion, const Numbers& acceleration);
  static Numbers gyro(const BodyMotion& motion, const Numbers& acceleration);
  static Numbers specific_force(const BodyMotion& motion, const Numbers& acceleration);
  static Numbers tilt(const BodyMotion& motion, const Numbers& acceleration);

  double period_;  ///< control period, s
  BodyPoint point_;
  std::vector<SensorReading> readings_;
  std::vector<Quantity> quantities_;  ///< by channel
  ChannelBank channels_;
};

}  // namespace gaitlab::sensors
