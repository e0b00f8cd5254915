// The feet of a run: which bodies carried the robot, with what force, and where it acted.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

struct Foot {
  std::string name;  ///< of the body
  std::size_t module = 0, body = 0;
  /// N, of the ground on the robot, world axes, a number for each row. Without columns contact.* fz alone, of the normal forces
  /// on all of the module's elements, as if the ground were level.
  std::vector<double> fx, fy, fz;
  /// m, world: where the sum of the normal forces acts; where there is none, the point before. Empty without columns contact.*.
  std::vector<double> x, y, z;
};

/// Those that ever carry load: bodies with contact elements, by their numbers; without columns contact.* modules, each by the
/// first of its bodies that has any.
std::vector<Foot> feet(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
