// What the length of the steps costs in torque: a second plant takes windows of the run again, with other steps.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "core/simulation/plant.h"

namespace gaitlab {

/// How the second plant steps, and what its difference to the first says about the first.
struct StepTwin {
  int steps = 0;      ///< of the first plant for one of the second: 2; 1: as many of both; -2: two of the second for one
  double factor = 0;  ///< error of the first over the difference of the two
  double window = 0;  ///< s, rounded up to control periods
  int cycle = 0;      ///< a window every so many window lengths
};

/// Richardson's estimate of the torque error, in windows of the run: the second plant starts from the state of
/// the first, under the same commands, and every kApart or less, as at rows, the motor torques at their speeds are compared,
///     error = factor |T_1 - T_2|
/// with steps of twice the length and order p: factor kSafety / (2^p - 1); half the length: 2^p times that; with an accuracy
/// made coarser by kCoarser: kSafety / (kCoarser^(2/3) - 1), the error going with about the 2/3rd power of the accuracy
/// (measured, docs/equations.md, 7). The first kGrowth of a window, in which the difference grows, does not count but at
/// the start of the run. Errors that build up over more than a window, and impacts outside of all windows, are not seen. Of
/// motors whose torque does not depend on the speed, such as ideal torque sources, nothing is estimated: no step shows in it.
/// All numbers that change are those of bind(); nothing allocates after the constructor.
class StepError {
 public:
  static constexpr double kApart = 5e-3;         ///< s
  static constexpr double kGrowth = 15e-3;       ///< s, rounded up to control periods
  static constexpr double kCoarser = 4;          ///< accuracy of the second plant over that of the first
  static constexpr double kCoarserError = 2.52;  ///< kCoarser^(2/3): error of the second plant over that of the first
  static constexpr double kSafety = 1.25;        ///< events lower the order, and windows miss some
  static constexpr double kStart = 1.0 / 3;      ///< weight of the first window: other windows stand for a whole cycle each

  StepError(std::unique_ptr<Plant> twin, const StepTwin& how, const Actuator& actuator, const StateLayout& layout,
            std::int64_t control_every, double h);

  /// Of the numbers that bind() takes, for a plant with so many numbers of history.
  static std::size_t size(const StateLayout& layout, std::size_t history);
  void bind(Out numbers);
  /// Before step `step` of the first plant, at its state and history.
  void begin(std::int64_t step, In state, In history);
  /// After that step of h under `command`.
  void follow(std::int64_t step, In state, In command, double h);
  /// RMS of the torque error of a joint so far, N m; 0 before the first comparison.
  [[nodiscard]] double rms(std::size_t joint, std::size_t lane) const;
  /// Largest torque of a joint so far, every kApart of the whole run, N m: what its error is relative to. The first
  /// milliseconds, in which a motor may jump to its limit, are not among them.
  [[nodiscard]] double peak(std::size_t joint, std::size_t lane) const { return peaks_[joint * layout_.lanes + lane]; }
  /// Whether a motor of the lane was compared whose torque depends on the speed.
  [[nodiscard]] bool any(std::size_t lane) const { return sloped_[lane] > 0; }

 private:
  std::unique_ptr<Plant> twin_;
  StepTwin how_;
  const Actuator& actuator_;
  StateLayout layout_;
  std::int64_t window_, cycle_, settle_, stride_;  ///< steps
  Out count_, sloped_, state_, history_;           ///< weight of all comparisons; one entry per lane; the twin's
  Out squares_, peaks_;                            ///< joint * lanes + lane
  std::vector<double> torque_, twin_torque_, slope_;
};

}  // namespace gaitlab
