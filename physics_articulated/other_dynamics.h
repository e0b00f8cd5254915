// Forward dynamics of another library, as part of an implicit step.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab {
struct Acceleration;
struct BodyWrench;
struct RobotState;
}  // namespace gaitlab

namespace gaitlab::articulated {

/// Accelerations of the robot of one lane, SI, world axes.
class OtherDynamics {
 public:
  OtherDynamics() = default;
  OtherDynamics(const OtherDynamics&) = delete;
  OtherDynamics& operator=(const OtherDynamics&) = delete;
  virtual ~OtherDynamics() = default;

  /// Acceleration under weight, centrifugal and gyroscopic forces alone, at a state with the entries of StateLayout: of the
  /// origin of the base frame (linear), of the base (angular), then of the joints. Rotor inertia is left out.
  virtual void fall(In state, Out out) = 0;
  /// See Plant::accelerate.
  virtual void accelerate(const RobotState& state, In torque, std::span<const BodyWrench> wrenches, Acceleration& out) = 0;
};

}  // namespace gaitlab::articulated
