// Interface for central pattern generators, which compute joint set points from the state of an ODE. Standard library only.
#pragma once
#include <string>

#include "core/plugin/fields.h"

namespace gaitlab {

/// Values at a control tick in SI units, with one entry per joint. `touching` has one entry per module, 1 or 0. A value is the
/// true one, unless a sensor of the scenario replaces it. `channels` contains all other sensor values, in the order of
/// RobotInfo::channels. `load` is the sum of the normal forces on the link that the joint moves, N.
struct Measured {
  double t, period;
  In angle, speed, torque, touching;
  In channels = {};
  In load = {};
};

/// Times that a model states about its set points, s. 0 if the model does not state a time.
struct SetPointTimes {
  double period = 0;  ///< period of the set points
  /// Time from which on the set points keep their amplitude, such as the end of a ramp; infinite if they grow for ever. The
  /// ramp of a model without states scales the motion about the set points at t = 0. A robot without initial.angles starts at
  /// these set points.
  double full_size = 0;
  bool grows_from_start = false;  ///< true for a model with states whose ramp works like that of one without
};

/// A model with a state given by ODEs, whose output is the joint set points (rad). The model has no memory: the caller owns the
/// state x. At each control tick the caller calls event() and output(), and then integrates x' to the next tick (RK4, sub-step
/// `cpg.step`, inputs held). No member may allocate after construction. A gait is a Cpg without states.
class Cpg {
 public:
  virtual ~Cpg() = default;
  [[nodiscard]] virtual std::size_t states() const { return 0; }
  [[nodiscard]] virtual std::string state_name(std::size_t index) const {
    return std::to_string(index);
  }  ///< name NAME of a state, for the trace column `cpg.NAME`
  virtual void start(Out) const {}
  virtual void derivative(const Measured&, In, Out) const {}
  virtual void event(const Measured&, Out) const {}              ///< resets phases; called once per tick, before output()
  virtual void output(double t, In x, Out setpoint) const = 0;   ///< x is the state at time t
  [[nodiscard]] virtual std::string note() const { return {}; }  ///< one line for the user about the set-up of the model
  [[nodiscard]] virtual SetPointTimes times() const { return {}; }
};

}  // namespace gaitlab
