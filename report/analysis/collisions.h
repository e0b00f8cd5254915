// Collisions: bodies of a robot that overlap one another or the ground. contact.law penalty keeps only the contact elements of
// contact.on above the ground.
#pragma once
#include <cstddef>
#include <optional>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Collision of bodies that no hinge joins and that can move against each other; indices in Robot::bodies.
struct Collision {
  double time = 0;                                    ///< s, of the first tick with an overlap
  std::size_t first = 0, second = 0;                  ///< the deepest pair at that tick
  double depth = 0, deepest_time = 0;                 ///< m, the largest of all ticks; s
  std::size_t deepest_first = 0, deepest_second = 0;  ///< the pair with that depth
  std::size_t pairs = 0;                              ///< number of pairs that overlapped
};

/// A body in the ground, by the distances out of it (Ground::query) of its shapes' vertices, or of a whole sphere.
struct Sunk {
  std::size_t body = 0;                ///< Robot::bodies: the deepest one
  double time = 0;                     ///< s, of the first tick with a body in the ground
  std::size_t bodies = 0;              ///< number of bodies in the ground
  std::size_t first = 0;               ///< the deepest one at that tick
  double depth = 0, deepest_time = 0;  ///< m, the largest of all ticks; s
};

struct Overlaps {
  std::size_t shaped = 0;  ///< number of bodies with a shape; 0: not known, also for a run without poses
  std::optional<Collision> collision = {};
  std::optional<Sunk> sunk = {};
};

/// Overlaps of the shapes of all bodies at control ticks (States::at_ticks), above Limits::touch and Limits::sink. Not known
/// under contact.law bullet, whose solver keeps bodies apart.
Overlaps overlaps(const Scenario& scenario, const Recording& record);

/// Depth of the robot in the ground in this state, m; 0 if nothing is in it, and without a ground.
double depth_in_ground(const Scenario& scenario, const RobotState& state);

}  // namespace gaitlab::report
