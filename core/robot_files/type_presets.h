// Presets of module types for motors and controllers of their hinges: defaults of the scenario's sections.
#pragma once
#include <string>
#include <vector>

#include "core/model/robot.h"
#include "core/plugin/catalog.h"
#include "core/settings/reader.h"

namespace gaitlab {

/// Maps of a module type with settings of a kind of plugin: the type's map, then those of its hinges.
std::vector<const Node*> preset_maps(const Node& document, Kind kind);

/// Motor values of a module type that no joint gets.
struct DroppedFigures {
  std::string module, type;  ///< names of the module type and of the plugin
  std::vector<std::string> keys;
};

/// Default value of a plugin's setting per joint.
struct DefaultFigure {
  std::string key, unit;
  double value;
};
/// Default values of a plugin: settings other than 0, and limits. A setting that is common to all joints belongs to the law and
/// is not included.
std::vector<DefaultFigure> default_figures(const Entry& entry);

/// `chosen: R, Kt by default of dc_motor`: a default is not a value of a real motor.
std::string by_default(const std::vector<std::string>& keys, const Entry& entry);

/// Presets of one kind of plugin, actuator or controller. Every joint takes those of its module type and, over them key by key,
/// those of its hinge. If no module type has format 2, one motor serves all joints, and types with different motors disagree,
/// as do types with different types of plugin.
class TypePresets {
 public:
  /// robot: nullptr if it could not be read; documents: one per entry of its types. Both outlive this object.
  TypePresets(Kind kind, const Robot* robot, const std::vector<Node>& documents);

  /// Type of the plugin if the scenario names none.
  [[nodiscard]] const std::string& type() const { return type_; }
  [[nodiscard]] bool agreed() const { return why_.empty(); }
  /// Reason why the module types disagree; empty: they agree.
  [[nodiscard]] const std::string& why() const { return why_; }
  /// Whether the joints get presets if this is the scenario's plugin.
  [[nodiscard]] bool holds(const Entry& entry) const;
  /// Sources of the presets except of the keys `but`, each text once: the `source` of the maps that joints with a motor use
  /// (for a hinge's map without `source` that of its type), and the values that are defaults of the plugin. An empty text: some
  /// have no source.
  [[nodiscard]] std::vector<std::string> sources(const Entry& entry, const std::vector<std::string>& but) const;
  /// Adds a problem at `place`: the module types disagree, with the settings of each.
  void refuse(const SourceLocation& place, Problems& problems) const;
  /// Fills the presets into default settings of `entry`, if the presets are for that type. Findings are added to `problems`.
  void fill(const Entry& entry, void* settings, JointNames joints, Problems& problems) const;

 private:
  /// Maps that a joint uses; nullptr: without settings.
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
  std::vector<Maps> kinds_;            ///< the different ones
  std::vector<std::size_t> of_joint_;  ///< index of each joint's maps in kinds_; empty: the first, if any, is for all joints
  std::vector<const Node*> said_;      ///< maps that disagree
};

/// Presets that no joint gets because the scenario's plugin is `entry`, by module type with a driven hinge, in the robot's
/// order.
std::vector<DroppedFigures> dropped_figures(Kind kind, const Robot& robot, const std::vector<Node>& documents,
                                            const TypePresets& presets, const Entry& entry);

}  // namespace gaitlab
