// Sums and peaks for each joint over ALL steps of a run, because trace rows are too sparse.
#pragma once
#include <array>
#include <utility>
#include <vector>

#include "core/recording/statistics.h"
#include "core/scenario/scenario.h"
#include "core/simulation/meter_pass.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Accumulates statistics in arrays with index joint * lanes + lane. add() allocates nothing.
class Meter {
 public:
  explicit Meter(std::span<const Scenario> lanes);

  /// Adds one part of the step that starts at `time` (s). `report` contains the quantities of the actuator law in that part,
  /// and `dry` the power lost in friction of each joint, W. `available` is the largest torque of the actuator at the speed of
  /// the joint, in the direction of the torque, N m; infinity if there is no limit. `measured` has one number per lane: 1 if
  /// the part counts, else 0.
  void add(double time, const StepEffort::Part& part, In setpoint, const Actuator::Electrical& report, In dry, In available,
           In measured);
  /// Counts the reversals of the commands of a lane that begin at `time` (s), one per joint.
  void command(double time, std::size_t lane, In command);
  /// Peak and RMS of the sum of all motors' |current|, A.
  [[nodiscard]] std::pair<double, double> current(std::size_t lane) const;
  [[nodiscard]] JointStatistics statistics(std::size_t joint, std::size_t lane) const;
  /// Writes the values of each joint for Recording::ticks into `row` and resets the peaks since the last tick.
  void tick(std::size_t lane, Out row);

 private:
  static constexpr std::size_t kInputs = 12;  ///< number of input arrays of a pass
  void add(MeterPass pass, const std::array<const double*, kInputs>& inputs, std::size_t from);

  // The length of all arrays is a multiple of kMeterBlock; elements after the last entry stay 0.
  std::vector<double> driven_;
  std::vector<double> lo_, hi_;
  std::array<std::vector<double>, kJointStatistics.size()> sums_;  // one array per statistic
  // Peaks since the last tick: torque (N m), error (rad), saturation at the torque peak, speed (rad/s), share of the available
  // torque, voltage (V), current (A).
  std::vector<double> recent_peak_, recent_error_, recent_limit_, recent_speed_, recent_envelope_, recent_voltage_,
      recent_current_;
  std::size_t lanes_, entries_;
  void (*pass_)(const MeterPass&);
  std::vector<double> last_command_;                   ///< last command other than 0
  std::vector<double> current_peak_, current_square_;  ///< for the sum of all motors' |current|: A, A^2 s
  std::vector<double> time_;                           ///< simulated time of each lane, s, by which sums are divided
  // Scratch with index joint * lanes + lane: weights in sums and in shares of time (s); seen_ is 1 if the peaks of the part
  // count, else 0.
  std::vector<double> weight_, share_, seen_;
  std::array<std::array<double, kMeterBlock>, kInputs> rest_{};  // inputs of the last block if the entries do not fill it
};

}  // namespace gaitlab
