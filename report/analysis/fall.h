// Height of the robot above the ground below it, its least height and whether it fell.
#pragma once
#include <optional>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Fall of a robot. Heights are of the centre of mass above the mean height of the surfaces that carry the contact elements of
/// contact.on (Ground::surface_below), or the surface below the centre of mass if there are none.
struct Fall {
  double standing = 0;              ///< m, of the start pose, lowered onto the ground
  double lowest = 0;                ///< m, of all ticks
  double lowest_time = 0;           ///< s
  std::optional<double> time = {};  ///< s, of the first tick below Limits::height; none: it did not fall
  [[nodiscard]] double share() const { return lowest / standing; }
};

/// Heights at control ticks (States::at_ticks), m; empty: the folder has no poses.
std::vector<double> heights(const Scenario& scenario, const Recording& record);

/// Height of the start pose, lowered onto the ground, m.
double standing_height(const Scenario& scenario);

/// Fall of a floating base above a ground; none for other runs, without poses, and if the start pose has its centre of mass not
/// above the ground.
std::optional<Fall> fall(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
