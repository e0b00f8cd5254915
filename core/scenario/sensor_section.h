// The section `sensors` of a scenario: a map of sensors by name.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/sensor.h"
#include "core/scenario/scenario.h"
#include "core/settings/reader.h"

namespace gaitlab {

/// Reads and checks the section. A map with a key `type` is a single sensor, whose name is its type; {} and [] mean no sensors.
/// Robot and control period of `scenario` must be known; without a robot, names are not checked. `joints` are the names of its
/// joints. Returns an empty list if there is no robot, if there are problems, or if `node` is null.
std::vector<SensorSelection> read_sensors(const Node* node, const Scenario& scenario, const Catalog& catalog, JointNames joints,
                                          Problems& problems);

/// The section with all keys, for the resolved scenario.
Node sensors_node(const Scenario& scenario, const std::vector<std::string>& joints);

/// New sensors, in the order of the scenario. Throws PluginError.
std::vector<std::unique_ptr<Sensor>> make_sensors(const Scenario& scenario);
/// Readings of all sensors, in the order of the scenario. Throws PluginError.
std::vector<SensorReading> sensor_readings(const Scenario& scenario);
/// True if a sensor has a resolution. Runs with other steps, or by another build, then differ by a large share of their
/// torques, because the control loop amplifies differences in the last bit. Throws PluginError.
bool quantised(const Scenario& scenario);
/// True if the seed changes the robot, a value of a sensor, or the losses of set points. Throws PluginError.
bool seed_matters(const Scenario& scenario);
/// Columns of the trace by default: TraceSettings::columns, columns of sensors without a joint, and `segment` in a run with
/// changes. Throws PluginError.
std::vector<std::string> default_columns(const Scenario& scenario);
/// Description of the robot and its sensors for CPG and controller. Throws PluginError.
RobotInfo plugin_info(const Scenario& scenario);

}  // namespace gaitlab
