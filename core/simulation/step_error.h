// Torque error of the time steps, estimated from the difference to a twin: a second rollout with other steps.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/recording/statistics.h"
#include "core/simulation/state_layout.h"

namespace gaitlab {

/// Times at which a twin with another fixed step runs and is compared, in steps of the first. The twin restarts from the
/// first's numbers at every window, and continues with a separate CPG, controller and commands.
struct TwinWindows {
  int steps = 0;      ///< 2: the twin takes one step for two of the first; -2: two for one; 0: no windows, the whole run
  double factor = 0;  ///< error of the first over the difference of the two
  std::int64_t window = 0;
  std::int64_t cycle = 0;    ///< distance of windows
  std::int64_t settle = 0;   ///< not compared at the start of each window except the first
  std::int64_t compare = 1;  ///< distance of comparisons

  [[nodiscard]] std::int64_t at(std::int64_t step) const { return steps == 0 ? step : step % cycle; }
  [[nodiscard]] bool begins(std::int64_t step) const { return steps != 0 && at(step) == 0; }
  [[nodiscard]] bool runs(std::int64_t step) const { return steps == 0 || at(step) < window; }
  [[nodiscard]] bool compares(std::int64_t step) const { return runs(step) && (at(step) >= settle || step < cycle); }
};

/// Companions: the rollouts beside a run with which it is compared; the first kCompanions are simulated.
enum class Companion {
  twin,     ///< finer steps, or with a given step other ones
  coarse,   ///< coarser steps: shows errors that run and twin share
  chaotic,  ///< gravity times 1 + 1e-9: a motion that changes by that is not predictable, and no step length helps
  ill,      ///< the difference to `chaotic` times 1000: that of gravity times 1 + 1e-6, in proportion
};
constexpr std::size_t kCompanions = 3, kDifferences = 4;

/// Difference of the motor torques between rollouts, every kApart or less, as at rows:
///     error = factor RMS(T_1 - T_2)
/// With an accuracy the larger error of two companions counts: with kFiner and kCoarser times the accuracy, and the factors
/// kOfFiner and kOfCoarser, fitted on drawn scenarios by tests/tools/estimate.py. With a fixed step of order p (Richardson) the
/// factor is kSafety / (2^p - 1) if the twin's step is twice as long, 2^p times that if it is half as long; the first kGrowth
/// of a window, in which the difference grows, does not count except at the start of the run, and impacts outside of all
/// windows are missed. Motors whose torques agree and do not depend on speed have no estimate. All changing numbers are those
/// of bind(); only the constructor allocates.
class StepError {
 public:
  static constexpr double kApart = 5e-3;                       ///< s
  static constexpr double kGrowth = 15e-3;                     ///< s, rounded up to control periods
  static constexpr double kFiner = 0.5, kCoarser = 3;          ///< accuracy of the rollouts over the accuracy of the first
  static constexpr double kOfFiner = 2.26, kOfCoarser = 0.58;  ///< error of the first over the difference to them
  static constexpr double kSafety = 1.25;                      ///< events lower the order, and windows miss some
  static constexpr double kStart = 1.0 / 3;  ///< weight of the first window; each of the others has the weight of a whole cycle
  static constexpr double kLeastPeak = 0.02;  ///< share of the largest peak of all joints: smaller peaks count as this

  /// `accuracy`, per lane: share of a torque's peak by which two rollouts must differ for an event.
  StepError(const StateLayout& layout, std::vector<double> accuracy);

  /// Number of values that bind() takes.
  static std::size_t size(const StateLayout& layout);
  void bind(Out numbers);
  /// Takes the torques of the first, and their slopes, at a moment of comparison, in every step of the run; joint * lanes +
  /// lane.
  void see(In torque, In slope);
  /// Compares the torques of a companion with them, after see(), t seconds after the start.
  void compare(Companion which, In torque, double factor, double weight, double t);
  /// Writes the estimate of a lane so far. Peaks are those of see(): the first milliseconds, in which a motor may jump to its
  /// limit, do not count.
  void put(std::size_t lane, StepTally& tally) const;

 private:
  /// joint * lanes + lane, but count: weight of all comparisons. An event is a difference beyond the accuracy times the peak of
  /// the whole run, which is known at the end alone: the first that is beyond the peak so far is kept as long as it stays
  /// beyond, then replaced by the largest so far.
  struct Difference {
    Out count, squares, event_time, event, largest_time, largest;  ///< s; N m
  };
  [[nodiscard]] const Difference& of(Companion which) const { return apart_[static_cast<std::size_t>(which)]; }
  [[nodiscard]] double rms(Companion which, std::size_t joint, std::size_t lane) const;
  [[nodiscard]] Parting parting(Companion which, std::size_t lane) const;
  [[nodiscard]] double least_peak(std::size_t lane) const;
  [[nodiscard]] double least_event(std::size_t i, double least) const {
    return accuracy_[i % layout_.lanes] * std::max(peaks_[i], least);
  }
  void look_for_event(const Difference& apart, std::size_t i, double difference, double least, double t);

  StateLayout layout_;
  std::vector<double> accuracy_;  ///< per lane
  std::vector<Difference> apart_;
  Out sloped_;                  ///< per lane: 1 if a motor's torque depends on its speed, or twin and run differed
  Out peaks_;                   ///< joint * lanes + lane: largest torque so far, N m
  std::vector<double> torque_;  ///< scratch: torques that see() took
};

}  // namespace gaitlab
