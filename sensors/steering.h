// Sensor `steering`: values that an operator sends to the robot.
#pragma once
#include "core/plugin/sensor.h"

namespace gaitlab::sensors {

class SteeringSensor final : public Sensor {
 public:
  /// A value v: constant, or linear between points, v = v_k + (v_k+1 - v_k) (t - t_k)/(t_k+1 - t_k), and constant before the
  /// first and after the last point.
  struct Sent {
    std::string name, unit;
    std::vector<std::vector<double>> points;  ///< rows t (s), v; empty for a constant value
    double value = 0;
    void fields(Fields& f);
  };
  struct Settings {
    std::vector<Sent> values;
    void fields(Fields& f);
  };
  static const char* const kManual;

  SteeringSensor(const SensorSite& site, const Settings& settings);
  [[nodiscard]] const std::vector<SensorReading>& readings() const override { return readings_; }
  [[nodiscard]] std::vector<SensorStream> streams() const override { return {}; }
  [[nodiscard]] std::size_t states() const override { return 0; }
  [[nodiscard]] bool is_steering() const override { return true; }
  void sense(const Truth& truth, Out state, Out values) const override;

 private:
  double period_;  ///< s
  std::vector<Sent> sent_;
  std::vector<SensorReading> readings_;
};

}  // namespace gaitlab::sensors
