// Sums and peaks over ALL steps of a run, joint by joint: what the trace rows are too sparse for.
#pragma once
#include <array>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Figures of one joint over the steps so far. SI.
struct JointFigures {
  double torque_peak = 0, torque_rms = 0;                  ///< N m, motor torque
  double speed_peak = 0;                                   ///< rad/s
  double current_peak = 0, current_rms = 0;                ///< A
  double error_rms = 0, error_peak = 0;                    ///< rad, set point - angle
  double error_peak_time = 0;                              ///< s: start of the step in which error_peak was reached
  double saturated_voltage = 0, saturated_current = 0;     ///< share of time
  double range_share = 0, range_worst = 0;                 ///< share of time outside [lo, hi]; worst excess, rad
  double setpoint_outside = 0;                             ///< share of time the set point is outside [lo, hi]
  double electrical = 0, copper = 0, gear = 0, shaft = 0;  ///< J: drawn, lost, lost, given to the joint
  double shaft_positive = 0;                               ///< J: shaft power where it is positive
  double created = 0;                                      ///< J: what the gear gave instead of losing (eq. 2, back-driven)
};

/// Number of them, all doubles.
inline constexpr std::size_t kFigures = sizeof(JointFigures) / sizeof(double);

/// Elementwise over joint * lanes + lane. add() allocates nothing.
class Meter {
 public:
  explicit Meter(std::span<const Scenario> lanes);

  /// One part of the step that starts at `time` (s): motion, torque and the actuator law there. measured: one number per lane,
  /// 1 where the part counts, else 0.
  void add(double time, const Applied::Part& part, In setpoint, const Actuator::Report& report, In measured);
  [[nodiscard]] JointFigures figures(std::size_t joint, std::size_t lane) const;

 private:
  std::vector<double> lo_, hi_;
  std::array<std::vector<double>, kFigures> figures_;  // by the members of JointFigures: plain loops over all joints and lanes
  std::size_t lanes_;
  std::vector<double> time_;                ///< a lane, s: only a divisor
  std::vector<double> sum_, share_, seen_;  ///< scratch, joint * lanes + lane: weights; 1 where the part is the motion itself
};

}  // namespace gaitlab
