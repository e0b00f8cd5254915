// Tilt of the robot, and detection of a base that rolls over in every period.
#pragma once
#include <optional>

#include "core/recording/judged.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Tilt of the robot at control ticks (States::at_ticks). Each link has an axis that points upwards at the start. The tilt is
/// the smaller of two angles from the vertical: that of the base's axis, and that of the mean of all axes, weighted by the
/// masses of the links. The end of a snake may turn over in its wave while the snake does not, and wheels turn while the base
/// does not.
struct Upright {
  double tilt = 0;                  ///< rad, largest tilt
  double tilt_time = 0;             ///< s, time of the largest tilt
  std::optional<double> over = {};  ///< s, time of the first tick when both axes point below the horizontal
  /// True if the base rolls over in every period. Its turns about horizontal axes in each period add up to at least one whole
  /// turn (rounded), and its axis comes within 45 degrees of upwards and of downwards. False for a base that rocks, tumbles or
  /// is on its back.
  bool rolls = false;
};

/// Tilt of a robot with a floating base; nothing for other bases or without poses. `rolls` is decided over the periods of the
/// limit cycle in the judged window. Without a limit cycle, the last period of the set points, of length `set_points` (s,
/// gait.h), is used or, if `set_points` is 0, the two halves of the window.
std::optional<Upright> upright(const Scenario& scenario, const Recording& record, const Judged& judged, double set_points);

}  // namespace gaitlab::report
