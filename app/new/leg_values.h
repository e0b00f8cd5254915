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

/// A trot (tripod from six legs on, wave for an odd number) whose stride is `share` times 0.3 h, with lift 0.1 h and frequency
/// 0.35 sqrt(g / h), h the height of the hips in the stance. Nothing if the robot has no legs, or none with motors.
///
/// The controller has the longest of the periods 15, 10, 5, 2 and 1 ms at which no joint of a leg sags by more than 0.02 rad
/// under an equal share of the robot's weight, with gains in inverse proportion to the period; else 1 ms. A gain then removes
/// the same share of the error per period as that of the module.
std::optional<LegValues> leg_values(const Scenario& one, double share);

}  // namespace gaitlab::app
