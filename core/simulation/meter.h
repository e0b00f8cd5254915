// Sums and peaks over ALL steps of a run, joint by joint: what the trace rows are too sparse for.
#pragma once
#include <array>
#include <vector>

#include "core/recording/statistics.h"
#include "core/scenario/scenario.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Elementwise over joint * lanes + lane. add() allocates nothing.
class Meter {
 public:
  explicit Meter(std::span<const Scenario> lanes);

  /// One part of the step that starts at `time` (s): motion, torque and the actuator law there. available: the most that the
  /// actuator has in the direction of that torque at that speed, N m; infinity: no limit. measured: one number per lane, 1
  /// where the part counts, else 0.
  void add(double time, const StepEffort::Part& part, In setpoint, const Actuator::Electrical& report, In available,
           In measured);
  [[nodiscard]] JointStatistics statistics(std::size_t joint, std::size_t lane) const;
  /// What Recording::ticks has of each joint, into `row`; its peaks start anew.
  void tick(std::size_t lane, Out row);

 private:
  std::vector<bool> driven_;
  std::vector<double> lo_, hi_;
  std::array<std::vector<double>, kJointStatistics.size()> sums_;  // plain loops over all joints and lanes
  // Since the last tick: N m, rad, saturation at that torque, rad/s, share of the torque that there is, V, A.
  std::vector<double> recent_peak_, recent_error_, recent_limit_, recent_speed_, recent_envelope_, recent_voltage_,
      recent_current_;
  std::size_t lanes_;
  std::vector<double> time_;  ///< of each lane, s: only a divisor
  // Scratch, joint * lanes + lane: weights; 1 where the part is the motion itself.
  std::vector<double> weight_, share_, seen_;
};

}  // namespace gaitlab
