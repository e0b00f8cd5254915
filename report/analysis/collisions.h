// Collisions: bodies of a robot that overlap one another or the ground. They can occur because `contact.law: penalty` keeps
// only the contact elements of contact.on above the ground.
#pragma once
#include <cstddef>
#include <optional>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Collisions of pairs of bodies that can move relative to each other, and that no `may_overlap` names. The overlap by design
/// of two bodies of one module (own_overlap.h) does not count. Bodies are given by their index in Robot::bodies.
struct Collision {
  double time = 0;                                    ///< s, first tick with an overlap
  std::size_t first = 0, second = 0;                  ///< the pair with the deepest overlap at that tick
  double depth = 0, deepest_time = 0;                 ///< deepest overlap of the whole run, m, and its time, s
  std::size_t deepest_first = 0, deepest_second = 0;  ///< the pair with the deepest overlap of the whole run
  std::size_t pairs = 0;                              ///< number of pairs that overlapped at any tick
};

/// Bodies in the ground. The depth of a body is the largest distance from a vertex of its shapes, or from a sphere's lowest
/// point, out of the ground (Ground::query).
struct Sunk {
  std::size_t body = 0;                ///< index in Robot::bodies of the deepest body
  double time = 0;                     ///< s, first tick with a body in the ground
  std::size_t bodies = 0;              ///< number of bodies that were in the ground at any tick
  std::size_t first = 0;               ///< index of the deepest body at the first tick
  double depth = 0, deepest_time = 0;  ///< largest depth of the whole run, m, and its time, s
};

struct Overlaps {
  std::size_t shaped = 0;  ///< number of bodies with a shape, or `shape: []` beside others; 0 if overlaps are not known, for
                           ///< example in a run without poses
  std::optional<Collision> collision = {};
  std::optional<Sunk> sunk = {};
};

/// Overlaps of the shapes of all bodies at control ticks (States::at_ticks) that are deeper than Limits::touch or Limits::sink.
/// Not known under `contact.law: bullet`, because its solver keeps bodies apart.
Overlaps overlaps(const Scenario& scenario, const Recording& record);

/// Overlaps of bodies of a robot in this state that are deeper than Limits::touch, at time 0; nothing if there are none.
std::optional<Collision> collision_in(const Scenario& scenario, const RobotState& state);

/// Depth of the robot's deepest point in the ground in this state, m. 0 if no part is in the ground or there is no ground.
double depth_in_ground(const Scenario& scenario, const RobotState& state);

}  // namespace gaitlab::report
