// Names that the texts of `equations` may contain.
#pragma once
#include <string>
#include <vector>

#include "core/expression/expression.h"
#include "core/expression/functions.h"
#include "core/plugin/oscillators.h"

namespace gaitlab::cpg {

using expression::Function;
using expression::Term;

/// End of a message about an unknown name, with the nearest known name or with all known names.
std::string offer_name(const std::string& found, const std::vector<std::string>& known, const std::string& kind);

/// Predefined values per joint: the common keys, and the joint's place in the robot's tree.
struct GivenValue {
  const char* name;
  double (*value)(const RobotInfo&, const OscillatorKeys&, const std::vector<double>& phases, std::size_t joint);
};
std::span<const GivenValue> given_values();

class EquationNames {
 public:
  /// Kind of a text. A text of the kind `parameter` may contain the parameters that are declared before it.
  enum class Where { parameter, initial, derivative, event, output };
  enum class Kind {
    pi,
    time,
    given,
    parameter,
    state,
    angle,
    speed,
    torque,
    touching,
    load,
    limb_load,
    limb_touching,
    channel,
    weight,
    lag
  };
  struct Entry {
    std::string name;
    Kind kind;
    std::size_t slot = 0;  ///< index among the names of the kind given, parameter, state or channel
  };

  EquationNames();
  /// Declares a name. Returns an error message for an invalid name, or "".
  [[nodiscard]] std::string declare(const std::string& name, Kind kind, std::size_t slot);

  /// Declares a name for a value of a sensor (RobotInfo::channels). Returns an error message, or "".
  [[nodiscard]] std::string declare_channel(const std::string& name, const std::string& channel);
  /// Declares the names with a dot in a tree, which are values of sensors.
  void declare_channels(const Term& term);
  /// Sensor value of each slot of Kind::channel.
  [[nodiscard]] const std::vector<std::string>& channels() const { return channels_; }

  [[nodiscard]] const Entry* find(const std::string& name) const;
  /// Adds the faults of a tree that belongs to `where`. The `slot` of a parameter is its own index.
  void check(const Term& term, Where where, std::size_t slot, std::vector<expression::Fault>& faults) const;

 private:
  struct SourceLocation {
    Where where;
    std::size_t slot;
    bool in_sum;
  };
  void check(const Term& term, const SourceLocation& place, std::vector<expression::Fault>& faults) const;
  void check_name(const Term& term, const SourceLocation& place, std::vector<expression::Fault>& faults) const;
  [[nodiscard]] static bool may_name(const Entry& entry, const SourceLocation& place);
  [[nodiscard]] std::string unknown(const std::string& name, const SourceLocation& place) const;

  std::vector<Entry> entries_;
  std::vector<std::string> channels_;
};

}  // namespace gaitlab::cpg
