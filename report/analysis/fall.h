// Height of the robot above the ground below it, how low it came and whether it fell.
#pragma once
#include <optional>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Heights are of the centre of mass above the ground: above the mean height of what carries the contact elements of contact.on
/// (Ground::surface_below), or the centre of mass where there are none.
struct Fall {
  double standing = 0;              ///< m, of the start pose, lowered onto the ground
  double lowest = 0;                ///< m, of all ticks
  double lowest_time = 0;           ///< s
  std::optional<double> time = {};  ///< s, of the first tick below Limits::height; none: it did not fall
  [[nodiscard]] double share() const { return lowest / standing; }
};

/// m, at control ticks (States::at_ticks); empty: the folder has no poses.
std::vector<double> heights(const Scenario& scenario, const Recording& record);

/// m, of the start pose, lowered onto the ground.
double standing_height(const Scenario& scenario);

/// Of a floating base above a ground; none of other runs, without poses, and where the pose stands with its centre of mass not
/// above the ground.
std::optional<Fall> fall(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
