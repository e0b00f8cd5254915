// Tilt of the base, and detection of a base that rolls over in every period.
#pragma once
#include <optional>

#include "core/recording/judged.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Tilt of the axis of the base that points upwards at the start, at control ticks (States::at_ticks).
struct Upright {
  double tilt = 0;                  ///< rad, largest angle of the axis from the vertical
  double tilt_time = 0;             ///< s, time of the largest angle
  std::optional<double> over = {};  ///< s, of the first tick at which the axis points below the horizontal
  /// True if the base rolls over in every period. In each period, its turns about horizontal axes add up to at least one whole
  /// turn (rounded), and the axis comes within 45 degrees of upwards and of downwards. False for a base that rocks, tumbles or
  /// is on its back.
  bool rolls = false;
};

/// Tilt of a floating base; nothing for other bases or without poses. `rolls` is decided over the periods of the limit cycle in
/// the judged window. Without a limit cycle, the last period of the set points, of length `set_points` (s, gait_period.h), is
/// used; if that is 0, the two halves of the window.
std::optional<Upright> upright(const Scenario& scenario, const Recording& record, const Judged& judged, double set_points);

}  // namespace gaitlab::report
