// Bodies of a robot that pass through one another or through the ground: contact.law penalty keeps the contact elements of
// contact.on above the ground, and nothing else.
#pragma once
#include <cstddef>
#include <optional>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Of bodies that no hinge joins and that can move against each other; numbers of Robot::bodies.
struct Collision {
  double time = 0;                                    ///< s, of the first tick at which any two were in one another
  std::size_t first = 0, second = 0;                  ///< the deepest pair of that tick
  double depth = 0, deepest_time = 0;                 ///< m, the largest of all ticks; s
  std::size_t deepest_first = 0, deepest_second = 0;  ///< the pair that has it
  std::size_t pairs = 0;                              ///< how many pairs met
};

/// A body in the ground, by the ways out (Ground::query) of its shapes' vertices; of a sphere of the whole.
struct Sunk {
  std::size_t body = 0;                ///< Robot::bodies: the deepest one
  double time = 0;                     ///< s, of the first tick at which any was
  std::size_t bodies = 0;              ///< how many were
  std::size_t first = 0;               ///< the deepest one of that tick
  double depth = 0, deepest_time = 0;  ///< m, the largest of all ticks; s
};

struct Overlaps {
  std::size_t shaped = 0;  ///< number of bodies with a shape; 0: nothing is known, also of a run without poses
  std::optional<Collision> collision = {};
  std::optional<Sunk> sunk = {};
};

/// Of the shapes of all bodies at control ticks (States::at_ticks); less than Limits::touch and Limits::sink is nothing. Under
/// contact.law bullet nothing is known: the engine's solver keeps bodies apart.
Overlaps overlaps(const Scenario& scenario, const Recording& record);

/// m: how deep the robot is in the ground in this state; 0 where nothing is, and without a ground.
double depth_in_ground(const Scenario& scenario, const RobotState& state);

}  // namespace gaitlab::report
