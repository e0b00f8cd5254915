// Plugins as the program holds them: whatever one throws comes out as a PluginError, which names it and where it comes from.
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

/// An exception left a plugin: what() is `cpg 'wave' (/home/me/wave.so): output threw: ...`, without the path where it is built
/// in.
class PluginError : public RunError {
 public:
  PluginError(const Entry& entry, const std::string& what);
  Kind kind;
};

/// New settings with the plugin's defaults. Throws PluginError, as all below.
std::shared_ptr<void> default_settings(const Entry& entry);
/// Visits the fields of its settings.
void visit_settings(const Entry& entry, void* settings, Fields& fields);

/// A new instance of the chosen plugin; nullptr where none is chosen. Its calls cost one indirect call more than the plugin's
/// own and allocate nothing. The entry must outlive it.
std::unique_ptr<Cpg> make_cpg(const PluginSelection& selection, const RobotInfo& robot);
std::unique_ptr<Controller> make_controller(const PluginSelection& selection, const RobotInfo& robot);
/// One selection per lane, all of the same entry. Refuses a command_limit or reflected_inertia of another size than joints *
/// lanes when they are asked for.
std::unique_ptr<Actuator> make_actuator(std::span<const PluginSelection* const> lanes, const RobotInfo& robot);
std::unique_ptr<Actuator> make_actuator(const PluginSelection& selection, const RobotInfo& robot);

}  // namespace gaitlab
