// Joint controllers: set points and measurements -> commands. Standard library only.
#pragma once
#include "core/plugin/cpg.h"

namespace gaitlab {

/// A joint controller. Called once per control period; the command is held until the next call. Without memory: the caller owns
/// x. update does not allocate.
class Controller {
 public:
  virtual ~Controller() = default;
  [[nodiscard]] virtual std::string_view command_unit() const = 0;  ///< "V" or "N m", as the actuator's; "": either
  [[nodiscard]] virtual std::size_t states() const { return 0; }
  virtual void start(Out) const {}
  /// All spans except x have one entry per joint; command_limit is the actuator's (same unit as the command).
  virtual void update(const Measured&, In setpoint, In command_limit, Out x, Out command) const = 0;
};

}  // namespace gaitlab
