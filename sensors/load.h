// Sensor `load`: normal force on modules and bodies.
#pragma once
#include "sensors/channel_bank.h"

namespace gaitlab::sensors {

/// A module begins to touch when its load is above `touch`, and ceases when its load is below `release`.
class LoadSensor final : public Sensor {
 public:
  struct Settings : ChannelKeys {
    Settings() : ChannelKeys(kNewton) {}
    std::vector<std::string> modules{"*"}, bodies;
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
  std::size_t modules_ = 0;              ///< number of channels that measure modules
  std::vector<std::size_t> parts_;       ///< module or body of each channel
  std::vector<SensorReading> readings_;  ///< loads of modules and bodies, then contact of the modules
  ChannelBank channels_;                 ///< the modules, then the bodies
};

}  // namespace gaitlab::sensors
