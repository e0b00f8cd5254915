// How a robot holds itself in the judged window: at the trace ticks behind its start, up to its end.
#pragma once
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/summary.h"

namespace gaitlab::report {

/// Below this share of the weight on the ground a robot is airborne.
inline constexpr double kAirborne = 0.05;

/// NaN: not known.
struct Posture {
  double airborne_share;          ///< of the ticks, those at which the ground bears less than kAirborne of the weight
  double height_min, height_max;  ///< m, of the centre of mass
  double tilt_max;                ///< rad, largest angle between the base's z axis and the vertical
};

/// airborne_share is not known without gravity, of a base that does not float, and of a robot that has no contact elements. All
/// is unknown where the window holds no tick.
Posture posture(const Scenario& scenario, const Recording& record, const Judged& judged);

/// m/s, horizontal way of the centre of mass in the judged window over its length, which is whole periods; NaN without a limit
/// cycle. Between trace ticks the way is linear.
double cycle_speed(const Recording& record, const Judged& judged);

}  // namespace gaitlab::report
