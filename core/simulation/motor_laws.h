// Motor laws as an engine evaluates them itself, several lanes at once.
#pragma once
#include "core/plugin/actuator.h"

namespace gaitlab {

/// Both functions return false where the engine leaves this actuator to evaluate its own laws.
class MotorLaws {
 public:
  /// As Actuator::electrical.
  virtual bool evaluate_motors(In command, In speed, const Actuator::Electrical& out) = 0;
  /// The most torque that DC motors have at these speeds in the direction of these torques, N m (infinity: no limit).
  virtual bool evaluate_available(In speed, In torque, Out available) = 0;

 protected:
  ~MotorLaws() = default;
};

}  // namespace gaitlab
