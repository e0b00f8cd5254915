// Settings that replace the CPG of a scenario by recorded set points.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::kit {

/// An episode as it was recorded, with rows per control tick.
struct Recorded {
  const std::vector<double>& set_points;     ///< of all joints, rad
  const std::vector<std::string>& steering;  ///< names of steered values, SENSOR.VALUE
  const std::vector<double>& steered;        ///< these values
  const Initial& start;
};

/// Settings KEY=VALUE that give a scenario the set points of an episode in place of its CPG, its steering and its start.
/// `period` is that of the motion, s, or 0. The run lasts as long as the rows. Throws InputError without rows, with more
/// numbers than a scenario may contain, and if section `at` of the scenario changes the CPG.
std::vector<std::string> recorded_settings(const Scenario& scenario, const Recorded& episode, double period);

}  // namespace gaitlab::kit
