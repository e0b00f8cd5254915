// Sensor `load`: normal force on modules, bodies, joints and legs.
#pragma once
#include "sensors/channel_bank.h"

namespace gaitlab::sensors {

/// A module begins to touch when its load is above `touch`, and ceases when its load is below `release`.
class LoadSensor final : public Sensor {
 public:
  struct Settings : ChannelKeys {
    Settings() : ChannelKeys(kNewton) {}
    std::vector<std::string> joints, legs, modules{"*"}, bodies;
    double touch = 1, release = 0.5;  ///< N
    void fields(Fields& f);
  };
  static const char* const kManual;

  LoadSensor(const SensorSite& site, const Settings& settings);
  [[nodiscard]] const std::vector<SensorReading>& readings() const override { return readings_; }
  [[nodiscard]] std::vector<SensorStream> streams() const override { return channels_.streams(); }
  [[nodiscard]] bool quantises() const override { return channels_.quantises(); }
  [[nodiscard]] bool draws() const override { return channels_.draws(); }
  [[nodiscard]] std::size_t states() const override { return channels_.states(); }
  void sense(const Truth& truth, Out state, Out values) const override;

 private:
  double touch_, release_;
  enum class Of { module, body, joint, leg };
  struct Part {
    Of of;
    std::size_t number;
  };
  std::size_t modules_ = 0;                       ///< number of channels that measure modules, which are the first
  std::vector<Part> parts_;                       ///< by channel
  std::vector<std::vector<std::size_t>> bodies_;  ///< of each leg
  mutable std::vector<double> leg_load_;          ///< scratch
  std::vector<SensorReading> readings_;           ///< loads by channel, then contact of the modules
  ChannelBank channels_;
};

}  // namespace gaitlab::sensors
