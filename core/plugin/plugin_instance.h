// Plugins as used by the program: an exception of a plugin becomes a PluginError with the plugin's name and origin.
#pragma once
#include <memory>
#include <span>
#include <string>

#include "core/errors.h"
#include "core/plugin/catalog.h"

namespace gaitlab {

/// A plugin chosen by name, with its settings filled in. entry == nullptr: none.
struct PluginSelection {
  const Entry* entry = nullptr;
  std::shared_ptr<void> settings = {};
};

/// An exception of a plugin: what() is `cpg 'wave' (/home/me/wave.so): output threw: ...`, without the path for a built-in one.
class PluginError : public RunError {
 public:
  PluginError(const Entry& entry, const std::string& what);
  Kind kind;
};

/// New settings with the plugin's defaults. Throws PluginError, as do all functions below.
std::shared_ptr<void> default_settings(const Entry& entry);
/// Visits the fields of a plugin's settings.
void visit_settings(const Entry& entry, void* settings, Fields& fields);

/// A new instance of the chosen plugin; nullptr if none is chosen. A call costs one indirect call more than the plugin's and
/// does not allocate. The entry must outlive it.
std::unique_ptr<Cpg> make_cpg(const PluginSelection& selection, const RobotInfo& robot);
std::unique_ptr<Controller> make_controller(const PluginSelection& selection, const RobotInfo& robot);
/// An actuator from one selection per lane, all of the same entry. Throws if command_limit or reflected_inertia has another
/// size than joints * lanes, when they are called.
std::unique_ptr<Actuator> make_actuator(std::span<const PluginSelection* const> lanes, const RobotInfo& robot);
std::unique_ptr<Actuator> make_actuator(const PluginSelection& selection, const RobotInfo& robot);

}  // namespace gaitlab
