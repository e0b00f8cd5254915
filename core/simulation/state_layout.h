// Where the numbers of a plant's state are, and what a step leaves beside them.
#pragma once
#include <cstddef>

#include "core/plugin/fields.h"

namespace gaitlab {

struct RobotState;

/// Where the numbers of a rollout's state are. Entry e of lane l is at e * lanes + l; SI, world axes.
struct StateLayout {
  std::size_t joints = 0, lanes = 1;
  static constexpr std::size_t kPosition = 0;          ///< origin of the base frame, 3
  static constexpr std::size_t kOrientation = 3;       ///< quaternion w x y z, base -> world
  static constexpr std::size_t kVelocity = 7;          ///< of that origin, 3
  static constexpr std::size_t kAngularVelocity = 10;  ///< 3
  static constexpr std::size_t kAngles = 13;           ///< then the joints' speeds

  [[nodiscard]] std::size_t size() const { return (kAngles + 2 * joints) * lanes; }
  [[nodiscard]] std::size_t angles() const { return kAngles * lanes; }
  [[nodiscard]] std::size_t speeds() const { return (kAngles + joints) * lanes; }

  void read(In state, std::size_t lane, RobotState& out) const;
  void write(const RobotState& in, std::size_t lane, Out state) const;
};

/// What the last step applied, for the ledger and not for the trace. Works: J that the robot gave, a lane; every stage's power
/// with the integrator's weight.
struct Applied {
  In torque;                    ///< mean motor torque, N m (joint * lanes + lane)
  In speed;                     ///< joint speeds at which the motors gave it, rad/s: where their power is to be asked
  In contact, friction, stops;  ///< work on the ground along its normal, along it, and on the hinge stops
};

}  // namespace gaitlab
