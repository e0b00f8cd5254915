// Interface for joint controllers, which compute commands from set points and measurements. Standard library only.
#pragma once
#include "core/plugin/cpg.h"

namespace gaitlab {

/// Linear law of a controller near the set point of a joint: command = P e + D de/dt + I (integral of e), in the unit of the
/// command, with the error e in rad. Checks of the position loop, remedies and exports use it; the simulation uses only `most`.
struct PositionGains {
  double P = 0, I = 0, D = 0;  ///< 1/rad, 1/(rad s), s/rad, times the unit of the command
  double N = infinity;         ///< the time constant of the derivative's filter is D / N; infinity: no filter
  double most = infinity;      ///< largest |command| that the controller passes on
  std::int64_t every = 1;      ///< control periods between two samples
  const char* key = "Kp";      ///< key that states P
  const char* unit = "";       ///< unit of that key
  double per_key = 1;          ///< P per unit of that key
  const char* key_of_D = "Kd";
  const char* unit_of_D = "";
  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

/// A joint controller. update() is called once per control period, and its command is held until the next call. The controller
/// has no memory: the caller owns the state x. update() does not allocate.
class Controller {
 public:
  virtual ~Controller() = default;
  /// "V" or "N m", equal to the actuator's unit; "duty", a share of the supply, for actuators that take volts; "" if the
  /// controller works with either of the actuators' units.
  [[nodiscard]] virtual std::string_view command_unit() const = 0;
  [[nodiscard]] virtual std::size_t states() const { return 0; }
  virtual void start(Out) const {}
  [[nodiscard]] virtual std::string note() const { return {}; }  ///< one line for the user about the set-up
  /// By joint; empty if the law is of another kind.
  [[nodiscard]] virtual std::vector<PositionGains> gains() const { return {}; }
  /// Every span except x has one entry per joint. `command_limit` is Actuator::command_limit(), in the unit of the command
  /// (duty: 1).
  virtual void update(const Measured&, In setpoint, In command_limit, Out x, Out command) const = 0;
};

}  // namespace gaitlab
