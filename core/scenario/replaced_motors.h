// Motor values of module types that the scenario's actuator replaces: dropped values, and the defaults used instead; and values
// of another motor that stay beside a servo.
#pragma once
#include <string>
#include <vector>

#include "core/robot_files/type_presets.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Values of module types that the scenario's actuator does not use. The actuator replaces nothing if it has the type on which
/// the module types agree. No values are dropped if the module types do not state any.
class ReplacedMotors {
 public:
  /// `root` is the tree of the scenario. `servo`: the scenario's actuator names a servo. Robot and actuator of `scenario` have
  /// been read. `presets` are of actuators.
  ReplacedMotors(const Node& root, const Scenario& scenario, const TypePresets& presets, bool servo);

  /// A note for each module type whose values are dropped, at the place of the actuator's type; none if the scenario gives
  /// every value. A note for each module type whose motor a servo replaces, and whose other values stay.
  [[nodiscard]] std::vector<Note> notes() const;
  /// Source of the values in the section, preceded by a list of the actuator's defaults that the section does not set.
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  SourceLocation place_;
  std::string actuator_, source_, why_;
  std::vector<TypeFigures> dropped_, kept_;
  std::vector<std::string> defaults_;  ///< defaults that apply, such as `R 4.3 ohm`
  bool given_ = false;                 ///< true if the section sets a value
};

}  // namespace gaitlab
