// Presets of module types for motors and controllers of hinges, which are defaults for the scenario's sections.
#pragma once
#include <string>
#include <vector>

#include "core/model/robot.h"
#include "core/plugin/catalog.h"
#include "core/robot_files/identification.h"
#include "core/settings/reader.h"

namespace gaitlab {

/// Maps of a module type with settings for a kind of plugin: first the map of the type, then the maps of its hinges.
std::vector<const Node*> preset_maps(const Node& document, Kind kind);

/// Motor values of a module type.
struct TypeFigures {
  std::string module, type;  ///< names of the module type and of the plugin
  std::vector<std::string> keys;
};

/// Default value of a plugin's setting that may differ from joint to joint.
struct DefaultFigure {
  std::string key, unit;
  double value;
};
/// Default values of the settings of a plugin that may differ from joint to joint: values other than 0, and limits. Settings
/// that all joints share belong to the law and are not included. A value that follows from other settings is kNotStated.
std::vector<DefaultFigure> default_figures(const Entry& entry);

/// Text such as `chosen: R, Kt by default of dc_motor`, for values that are plugin defaults instead of values of a real motor.
std::string by_default(const std::vector<std::string>& keys, const Entry& entry);
/// Source of values some of which are defaults: `chosen: R, Kt by default of dc_motor; the rest: a data sheet`.
std::string with_defaults(const std::vector<std::string>& keys, const Entry& entry, const std::string& source);
/// The source without such defaults, with which the resolved scenario of a run begins it.
std::string without_defaults(const std::string& source, const Entry& entry);

/// False, with a problem at each place, if module types name actuators or controllers that do not exist and the scenario does
/// not name one instead. The keys are then unknown.
bool known_types(const std::vector<Node>& documents, const Node& scenario, const Catalog& catalog, Problems& problems);

/// Presets for actuators or for controllers. Each joint uses the presets of its module type, which presets of its hinge replace
/// key by key. Module types disagree if they name different types of plugin.
class TypePresets {
 public:
  /// `robot` is null if it could not be read. `documents` has one entry per module type of the robot. Both must outlive this
  /// object.
  TypePresets(Kind kind, const Robot* robot, const std::vector<Node>& documents);

  /// Type of plugin that applies if the scenario names none.
  [[nodiscard]] const std::string& type() const { return type_; }
  [[nodiscard]] bool agreed() const { return why_.empty(); }
  /// Reason why the module types disagree, or "" if they agree.
  [[nodiscard]] const std::string& why() const { return why_; }
  /// True if some joint gets presets when `entry` is the scenario's plugin.
  [[nodiscard]] bool holds(const Entry& entry) const;
  /// Sources of all presets except the keys `but`, each text once. A source is the value of `source` in a map that joints with
  /// a motor use; a hinge's map without `source` uses the source of its type, unless this is a list of logs. Values that are
  /// defaults of the plugin count as a source. An empty text means that some values have no source. With `unidentified`,
  /// sources of the joints without logs alone.
  [[nodiscard]] std::vector<std::string> sources(const Entry& entry, const std::vector<std::string>& but,
                                                 bool unidentified = false) const;
  /// Logs of the presets of a joint with a motor; none if a key of its hinge replaces a number of the type, except for limits
  /// and numbers that only move currents.
  [[nodiscard]] Identification identification(std::size_t joint) const;
  /// Adds a problem at `place`, which states that the module types disagree, with notes at their settings.
  void refuse(const SourceLocation& place, Problems& problems) const;
  /// Writes the presets into the default settings of `entry`, if the presets are for this type of plugin. Errors are added to
  /// `problems`.
  void fill(const Entry& entry, void* settings, JointNames joints, Problems& problems) const;

 private:
  /// Maps that a joint uses. Null means that the type or hinge has no settings.
  struct Maps {
    const Node* of_type = nullptr;
    const Node* of_hinge = nullptr;
    bool operator==(const Maps&) const = default;
  };
  /// Map of the logs of these maps, or nullptr.
  static const Node* logs_of(const Maps& maps);
  void choose(const Robot& robot, const std::vector<Node>& documents);
  void read(const Entry& entry, const Maps& maps, void* settings, JointNames joints, Problems& of_type,
            Problems& of_hinge) const;

  Kind kind_;
  std::string type_, why_;
  std::vector<Maps> kinds_;            ///< the distinct combinations
  std::vector<std::size_t> of_joint_;  ///< index in kinds_ for each joint; empty if kinds_ has at most one element
  std::vector<const Node*> said_;      ///< maps that disagree with each other
};

/// Values that module types state. One element per module type with a driven hinge, in the order of Robot::types.
std::vector<TypeFigures> stated_figures(Kind kind, const Robot& robot, const std::vector<Node>& documents);

}  // namespace gaitlab
