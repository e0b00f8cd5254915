// Estimate of the torque error of the time steps, from the differences from rollouts with other steps.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/recording/statistics.h"
#include "core/simulation/state_layout.h"

namespace gaitlab {

/// Times, in steps of the run, at which a twin runs and is compared with the run. A twin is a second rollout with another fixed
/// step. It restarts at every window from the numbers of the run and continues with a separate CPG, controller and commands.
struct TwinWindows {
  int steps = 0;      ///< 2: one step of the twin for two of the run; -2: two for one; 0: the whole run, without windows
  double factor = 0;  ///< error of the run over the difference from the twin
  std::int64_t window = 0;
  std::int64_t cycle = 0;    ///< interval between the starts of two windows
  std::int64_t settle = 0;   ///< time without comparisons at the start of each window except the first
  std::int64_t compare = 1;  ///< interval between comparisons

  [[nodiscard]] std::int64_t at(std::int64_t step) const { return steps == 0 ? step : step % cycle; }
  [[nodiscard]] bool begins(std::int64_t step) const { return steps != 0 && at(step) == 0; }
  [[nodiscard]] bool runs(std::int64_t step) const { return steps == 0 || at(step) < window; }
  [[nodiscard]] bool compares(std::int64_t step) const { return runs(step) && (at(step) >= settle || step < cycle); }
};

/// Companions of a run: rollouts with which the run is compared. Only the first kCompanions are simulated.
enum class Companion {
  twin,     ///< finer steps; with a fixed step, steps of another length
  coarse,   ///< coarser steps, for errors that run and twin have in common
  chaotic,  ///< gravity times 1 + StepError::kChaotic. A motion that this changes is not predictable with steps of any length
  ill,      ///< difference from `chaotic` times 1000, as a linear estimate for gravity times 1 + StepError::kIll
};
constexpr std::size_t kCompanions = 3, kDifferences = 4;

/// Estimates the error of the motor torques from their differences between rollouts, at intervals of at most kApart. The
/// torques are left limits, as in trace rows:
///     error = factor RMS(T_1 - T_2)
/// With an accuracy, the larger error of two companions counts. They have kFiner and kCoarser times the accuracy of the run,
/// and the factors kOfFiner and kOfCoarser, which were fitted on randomly drawn scenarios by tests/tools/estimate.py. With a
/// fixed step and an integrator of order p (Richardson), the factor is kSafety / (2^p - 1) if the twin's step is twice as long,
/// and 2^p times this value if the twin's step is half as long. The first kGrowth seconds of a window, in which the difference
/// grows, do not count, except at the start of the run. Impacts outside of all windows are missed. Motors whose torques agree
/// and do not depend on speed have no estimate. All changing numbers are in the array of bind(); only the constructor
/// allocates.
///
/// The torque of a joint with dry friction jumps when the joint stops or turns back, and the torques of other joints jump with
/// it. If the run does so a time d earlier than a companion, the torques differ by the jump J for that time, which is much
/// shorter than kApart and lies between two comparisons. The mean difference over the interval between them, J d / interval,
/// does show it. In an interval in which a joint stops or turns back, in the run or in a companion with another accuracy,
///     error^2 = factor J |mean of T_1 - T_2|, J: larger change of the torque over the interval,
/// because the mean of the squares is J^2 d / interval, and the factor refers to d. The mean is that of two with the smaller
/// absolute value: that of the extrapolated steps is wrong where they extrapolate over a jump, that of the finest steps has
/// order 1 where the torque is smooth.
class StepError {
 public:
  static constexpr double kApart = 5e-3;    ///< longest interval between comparisons, s
  static constexpr double kGrowth = 15e-3;  ///< s, rounded up to control periods; not compared at the start of a window
  static constexpr double kFiner = 0.5, kCoarser = 3;  ///< accuracy of twin and coarse companion over accuracy of the run
  static constexpr double kOfFiner = 2.26, kOfCoarser = 0.58;  ///< error of the run over its difference from each companion
  static constexpr double kSafety = 1.25;    ///< reserve because events lower the order, and windows miss some events
  static constexpr double kStart = 1.0 / 3;  ///< weight of the first window; other windows have the weight 1 of a whole cycle
  static constexpr double kChaotic = 1e-9, kIll = 1e-6;  ///< relative changes of gravity of these companions
  static constexpr double kLeastPeak = 0.02;  ///< lower bound of a joint's peak, as a share of the largest peak of all joints

  /// `accuracy` is, per lane, the share of the peak torque by which two rollouts must differ for an event. `jumps` is 1 for
  /// each joint whose torque jumps at rest, else 0 (index joint * lanes + lane); it is empty if there is none.
  StepError(const StateLayout& layout, std::vector<double> accuracy, std::vector<double> jumps = {});

  /// Number of values that bind() takes.
  static std::size_t size(const StateLayout& layout);
  void bind(Out numbers);
  [[nodiscard]] bool jumps() const { return !jumps_.empty(); }
  /// Adds torques of the run to its mean torques since the last comparison, with the weights of these torques in the means of
  /// the extrapolated and of the finest steps. Not needed without jumps.
  void add(In torque, double extrapolated, double finest) { add(run_, torque, extrapolated, finest); }
  /// The same for a companion.
  void add(Companion which, In torque, double extrapolated, double finest) {
    add(of(which).companion, torque, extrapolated, finest);
  }
  /// Stores the torques of the run and their slopes at a time of comparison (index joint * lanes + lane). Called over the whole
  /// run, also outside of windows. `speed`: speeds of the motors, rad/s; may be empty without jumps.
  void see(In torque, In slope, In speed = {});
  /// Compares the torques of a companion with the torques of the last see(), t seconds after the start.
  void compare(Companion which, In torque, double factor, double weight, double t, In speed = {});
  /// Writes the estimate of a lane so far. The peaks are the largest torques passed to see(), except in the first milliseconds,
  /// because a motor may jump to its limit then.
  void put(std::size_t lane, StepTally& tally) const;

 private:
  /// Course of a rollout since the last comparison, by joint * lanes + lane.
  struct Course {
    Out mean, finest;  ///< mean torques since then, of the extrapolated and of the finest steps, N m
    Out torque, turn;  ///< torque then, N m, and sign of the speed then (0 before the first comparison)
  };
  /// Interval between two comparisons: means and change of the torques, N m, by joint * lanes + lane; per lane 1 if a joint
  /// whose torque jumps stopped or turned back, else 0.
  struct Interval {
    std::vector<double> mean, finest, change, stops;
  };
  /// Sums and events with index joint * lanes + lane, and `count`, the weight of all comparisons. An event is a difference
  /// above the accuracy times the peak of the whole run. This peak is known only at the end. The first difference above the
  /// accuracy times the peak so far is therefore kept until the peak has outgrown it, and is then replaced by the largest
  /// difference so far.
  struct Difference {
    Out count, squares, event_time, event, largest_time, largest;  ///< times in s, differences in N m
    Course companion;
  };
  [[nodiscard]] const Difference& of(Companion which) const { return apart_[static_cast<std::size_t>(which)]; }
  [[nodiscard]] double rms(Companion which, std::size_t joint, std::size_t lane) const;
  [[nodiscard]] Parting parting(Companion which, std::size_t lane) const;
  [[nodiscard]] double least_peak(std::size_t lane) const;
  [[nodiscard]] double least_event(std::size_t i, double least) const {
    return accuracy_[i % layout_.lanes] * std::max(peaks_[i], least);
  }
  void look_for_event(const Difference& apart, std::size_t i, double difference, double least, double t);
  static void add(const Course& course, In torque, double extrapolated, double finest);
  void end(const Course& course, In torque, In speed, Interval& interval) const;

  StateLayout layout_;
  std::vector<double> accuracy_;  ///< per lane
  std::vector<Difference> apart_;
  Out sloped_;  ///< per lane: 1 if a motor's torque depends on its speed, or twin and run differed
  Out peaks_;   ///< joint * lanes + lane: largest torque so far, N m
  std::vector<double> jumps_;
  Course run_;
  std::vector<double> torque_;      ///< scratch: torques of the last see(), N m
  Interval of_run_, of_companion_;  ///< scratch
};

}  // namespace gaitlab
