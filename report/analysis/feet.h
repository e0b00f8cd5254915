// Feet of a run: the bodies that carried the robot, with the forces on them and their points of action.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// A foot, with a number for each row of the trace.
struct Foot {
  std::string name;  ///< of the body
  std::size_t module = 0, body = 0;
  std::vector<double> fx, fy, fz;  ///< N, force of the ground on the robot, world axes
  std::vector<double> x, y, z;     ///< m, world: point of action of the normal forces; without any, the previous point
};

/// Bodies with contact elements that carry load at some time, by number: from the columns contact.*, or else from `loads`
/// (loads_at_rows). Without either: modules with contact elements, each represented by its first body with any, with fz alone,
/// from load.*, as on level ground.
std::vector<Foot> feet(const Scenario& scenario, const Recording& record, const Trace& loads);

}  // namespace gaitlab::report
