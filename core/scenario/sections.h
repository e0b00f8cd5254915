// The sections of a scenario file as settings structs: one walk reads them, writes them out in full and explains them.
#pragma once
#include <functional>
#include <string>

#include "core/scenario/ground_section.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// The robot's keys on how it stands.
struct BaseFields {
  Scenario& scenario;
  bool with_position = true;  ///< writing: only where it says something
  std::size_t numbers = 2;    ///< out: of the position
  void fields(Fields& f);
};

/// `physics`. The catalog may be absent when writing.
struct PhysicsFields {
  Physics& physics;
  const Catalog* catalog;
  const Problems* problems = nullptr;  ///< reading: what shows that the engine's name was wrong
  bool solver = false;                 ///< reading: contact.law is bullet, whose default step is another
  void fields(Fields& f);
};

/// `actuator`, `controller` or `cpg`: a plugin by its type, its settings, and the host's own key.
struct PluginFields {
  Kind kind;
  PluginSelection& choice;
  std::string type;        ///< where the scenario names none; "none": no plugin
  const Catalog* catalog;  ///< may be absent when writing
  std::function<void(Fields&)> host = {};
  std::function<void(const Entry&, void* settings)> presets = {};  ///< defaults other than the plugin's own
  const Problems* problems = nullptr;                              ///< reading: what shows that the type was wrong
  bool own_keys = true;                                            ///< explaining: the plugin's manual has them
  bool none = false;                                               ///< out: `none` was chosen
  bool sound = true;                                               ///< out: the settings can be used

  void fields(Fields& f);

 private:
  void choose(Fields& f);
};

/// What follows the robot, in the file's order.
struct SectionFields {
  Scenario& scenario;
  PhysicsFields physics;
  PluginFields actuator, controller, cpg;
  bool has_cpg = true;
  bool writing = false;  ///< out in full: only what the ground's type has

  /// catalog, problems: as above. `actuator_type`: the default.
  SectionFields(Scenario& s, const Catalog* catalog, const Problems* problems, const std::string& actuator_type);
  void fields(Fields& f);
};

/// Names of a robot's joints.
std::vector<std::string> joint_names(const Robot& robot);

}  // namespace gaitlab
