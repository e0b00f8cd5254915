// Sensor `motor`: current and torque of motors.
#pragma once
#include "sensors/channel_bank.h"

namespace gaitlab::sensors {

class MotorSensor final : public Sensor {
 public:
  struct Settings {
    std::vector<std::string> joints{"*"};
    std::vector<std::string> measures{"current", "torque"};
    ChannelKeys current{kAmpere}, torque{kNewtonMetre};
    void fields(Fields& f);
  };
  static const char* const kManual;

  MotorSensor(const SensorSite& site, const Settings& settings);
  [[nodiscard]] const std::vector<SensorReading>& readings() const override { return readings_; }
  [[nodiscard]] std::vector<SensorStream> streams() const override { return channels_.streams(); }
  [[nodiscard]] bool quantises() const override { return channels_.quantises(); }
  [[nodiscard]] bool draws() const override { return channels_.draws(); }
  [[nodiscard]] bool needs_current() const override { return currents_ > 0; }
  [[nodiscard]] std::size_t states() const override { return channels_.states(); }
  void sense(const Truth& truth, Out state, Out values) const override;

 private:
  std::vector<std::size_t> joints_;
  std::vector<SensorReading> readings_;
  ChannelBank channels_;      ///< the currents of all joints, then their torques
  std::size_t currents_ = 0;  ///< number of channels that measure currents
};

}  // namespace gaitlab::sensors
