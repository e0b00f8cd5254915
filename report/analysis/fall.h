// Height of the robot above the ground, its least height, and the time at which the robot fell.
#pragma once
#include <optional>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Heights of a robot on a ground, and its fall. A height is that of the centre of mass above the mean height of the surfaces
/// below the contact elements of contact.on (Ground::surface_below). Without contact elements it is measured from the surface
/// below the centre of mass.
struct Fall {
  double standing = 0;              ///< m, height of the start pose, lowered onto the ground
  double lowest = 0;                ///< m, least height of all ticks
  double lowest_time = 0;           ///< s, time of the least height
  std::optional<double> time = {};  ///< s, first tick with a height below Limits::height * standing; empty if the robot did not
                                    ///< fall
  [[nodiscard]] double share() const { return lowest / standing; }
};

/// Heights at control ticks (States::at_ticks), m. Empty if the folder has no poses.
std::vector<double> heights(const Scenario& scenario, const Recording& record);

/// Height of the centre of mass in the start pose, lowered onto the ground, m.
double standing_height(const Scenario& scenario);

/// Heights and fall of a robot with a floating base on a ground. Empty for other robots, for a run without poses, and if the
/// centre of mass of the start pose is not above the ground.
std::optional<Fall> fall(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
