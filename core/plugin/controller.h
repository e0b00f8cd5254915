// Interface for joint controllers, which compute commands from set points and measurements. Standard library only.
#pragma once
#include "core/plugin/cpg.h"

namespace gaitlab {

/// A joint controller. update() is called once per control period, and its command is held until the next call. The controller
/// has no memory: the caller owns the state x. update() does not allocate.
class Controller {
 public:
  virtual ~Controller() = default;
  /// "V" or "N m", equal to the actuator's unit; "" if the controller works with either unit.
  [[nodiscard]] virtual std::string_view command_unit() const = 0;
  [[nodiscard]] virtual std::size_t states() const { return 0; }
  virtual void start(Out) const {}
  /// Every span except x has one entry per joint. `command_limit` is Actuator::command_limit(), in the unit of the command.
  virtual void update(const Measured&, In setpoint, In command_limit, Out x, Out command) const = 0;
};

}  // namespace gaitlab
