// Checks of sensors that need the robot, the control period, or other sensors.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// A sensor with the place of its name.
struct PlacedSensor {
  SensorSelection selection;
  SourceLocation place;
  std::unique_ptr<Sensor> sensor = {};
};

/// Checks that names in the settings of a sensor exist in the robot, and that times are whole control periods. `node` is the
/// map of the sensor.
void check_keys(const Node& node, const PluginSelection& plugin, const Scenario& scenario, Problems& problems);

/// The same checks for any map, whose fields `visit` visits.
void check_names_and_times(const Node& node, const std::function<void(Fields&)>& visit, const Scenario& scenario,
                           Problems& problems);

/// Checks that every sensor measures something that the robot has, that no value or column has two sensors, and that no streams
/// of random numbers are equal.
void check_sensors(const std::vector<PlacedSensor>& sensors, const Scenario& scenario, Problems& problems);

}  // namespace gaitlab
