// Central pattern generators: ODE state -> joint set points. Standard library only.
#pragma once
#include <string>

#include "core/plugin/fields.h"

namespace gaitlab {

/// Sensor values at a control tick; one entry per joint (touching: one per module, 1 or 0). SI units.
struct Measured {
  double t, period;
  In angle, speed, torque, touching;
};

/// A model with a state given by ODEs and joint set points (rad) as output. Without memory: the host owns the state x; at each
/// control tick it calls event and output, and then integrates x' to the next tick (RK4, sub-step `cpg.step`, inputs held). No
/// member may allocate after construction. A gait is a Cpg without states.
class Cpg {
 public:
  virtual ~Cpg() = default;
  [[nodiscard]] virtual std::size_t states() const { return 0; }
  [[nodiscard]] virtual std::string state_name(std::size_t index) const {
    return std::to_string(index);
  }  ///< column `cpg.NAME`
  virtual void start(Out) const {}
  virtual void derivative(const Measured&, In, Out) const {}
  virtual void event(const Measured&, Out) const {}              ///< phase resets; once per tick, before output
  virtual void output(double t, In x, Out setpoint) const = 0;   ///< x is the state AT t
  [[nodiscard]] virtual std::string note() const { return {}; }  ///< one line for the user about its set-up
};

}  // namespace gaitlab
