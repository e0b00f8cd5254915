// Height of the robot above the ground, its least height, and the time at which the robot fell.
#pragma once
#include <optional>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Heights of a robot on a ground, and its fall. A height is that of the centre of mass above the mean height of the surfaces
/// below the contact elements of contact.on (Ground::surface_below). Without contact elements it is measured from the surface
/// below the centre of mass. The height at each tick is compared with the lower of two heights: in the start pose, and in the
/// pose of the set points (within the ranges of the hinges), upright on its lowest contact elements. A robot that follows its
/// set points down does not fall.
struct Fall {
  double lowest = 0;                ///< m, height at the tick with the least share
  double lowest_time = 0;           ///< s, time of that tick
  double share = 0;                 ///< `lowest` / the height with which it is compared
  bool told = false;                ///< true if it is compared with the height of the set points' pose
  std::optional<double> time = {};  ///< s, first tick with a share below Limits::height; empty if the robot did not fall
  bool stays = false;               ///< true if the share is also below this limit at the last tick
};

/// Heights at control ticks (States::at_ticks), m. Empty if the folder has no poses.
std::vector<double> heights(const Scenario& scenario, const Recording& record);

/// Height of the centre of mass in the start pose, lowered onto the ground, m.
double standing_height(const Scenario& scenario);

/// Mean height of the surfaces below the contact elements in a state, m.
double surface_height(const Scenario& scenario, const RobotState& state);

/// Heights and fall of a robot with a floating base on a ground. Empty for other robots, for a run without poses, and if the
/// centre of mass of the start pose is not above the ground.
std::optional<Fall> fall(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
