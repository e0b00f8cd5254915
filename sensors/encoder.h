// Sensor `encoder`: angle and speed of joints.
#pragma once
#include "sensors/channel_bank.h"

namespace gaitlab::sensors {

/// The speed at a tick with a new sample y is (y - y') / T, where y' is the previous sample and T the time between samples. It
/// is held between samples, and is 0 until the second sample arrives. With `speed: true` it is a separate channel, whose true
/// value is the joint speed.
class EncoderSensor final : public Sensor {
 public:
  struct Settings : ChannelKeys {
    Settings() : ChannelKeys(kRadian) {}
    std::vector<std::string> joints{"*"};
    bool speed = false;
    ChannelKeys tachometer{kRadianPerSecond};
    void fields(Fields& f);
  };
  static const char* const kManual;

  EncoderSensor(const SensorSite& site, const Settings& settings);
  [[nodiscard]] const std::vector<SensorReading>& readings() const override { return readings_; }
  [[nodiscard]] std::vector<SensorStream> streams() const override;
  [[nodiscard]] bool quantises() const override { return angles_.quantises() || speeds_.quantises(); }
  [[nodiscard]] bool draws() const override { return angles_.draws() || speeds_.draws(); }
  [[nodiscard]] std::size_t states() const override { return angles_.states() + speeds_.states() + joints_.size(); }
  void sense(const Truth& truth, Out state, Out values) const override;

 private:
  void differentiate(std::int64_t tick, In angle, Out before, Out speed) const;

  std::vector<std::size_t> joints_;
  std::vector<SensorReading> readings_;  ///< the angles of all joints, then their speeds
  ChannelBank angles_, speeds_;          ///< speeds_ is empty without `speed: true`
};

}  // namespace gaitlab::sensors
