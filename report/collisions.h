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
  double time = 0;                                    ///< s, of the first row in which any two were in one another
  std::size_t first = 0, second = 0;                  ///< the deepest pair of that row
  double depth = 0;                                   ///< m, the largest of all rows
  std::size_t deepest_first = 0, deepest_second = 0;  ///< the pair that has it
  std::size_t pairs = 0;                              ///< how many pairs met
};

inline constexpr double kCollides = 5e-4;  ///< m: less is the roundness of the shapes' prisms and of a hinge's stop

/// The shapes of all bodies in every row of the trace; none: no two are further than kCollides in one another.
std::optional<Collision> collisions(const Scenario& scenario, const Recording& record);

/// A body in the ground.
struct Sunk {
  std::size_t body = 0;  ///< Robot::bodies: the deepest one
  double time = 0;       ///< s, of the first row in which any was
  double depth = 0;      ///< m, the largest of all rows
};

inline constexpr double kSinks = 0.005;  ///< m: less is the softness of the ground

/// On a plane; none: no body is deeper than kSinks in it, or the ground is another.
std::optional<Sunk> sunk(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
