// Values of a new scenario for a robot with legs: its gait, and gains that hold it.
#pragma once
#include <optional>
#include <string>

#include "core/scenario/scenario.h"

namespace gaitlab::app {

/// Sections as texts of a scenario.
struct LegValues {
  std::string controller;  ///< empty if the gains of the module hold the robot
  std::string cpg, duration;
  std::string what;  ///< of the gait: `a trot`
};

/// A trot (tripod from six legs on, wave for an odd number) with stride `share` times 0.3 h, lift 0.1 h and frequency 0.35
/// sqrt(g / h), from six legs on 0.1 sqrt(g / h); h: height of the hips in the stance. Nothing for a robot without legs or
/// motors.
///
/// The controller has the longest of the periods 15, 10, 5, 2 and 1 ms that lets no joint of a leg sag by more than 0.01 rad
/// under an equal share of the robot's weight, else 1 ms. Gains are those of the module times 15 ms / period, and remove the
/// same share of the error per period.
std::optional<LegValues> leg_values(const Scenario& one, double share);

}  // namespace gaitlab::app
