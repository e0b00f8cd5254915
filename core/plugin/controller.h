// Joint controllers: set points and measurements -> commands. Standard library only.
#pragma once
#include "core/plugin/cpg.h"

namespace gaitlab {

/// Called once per control period; the command is held until the next call. Stateless: the host owns x. No allocation in
/// update.
class Controller {
 public:
  virtual ~Controller() = default;
  [[nodiscard]] virtual std::string_view command_unit() const = 0;  ///< "V" or "N m", the actuator's; "" takes either
  [[nodiscard]] virtual std::size_t states() const { return 0; }
  virtual void start(Out) const {}
  /// All spans one entry per joint but x; command_limit is the actuator's (same unit as the command).
  virtual void update(const Measured&, In setpoint, In command_limit, Out x, Out command) const = 0;
};

}  // namespace gaitlab
