// How a robot holds itself in the judged window: at the control ticks behind its start, up to its end; in folders of an older
// format at the rows of the trace.
#pragma once
#include <limits>

#include "core/recording/judged.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Below this share of the weight on the ground a robot is airborne.
inline constexpr double kAirborne = 0.05;

/// NaN: not known.
struct Posture {
  /// Of the ticks, those at which the ground bears less than kAirborne of the weight.
  double airborne_share = std::numeric_limits<double>::quiet_NaN();
  double borne_share = airborne_share;  ///< normal force of the ground over the weight, mean of the ticks
  double height_min = airborne_share, height_max = airborne_share;  ///< m, of the centre of mass
  double tilt_max = airborne_share;  ///< rad, largest angle between the base's z axis and the vertical
};

/// airborne_share and borne_share are not known without gravity, of a base that does not float, and of a robot that has no
/// contact elements. All is unknown where the window holds no tick.
Posture posture(const Scenario& scenario, const Recording& record, const Judged& judged);

/// m/s, horizontal way of the centre of mass in the judged window over its length, which is whole periods; NaN without a limit
/// cycle. Between ticks the way is linear.
double cycle_speed(const Recording& record, const Judged& judged);

}  // namespace gaitlab::report
