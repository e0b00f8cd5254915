// The feet of a run: which bodies carried the robot, with what force, and where it acted.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// A number for each row of the trace.
struct Foot {
  std::string name;  ///< of the body
  std::size_t module = 0, body = 0;
  std::vector<double> fx, fy, fz;  ///< N, of the ground on the robot, world axes
  std::vector<double> x, y, z;     ///< m, world: where the normal forces act; without any, the point before
};

/// Bodies with contact elements that ever carry load, by their numbers: from the columns contact.*, or else from `loads`
/// (loads_at_rows). Without either modules with contact elements, each by the first of its bodies that has any: then fz alone
/// is known, from load.*, as if the ground were level.
std::vector<Foot> feet(const Scenario& scenario, const Recording& record, const Trace& loads);

}  // namespace gaitlab::report
