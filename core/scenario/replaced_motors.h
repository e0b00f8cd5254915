// Motors of module types that the scenario's type of actuator replaces: dropped values, and defaults used instead.
#pragma once
#include <string>
#include <vector>

#include "core/robot_files/type_presets.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Nothing is replaced if the scenario's actuator has the type on which the module types agree; nothing is dropped if they
/// state no motor values.
class ReplacedMotors {
 public:
  /// root: the scenario's tree. scenario: with robot and actuator read. presets: of actuators.
  ReplacedMotors(const Node& root, const Scenario& scenario, const TypePresets& presets);

  /// A note for each module type whose values are dropped, at the place of the type; none if the scenario gives every value.
  [[nodiscard]] std::vector<Note> notes() const;
  /// Source of the section, followed by the defaults of the actuator that the section does not set.
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  SourceLocation place_;
  std::string actuator_, source_, why_;
  std::vector<DroppedFigures> dropped_;
  std::vector<std::string> defaults_;  ///< defaults in force: `R 4.3 ohm`
  bool given_ = false;                 ///< the section sets a value
};

}  // namespace gaitlab
