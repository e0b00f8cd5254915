// What module types say of the motors of their hinges and of the controllers behind them: defaults of the scenario's sections.
#pragma once
#include <string>
#include <vector>

#include "core/model/robot.h"
#include "core/plugin/catalog.h"
#include "core/settings/reader.h"

namespace gaitlab {

/// The maps in which a module type says something of a kind of plugin: its own, then those of its hinges.
std::vector<const Node*> preset_maps(const Node& document, Kind kind);

/// What a module type states of its motors, and what no joint gets.
struct DroppedFigures {
  std::string module, type;  ///< names of the module type, and of the plugin that these are figures of
  std::vector<std::string> keys;
};

/// A value per joint that a plugin has by default.
struct DefaultFigure {
  std::string key, unit;
  double value;
};
/// The default figures of a plugin: settings other than 0, and limits. What is one for all joints is of its law, and no figure.
std::vector<DefaultFigure> default_figures(const Entry& entry);

/// `chosen: R, Kt by default of dc_motor`: a default is nobody's figure of a real motor.
std::string by_default(const std::vector<std::string>& keys, const Entry& entry);

/// The presets of one kind of plugin, actuator or controller. Every joint takes those of its own module type and, over them key
/// by key, those of its hinge. Where no module type is of format 2, one motor serves all, and types that name different ones
/// disagree, as they do where they name different types of plugin.
class TypePresets {
 public:
  /// robot: nullptr where it could not be read; documents: one per entry of its types. They outlive this.
  TypePresets(Kind kind, const Robot* robot, const std::vector<Node>& documents);

  /// Of the plugin, where the scenario names none.
  [[nodiscard]] const std::string& type() const { return type_; }
  [[nodiscard]] bool agreed() const { return why_.empty(); }
  /// Why the module types do not agree; empty: they do.
  [[nodiscard]] const std::string& why() const { return why_; }
  /// Whether the joints get presets where the scenario's plugin is this one.
  [[nodiscard]] bool holds(const Entry& entry) const;
  /// Who says the presets but for some keys, each text once: the `source` of the maps that joints with a motor go by, where
  /// that of a hinge's map is its type's if it has none, and which figures are defaults of the plugin. An empty one: nobody
  /// says some.
  [[nodiscard]] std::vector<std::string> sources(const Entry& entry, const std::vector<std::string>& but) const;
  /// A problem at `place`: that the module types do not agree, and what each of them says.
  void refuse(const SourceLocation& place, Problems& problems) const;
  /// Into default settings of `entry`, where that is the type meant here. Findings go to `problems`.
  void fill(const Entry& entry, void* settings, JointNames joints, Problems& problems) const;

 private:
  /// What a joint goes by; nullptr: says nothing.
  struct Maps {
    const Node* of_type = nullptr;
    const Node* of_hinge = nullptr;
    bool operator==(const Maps&) const = default;
  };
  void choose_common(const std::vector<const Node*>& maps);
  void choose_each(const Robot& robot, const std::vector<Node>& documents);
  void read(const Entry& entry, const Maps& maps, void* settings, JointNames joints, Problems& of_type,
            Problems& of_hinge) const;

  Kind kind_;
  std::string type_, why_;
  std::vector<Maps> kinds_;            ///< those that differ
  std::vector<std::size_t> of_joint_;  ///< which of them each joint has; empty: the first of them, if any, is for all
  std::vector<const Node*> said_;      ///< the maps that do not agree
};

/// By module type with a driven hinge, in the robot's order: presets that no joint gets, because the scenario's plugin is
/// `entry`.
std::vector<DroppedFigures> dropped_figures(Kind kind, const Robot& robot, const std::vector<Node>& documents,
                                            const TypePresets& presets, const Entry& entry);

}  // namespace gaitlab
