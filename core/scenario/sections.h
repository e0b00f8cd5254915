// The sections of a scenario file as settings structs: one walk reads them, writes them out in full and explains them.
#pragma once
#include <functional>
#include <string>

#include "core/scenario/ground_section.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Keys of the robot's initial pose and base.
struct BaseFields {
  Scenario& scenario;
  bool with_position = true;  ///< writing: only if the position matters
  std::size_t numbers = 2;    ///< out: how many numbers the position has
  void fields(Fields& f);
};

/// The section `physics`. The catalog may be absent when writing.
struct PhysicsFields {
  Physics& physics;
  const Catalog* catalog;
  const Problems* problems = nullptr;    ///< reading: what shows that the engine's name was wrong
  ContactLaw law = ContactLaw::penalty;  ///< reading: contact.law, by which the default of the step differs
  void fields(Fields& f);
};

/// The section `actuator`, `controller` or `cpg`: type of the plugin, its settings, and one key of the host.
struct PluginFields {
  Kind kind;
  PluginSelection& choice;
  std::string type;        ///< default type; "none": no plugin
  const Catalog* catalog;  ///< may be absent when writing
  std::function<void(Fields&)> host = {};
  std::function<void(const Entry&, void* settings)> presets = {};  ///< defaults that replace the plugin's
  const Problems* problems = nullptr;                              ///< reading: shows whether the type was wrong
  bool own_keys = true;                                            ///< explaining: false, because the plugin's manual has them
  bool none = false;                                               ///< out: `none` was chosen
  bool sound = true;                                               ///< out: the settings are usable

  void fields(Fields& f);

 private:
  void choose(Fields& f);
};

/// Sections after the robot, in the file's order.
struct SectionFields {
  Scenario& scenario;
  PhysicsFields physics;
  PluginFields actuator, controller, cpg;
  bool has_cpg = true;
  bool writing = false;  ///< writing in full: only the keys of the ground's type

  /// catalog, problems: as above. `actuator_type`: the default.
  SectionFields(Scenario& s, const Catalog* catalog, const Problems* problems, const std::string& actuator_type);
  void fields(Fields& f);
};

/// Names of a robot's joints.
std::vector<std::string> joint_names(const Robot& robot);

}  // namespace gaitlab
