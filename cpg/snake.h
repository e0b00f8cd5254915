// Gait `snake`: a wave through the pitch joints and one through the yaw joints of a chain.
#pragma once
#include <vector>

#include "core/plugin/registry.h"

namespace gaitlab::cpg {

class Snake final : public Cpg {
 public:
  struct Wave {
    double amplitude = 0, lag = 0, offset = 0;
    void fields(Fields& f);
  };
  struct Model {
    Wave pitch{0.6, 2.0943951, 0}, yaw;
    double shift = 0, ramp = 1;
    void fields(Fields& f);
  };
  struct Settings {
    double frequency = 0.5;
    Model model;
    void fields(Fields& f);
  };
  static const char* const kManual;

  /// Throws SettingError for a wave without joints, or beyond 3.2 rad.
  Snake(const RobotInfo& robot, const Settings& settings);
  void output(double t, In, Out setpoint) const override;
  [[nodiscard]] std::string note() const override;
  [[nodiscard]] SetPointTimes times() const override { return {s_.frequency > 0 ? 1 / s_.frequency : 0, s_.model.ramp}; }

 private:
  /// A joint of a wave.
  struct Member {
    std::size_t joint;
    bool yaw;
    double sign;   ///< 1 if a positive angle is a right-hand turn about +y or +z, else -1
    double phase;  ///< rad
  };
  Settings s_;
  std::size_t joints_, pitches_ = 0, yaws_ = 0;
  bool branches_ = false;  ///< true if a joint, or the base, carries several chains
  std::vector<Member> members_;
};

}  // namespace gaitlab::cpg
