// Feet of a run: the bodies that carried the robot, with the forces on them and their points of action.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// A foot, with a number for each row of the trace.
struct Foot {
  std::string name;  ///< name of the body
  std::size_t module = 0, body = 0;
  std::vector<double> fx, fy, fz;  ///< N, force of the ground on the robot, world axes
  std::vector<double> x, y, z;     ///< m, world: mean point of contact, weighted by normal force; without force, that of the
                                   ///< previous row
};

/// Bodies with contact elements that carry load at some time, in ascending order of index. The forces are from the trace
/// columns contact.*, or else from `loads` (loads_at_rows). If both are missing, they are from the columns load.*, one foot per
/// module with only fz, named after the first body of the module with contact elements.
std::vector<Foot> feet(const Scenario& scenario, const Recording& record, const Trace& loads);

}  // namespace gaitlab::report
