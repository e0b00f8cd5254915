// Gait `keyframes`, joint angles at given times, joined by splines or straight lines.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::cpg {

class Keyframes final : public Cpg {
 public:
  enum class Interpolation { spline, linear, hold };
  struct Frame {
    double time = 0;
    PerJoint angles;
    void fields(Fields& f);
  };
  struct Model {
    std::vector<Frame> frames{{0, {}}, {1, {}}};
    Interpolation interpolation = Interpolation::spline;
    bool repeat = true;
    double ramp = 0;
    void fields(Fields& f);
  };
  struct Settings {
    Model model;
    void fields(Fields& f);
  };
  static const char* const kManual;

  /// Throws std::invalid_argument for fewer than two frames, for times that do not increase from 0, and for repeated frames
  /// whose last angles differ from the first (the message names the joint).
  Keyframes(const RobotInfo& robot, const Settings& settings);
  void output(double t, In, Out setpoint) const override;
  [[nodiscard]] SetPointTimes times() const override { return {repeat_ ? time_.back() : 0, ramp_}; }

 private:
  void check_closed(const RobotInfo& robot);
  void curve();
  void ramp(double t, Out setpoint) const;

  std::size_t joints_;
  bool hold_, repeat_;
  double ramp_;
  std::vector<double> time_;               ///< time of every frame, s
  std::vector<double> angle_, curvature_;  ///< angle, rad, and its second derivative, rad/s^2; index frame * joints + joint
};

}  // namespace gaitlab::cpg
