// Layout of the state of a plant, and the quantities that a step leaves beside it.
#pragma once
#include <cstddef>

#include "core/plugin/fields.h"

namespace gaitlab {

struct RobotState;

/// Indices of the numbers of a rollout's state. Entry e of lane l is at e * lanes + l; SI, world axes.
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

/// Torques and works of the last step, for the ledger and the statistics, not for the trace.
struct StepEffort {
  /// Motors and joints at one moment within the step, with the moment's weights.
  struct Part {
    In torque;             ///< of the motors, N m (joint * lanes + lane)
    In speed;              ///< speed of each joint at that torque, rad/s: power is computed with it
    In angle;              ///< rad
    In sum;                ///< per lane: weight in integrals, s; negative if an extrapolation subtracts it
    In share;              ///< per lane: weight in shares of time, s; 0: only an auxiliary of the integration, or `instant`
    bool instant = false;  ///< without duration: the step's start under its command, for peaks alone
  };
  std::span<const Part> parts;
  In contact, friction, stops;  ///< per lane: J that the robot gave the ground along its normal, along it, and the hinge stops
  In hinges;                    ///< per lane: J taken by dampers and friction of passive hinges
};

/// StepEffort of a plant with one lane whose steps have one part.
class OnePart {
 public:
  void set(In torque, In speed, In angle, double h) {
    h_ = h;
    part_ = {torque, speed, angle, {&h_, 1}, {&h_, 1}};
  }
  /// works: contact, friction, stops, hinges, J
  [[nodiscard]] StepEffort applied(In works) const {
    return {{&part_, 1}, works.subspan(0, 1), works.subspan(1, 1), works.subspan(2, 1), works.subspan(3, 1)};
  }

 private:
  double h_ = 0;
  StepEffort::Part part_;
};

}  // namespace gaitlab
