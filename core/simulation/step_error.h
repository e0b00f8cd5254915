// What the length of the steps costs in torque: the difference to a twin, a second rollout with other steps.
#pragma once
#include <cstdint>
#include <vector>

#include "core/recording/statistics.h"
#include "core/simulation/state_layout.h"

namespace gaitlab {

/// When a twin with another fixed step runs and is compared, in steps of the first. It starts anew from the first's numbers at
/// every window, and goes on with a CPG, controller and commands of its own.
struct TwinWindows {
  int steps = 0;      ///< of the first for one of the twin: 2; -2: two of the twin for one; 0: no windows, all of the run
  double factor = 0;  ///< error of the first over the difference of the two
  std::int64_t window = 0;
  std::int64_t cycle = 0;    ///< a window every so many
  std::int64_t settle = 0;   ///< of a window but the first: not compared
  std::int64_t compare = 1;  ///< every so many

  [[nodiscard]] std::int64_t at(std::int64_t step) const { return steps == 0 ? step : step % cycle; }
  [[nodiscard]] bool begins(std::int64_t step) const { return steps != 0 && at(step) == 0; }
  [[nodiscard]] bool runs(std::int64_t step) const { return steps == 0 || at(step) < window; }
  [[nodiscard]] bool compares(std::int64_t step) const { return runs(step) && (at(step) >= settle || step < cycle); }
};

/// What a run is compared with: rollouts beside it, the first kCompanions of these.
enum class Companion {
  twin,     ///< finer steps, or of a given step others
  coarse,   ///< coarser steps: what run and twin miss alike
  chaotic,  ///< gravity times 1 + 1e-9: a motion that changes by that nobody can predict, and no step length mends it
  ill,      ///< the same difference times 1000: that of gravity times 1 + 1e-6, in proportion
};
constexpr std::size_t kCompanions = 3, kDifferences = 4;

/// How far the motor torques of rollouts are apart, every kApart or less, as at rows:
///     error = factor RMS(T_1 - T_2)
/// and of two rollouts the larger: kOfFiner and kOfCoarser, where these have kFiner and kCoarser times the accuracy, fitted on
/// drawn scenarios by tests/tools/estimate.py. With a fixed step of order p (Richardson): kSafety / (2^p - 1) where the twin's
/// is twice as long, 2^p times that where it is half as long; the first kGrowth of a window, in which the difference grows,
/// does not count but at the start of the run, and impacts outside of all windows are not seen. Of motors whose torques agree
/// and depend on no speed nothing is estimated. All numbers that change are those of bind(); nothing allocates after the
/// constructor.
class StepError {
 public:
  static constexpr double kApart = 5e-3;                       ///< s
  static constexpr double kGrowth = 15e-3;                     ///< s, rounded up to control periods
  static constexpr double kFiner = 0.5, kCoarser = 3;          ///< accuracy of the rollouts over that of the first
  static constexpr double kOfFiner = 2.26, kOfCoarser = 0.58;  ///< error of the first over the difference to them
  static constexpr double kSafety = 1.25;                      ///< events lower the order, and windows miss some
  static constexpr double kStart = 1.0 / 3;   ///< weight of the first window: others have that of a whole cycle each
  static constexpr double kLeastPeak = 0.02;  ///< of the largest of all joints: less is no peak for an event

  /// `accuracy`: of a lane, the share of a torque's peak by which two must part for an event.
  StepError(const StateLayout& layout, std::vector<double> accuracy);

  /// Of the numbers that bind() takes.
  static std::size_t size(const StateLayout& layout);
  void bind(Out numbers);
  /// At such a moment, in every step of the run: torques of the first, and their slopes; joint * lanes + lane.
  void see(In torque, In slope);
  /// The same of a rollout beside it, after see(), t seconds after the start.
  void compare(Companion which, In torque, double factor, double weight, double t);
  /// The figures of a lane so far. Peaks are those of see(): the first milliseconds, in which a motor may jump to its limit,
  /// are not among them.
  void put(std::size_t lane, StepTally& tally) const;

 private:
  struct Difference {
    Out count, time, joint, squares;  ///< weight of all comparisons; of a lane: s + 1, or 0; that joint; joint * lanes + lane
  };
  [[nodiscard]] const Difference& of(Companion which) const { return apart_[static_cast<std::size_t>(which)]; }
  [[nodiscard]] double rms(Companion which, std::size_t joint, std::size_t lane) const;
  [[nodiscard]] Parting parting(Companion which, std::size_t lane) const;
  [[nodiscard]] double least_peak(std::size_t lane) const;
  void look_for_event(const Difference& apart, In torque, std::size_t lane, double factor, double t);

  StateLayout layout_;
  std::vector<double> accuracy_;  ///< of a lane
  std::vector<Difference> apart_;
  Out sloped_;                  ///< of a lane: 1 where a motor's torque depends on its speed, or twin and run were apart
  Out peaks_;                   ///< joint * lanes + lane: largest torque so far, N m
  std::vector<double> torque_;  ///< scratch: what see() took
};

}  // namespace gaitlab
