// The sections of a scenario file as structs with fields, from which reader, writer and manual are derived.
#pragma once
#include <functional>
#include <string>

#include "core/scenario/ground_section.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

inline constexpr const char* kSupplySection = "supply";

/// Keys of the robot's initial pose and base.
struct BaseFields {
  Scenario& scenario;
  bool with_position = true;  ///< true if the position is written; used for writing
  std::size_t numbers = 2;    ///< number of elements of the position; set by fields()
  void fields(Fields& f);
};

/// The section `physics`. `catalog` may be null when writing.
struct PhysicsFields {
  Physics& physics;
  const Catalog* catalog;
  const Problems* problems = nullptr;    ///< used for reading; new problems show that the engine's name is wrong
  ContactLaw law = ContactLaw::penalty;  ///< value of contact.law, on which the default of the step depends; used for reading
  void fields(Fields& f);
};

/// The section `actuator`, `controller` or `cpg`: the type of the plugin, its settings, and keys of the program itself.
struct PluginFields {
  Kind kind;
  PluginSelection& choice;
  std::string type;        ///< default type; "none" for no plugin
  const Catalog* catalog;  ///< may be null when writing
  std::function<void(Fields&)> host = {};
  std::function<void(const Entry&, void* settings)> presets = {};  ///< sets defaults that replace those of the plugin
  const Problems* problems = nullptr;  ///< used for reading; new problems show that the type is wrong
  bool own_keys = true;  ///< false for the manual of the scenario, because the plugin's manual contains these keys
  bool none = false;     ///< true if `none` was chosen; set by fields()
  bool sound = true;     ///< true if the settings can be used; set by fields()

  void fields(Fields& f);

 private:
  void choose(Fields& f);
};

/// Sections after the robot, in the order of the file.
struct SectionFields {
  Scenario& scenario;
  PhysicsFields physics;
  PluginFields actuator, controller, cpg;
  bool has_cpg = true;
  bool writing = false;  ///< true to write the sections in full, with only the keys of the ground's type

  /// `catalog` and `problems` are passed to PhysicsFields and PluginFields. `actuator_type` is the default type of the
  /// actuator.
  SectionFields(Scenario& s, const Catalog* catalog, const Problems* problems, const std::string& actuator_type);
  void fields(Fields& f);
};

/// Names of a robot's joints.
std::vector<std::string> joint_names(const Robot& robot);
/// Names of a robot's bodies.
std::vector<std::string> body_names(const Robot& robot);

}  // namespace gaitlab
