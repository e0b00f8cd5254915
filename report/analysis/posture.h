// Posture of the base in the judged window, at the control ticks after its start up to its end; for folders of an older format
// at the rows of the trace.
#pragma once
#include <limits>

#include "core/recording/judged.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Share of the weight on the ground below which a robot is airborne.
inline constexpr double kAirborne = 0.05;

/// Posture of the base. NaN: not known.
struct Posture {
  /// Share of the ticks at which the ground bears less than kAirborne of the weight.
  double airborne_share = std::numeric_limits<double>::quiet_NaN();
  double borne_share = airborne_share;  ///< normal force of the ground over the weight, mean of the ticks
  double height_min = airborne_share, height_max = airborne_share;  ///< m, of the centre of mass
  double tilt_max = airborne_share;  ///< rad, largest angle between the base's z axis and the vertical
};

/// Computes the posture. airborne_share and borne_share are not known without gravity, for a base that does not float, and for
/// a robot without contact elements. All is unknown if the window contains no tick.
Posture posture(const Scenario& scenario, const Recording& record, const Judged& judged);

/// Horizontal path of the centre of mass in the judged window over the window's length (whole periods), m/s; NaN without a
/// limit cycle. Linear between ticks.
double cycle_speed(const Recording& record, const Judged& judged);

}  // namespace gaitlab::report
