// Settings that replace the CPG of a scenario by recorded set points.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::kit {

/// Settings KEY=VALUE that give a scenario these set points (a row of all joints per control tick, rad) in place of its CPG,
/// and this start. `period` is that of the motion, s, or 0. It lasts as long as its rows. Throws InputError without rows,
/// with more numbers than a scenario may contain, and if section `at` of the scenario changes the CPG.
std::vector<std::string> recorded_settings(const Scenario& scenario, const std::vector<double>& set_points,
                                           const Initial& start, double period);

}  // namespace gaitlab::kit
