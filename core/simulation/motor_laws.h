// Motor laws that an engine evaluates itself for several lanes at once.
#pragma once
#include "core/plugin/actuator.h"

namespace gaitlab {

/// Both functions return false if the engine does not implement the laws of this actuator.
class MotorLaws {
 public:
  /// Computes the quantities of Actuator::electrical.
  virtual bool evaluate_motors(In command, In speed, const Actuator::Electrical& out) = 0;
  /// Computes the largest torque of DC motors at these speeds in the direction of `torque`, N m; infinity without a limit.
  virtual bool evaluate_available(In speed, In torque, Out available) = 0;

 protected:
  ~MotorLaws() = default;
};

}  // namespace gaitlab
