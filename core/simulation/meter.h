// Sums and peaks over ALL steps of a run, joint by joint; the trace rows are too sparse for them.
#pragma once
#include <array>
#include <vector>

#include "core/recording/statistics.h"
#include "core/scenario/scenario.h"
#include "core/simulation/meter_pass.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Accumulates statistics elementwise over joint * lanes + lane. add() allocates nothing.
class Meter {
 public:
  explicit Meter(std::span<const Scenario> lanes);

  /// Adds one part of the step that starts at `time` (s): motion, torque and the actuator law there. available: the largest
  /// torque that the actuator has in that direction at that speed, N m; infinity: no limit. measured: one number per lane, 1 if
  /// the part counts, else 0.
  void add(double time, const StepEffort::Part& part, In setpoint, const Actuator::Electrical& report, In available,
           In measured);
  [[nodiscard]] JointStatistics statistics(std::size_t joint, std::size_t lane) const;
  /// Writes the values of each joint for Recording::ticks into `row` and resets the peaks since the last tick.
  void tick(std::size_t lane, Out row);

 private:
  static constexpr std::size_t kInputs = 11;  ///< inputs of a pass
  void add(MeterPass pass, const std::array<const double*, kInputs>& inputs, std::size_t from);

  // All arrays have a length of whole blocks (kMeterBlock); elements behind the entries stay 0.
  std::vector<double> driven_;
  std::vector<double> lo_, hi_;
  std::array<std::vector<double>, kJointStatistics.size()> sums_;  // plain loops over all joints and lanes
  // Peaks since the last tick: N m, rad, saturation at that torque, rad/s, share of the available torque, V, A.
  std::vector<double> recent_peak_, recent_error_, recent_limit_, recent_speed_, recent_envelope_, recent_voltage_,
      recent_current_;
  std::size_t lanes_, entries_;
  void (*pass_)(const MeterPass&);
  std::vector<double> time_;  ///< simulated time of each lane, s: only a divisor
  // Scratch, joint * lanes + lane: weights; 1 where the part is the motion itself.
  std::vector<double> weight_, share_, seen_;
  std::array<std::array<double, kMeterBlock>, kInputs> rest_{};  // inputs of the last block, if it is not whole
};

}  // namespace gaitlab
