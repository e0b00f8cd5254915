// The module types' motors that the scenario's type of actuator replaces: what is dropped, and which defaults come instead.
#pragma once
#include <string>
#include <vector>

#include "core/robot_files/type_presets.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Nothing is replaced where the scenario's actuator is of the type that the module types agree on; nothing dropped where they
/// state none.
class ReplacedMotors {
 public:
  /// root: the scenario's tree. scenario: its robot and actuator have been read. presets: of actuators.
  ReplacedMotors(const Node& root, const Scenario& scenario, const TypePresets& presets);

  /// One for each module type whose figures are dropped, at the place of the type; none where the scenario gives every figure.
  [[nodiscard]] std::vector<Note> notes() const;
  /// The source of the section, behind the figures that are defaults of the actuator and that it does not say.
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  SourceLocation place_;
  std::string actuator_, source_, why_;
  std::vector<DroppedFigures> dropped_;
  std::vector<std::string> defaults_;  ///< that hold: `R 4.3 ohm`
  bool given_ = false;                 ///< the section has a figure
};

}  // namespace gaitlab
