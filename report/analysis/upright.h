// Tilt of the base, and whether it rolls over in every period.
#pragma once
#include <optional>

#include "core/recording/judged.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Tilt of the base's axis that pointed upwards at the start, at control ticks (States::at_ticks).
struct Upright {
  double tilt = 0;                  ///< rad, largest angle from the vertical
  double tilt_time = 0;             ///< s
  std::optional<double> over = {};  ///< s, of the first tick at which the axis points below the horizontal
  /// Whether the base rolls: about level axes it makes one whole turn or more in every period, to the nearest number of turns,
  /// and its axis comes within 45 degrees of upwards and of downwards. False for a base that rocks, tumbles or lies on its
  /// back.
  bool rolls = false;
};

/// Tilt of a floating base; none for other bases, and without poses. Periods are those of the limit cycle in the judged window;
/// without one the last periods of the set points, `set_points` s long (gait_period.h); if these do not repeat (0), the halves
/// of the window.
std::optional<Upright> upright(const Scenario& scenario, const Recording& record, const Judged& judged, double set_points);

}  // namespace gaitlab::report
