// What the length of the steps costs in torque: the difference to a twin, a second rollout with other steps.
#pragma once
#include <cstdint>
#include <vector>

#include "core/plugin/actuator.h"
#include "core/simulation/state_layout.h"

namespace gaitlab {

/// When a twin steps and is compared, in steps of the first. The twin is the same scenario with a CPG, controller and commands
/// of its own, so that an error of angle shows in the torque that it asks for. With an accuracy it runs beside the first from t
/// = 0 and never meets it again; with a fixed step it starts anew from the first's numbers at every window.
struct StepTwin {
  int steps = 1;             ///< of the first for one of the twin: 2; 1: as many of both; -2: two of the twin for one
  double factor = 0;         ///< error of the first over the difference of the two
  std::int64_t window = 0;   ///< 0: all of the run
  std::int64_t cycle = 0;    ///< a window every so many
  std::int64_t settle = 0;   ///< of a window but the first: not compared
  std::int64_t compare = 1;  ///< every so many

  [[nodiscard]] std::int64_t at(std::int64_t step) const { return window == 0 ? step : step % cycle; }
  [[nodiscard]] bool begins(std::int64_t step) const { return at(step) == 0; }
  [[nodiscard]] bool runs(std::int64_t step) const { return window == 0 || at(step) < window; }
  [[nodiscard]] bool compares(std::int64_t step) const { return runs(step) && (at(step) >= settle || step < cycle); }
};

/// How far the motor torques of two rollouts are apart, every kApart or less, as at rows:
///     error = factor RMS(T_1 - T_2)
/// kOfAccuracy, where the twin has kCoarser times the accuracy: fitted on drawn scenarios by tests/tools/estimate.py. With a
/// fixed step of order p (Richardson): kSafety / (2^p - 1) where the twin's is twice as long, 2^p times that where it is half
/// as long; the first kGrowth of a window, in which the difference grows, does not count but at the start of the run, and
/// impacts outside of all windows are not seen. Of motors whose torques agree and depend on no speed nothing is estimated. All
/// numbers that change are those of bind(); nothing allocates after the constructor.
class StepError {
 public:
  static constexpr double kApart = 5e-3;       ///< s
  static constexpr double kGrowth = 15e-3;     ///< s, rounded up to control periods
  static constexpr double kCoarser = 3;        ///< accuracy of the twin over that of the first
  static constexpr double kOfAccuracy = 0.58;  ///< error of the first over the difference to it
  static constexpr double kSafety = 1.25;      ///< events lower the order, and windows miss some
  static constexpr double kStart = 1.0 / 3;    ///< weight of the first window: others have that of a whole cycle each
  static constexpr double kLeastPeak = 0.02;   ///< of the largest of all joints: less is no peak for an event

  /// `accuracy`: of a lane, the share of a torque's peak by which the two must part for an event.
  StepError(const Actuator& actuator, const StateLayout& layout, std::vector<double> accuracy);

  /// Of the numbers that bind() takes.
  static std::size_t size(const StateLayout& layout);
  void bind(Out numbers);
  /// At such a moment, in every step of the run: what the first gives at these speeds.
  void see(In command, In speeds);
  /// The same of the twin, after see(), t seconds after the start.
  void compare(In command, In speeds, double factor, double weight, double t);
  /// RMS of the torque error of a joint so far, N m; 0 before the first comparison.
  [[nodiscard]] double rms(std::size_t joint, std::size_t lane) const;
  /// Largest torque of a joint so far, every kApart of the whole run, N m: what its error is relative to. The first
  /// milliseconds, in which a motor may jump to its limit, are not among them.
  [[nodiscard]] double peak(std::size_t joint, std::size_t lane) const { return peaks_[joint * layout_.lanes + lane]; }
  /// Whether a motor of the lane was compared whose torque depends on the speed, or the two were apart.
  [[nodiscard]] bool any(std::size_t lane) const { return sloped_[lane] > 0; }
  /// When the two parted by more than the accuracy first, s, and in which joint; below 0: they did not.
  [[nodiscard]] double event_time(std::size_t lane) const { return event_[lane] - 1; }
  [[nodiscard]] std::size_t event_joint(std::size_t lane) const { return static_cast<std::size_t>(event_joint_[lane]); }

 private:
  void look_for_event(std::size_t lane, double factor, double t);

  const Actuator& actuator_;
  StateLayout layout_;
  std::vector<double> accuracy_;                      ///< of a lane
  Out count_, sloped_, event_, event_joint_;          ///< weight of all comparisons; entries of a lane; event_: s + 1, or 0
  Out squares_, peaks_;                               ///< joint * lanes + lane
  std::vector<double> torque_, twin_torque_, slope_;  ///< scratch
};

}  // namespace gaitlab
