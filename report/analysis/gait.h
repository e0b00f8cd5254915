// Set points of a gait: their period, their growth, and the start of their full size.
#pragma once
#include <memory>
#include <string>

#include "core/recording/judged.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/analysis/look_ahead.h"

namespace gaitlab::report {

/// Least share of the weight that the ground must carry on average, for a robot with a floating base.
inline constexpr double kBorne = 0.5;

struct Gait {
  /// Largest growth of a set point's range after the run; largest drift of its mean and RMS within the window. Shares of the
  /// range.
  static constexpr double kMostGrowth = 0.02, kMostDrift = 0.01;
  /// Period of the recorded set points, s; if the run is too short, that of the CPG alone, or the stated one. 0 if the set
  /// points do not repeat or the period is not known.
  double period = 0;
  /// s, time from which the set points have their full size, as the CPG states (SetPointTimes::full_size).
  double full_size = 0;
  /// s, start of the gait: the latest of the end of a ramp (or of the set points before they repeat), the last change (section
  /// `at`), and the landing, after which the ground carries half of the robot's weight on average in each period.
  double start = 0;
  std::shared_ptr<const LookAhead> ahead = {};  ///< null if it is not known (look_ahead.h)
};

/// Throws PluginError.
Gait gait(const Scenario& scenario, const Recording& record);
/// The gait of a run that has not ended: with the stated period (0 if the CPG states no time), a start that counts the changes
/// and the ramp that are still to come, and without `ahead`. It simulates no CPG. Throws PluginError.
Gait gait_so_far(const Scenario& scenario, const Recording& so_far);

/// Sentence on set points that do not yet have, or do not keep, the size that they have in the judged window; empty if they do.
/// The range after the run (LookAhead) may be at most 2 % larger than in the window; if the CPG states the time of the full
/// size, that time must be within the run instead. Mean and RMS of the first and last period, in the window from the full size
/// on, may differ by at most 1 % of the range. The speed of the set point is compared if the hinge does not have a range.
std::string growth(const Scenario& scenario, const Recording& record, const Judged& judged, const Gait& gait);

}  // namespace gaitlab::report
