// Plugins as the program uses them: an exception of a plugin becomes a PluginError with the plugin's name and origin.
#pragma once
#include <memory>
#include <span>
#include <string>

#include "core/errors.h"
#include "core/plugin/catalog.h"
#include "core/plugin/sensor.h"

namespace gaitlab {

/// A plugin that is selected by name, with its settings.
struct PluginSelection {
  const Entry* entry = nullptr;
  std::shared_ptr<void> settings = {};
};

/// An exception of a plugin. what() is `cpg 'wave' (/home/me/wave.so): output threw: ...`, without the path for a built-in
/// plugin.
class PluginError : public RunError {
 public:
  PluginError(const Entry& entry, const std::string& what, std::string at = {});
  Kind kind;
  std::string key;  ///< key of the plugin's section with the wrong value (SettingError); empty if the plugin names none
};

/// New settings with the plugin's defaults. This function and all functions below throw PluginError.
std::shared_ptr<void> default_settings(const Entry& entry);
/// Visits the fields of a plugin's settings.
void visit_settings(const Entry& entry, void* settings, Fields& fields);

/// A new instance of the selected plugin, or null if none is selected. Each call through the instance costs one additional
/// indirect call and does not allocate. The entry must outlive the instance.
std::unique_ptr<Cpg> make_cpg(const PluginSelection& selection, const RobotInfo& robot);
std::unique_ptr<Controller> make_controller(const PluginSelection& selection, const RobotInfo& robot);
/// A sensor, which is built in: only exceptions of its constructor become PluginErrors.
std::unique_ptr<Sensor> make_sensor(const PluginSelection& selection, const SensorSite& site);
/// An actuator from one selection per lane, all with the same entry. Its functions command_limit, reflected_inertia and ratings
/// throw if the plugin returns another size than joints * lanes.
std::unique_ptr<Actuator> make_actuator(std::span<const PluginSelection* const> lanes, const RobotInfo& robot);
std::unique_ptr<Actuator> make_actuator(const PluginSelection& selection, const RobotInfo& robot);

}  // namespace gaitlab
