// Posture of the base in the judged window. It is computed from the control ticks after the window's start up to its end.
#pragma once
#include <limits>

#include "core/recording/judged.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// A robot is airborne if the ground carries less than this share of its weight.
inline constexpr double kAirborne = 0.05;

/// Posture of the base. Values that are not known are NaN.
struct Posture {
  /// Share of the ticks at which the ground carries less than kAirborne of the weight.
  double airborne_share = std::numeric_limits<double>::quiet_NaN();
  double borne_share = airborne_share;  ///< mean over the ticks of the ground's normal force / weight
  double height_min = airborne_share, height_max = airborne_share;  ///< m, height of the centre of mass
  double tilt_max = airborne_share;  ///< rad, largest angle between the base's z axis and the vertical
};

/// Computes the posture. airborne_share and borne_share are not known without gravity, without a floating base or without
/// contact elements. No value is known if the window contains no tick.
Posture posture(const Scenario& scenario, const Recording& record, const Judged& judged);

/// Horizontal displacement of the centre of mass over the judged window (whole periods) / length of the window, m/s. Positions
/// are interpolated linearly between ticks. NaN without a limit cycle.
double cycle_speed(const Recording& record, const Judged& judged);

}  // namespace gaitlab::report
