// Layout of the state of a plant, and the torques and works of a step.
#pragma once
#include <cstddef>

#include "core/plugin/fields.h"

namespace gaitlab {

struct RobotState;

inline constexpr std::size_t kEighths = 8;  ///< equal parts of a step; Plant::state_within gives the states between them

/// Indices of the numbers of the state of a rollout. Entry e of lane l has the index e * lanes + l. SI units, world axes.
struct StateLayout {
  std::size_t joints = 0, lanes = 1;
  std::size_t plays = 0;                               ///< number of joints with play (joints_with_play)
  static constexpr std::size_t kPosition = 0;          ///< origin of the base frame, 3 numbers
  static constexpr std::size_t kOrientation = 3;       ///< quaternion w x y z, base -> world
  static constexpr std::size_t kVelocity = 7;          ///< velocity of the origin of the base frame, 3 numbers
  static constexpr std::size_t kAngularVelocity = 10;  ///< angular velocity of the base, 3 numbers
  /// Joint angles, followed by the joint speeds, the angles of the motors of joints with play, and the speeds of these motors.
  static constexpr std::size_t kAngles = 13;

  [[nodiscard]] std::size_t size() const { return (kAngles + 2 * joints + 2 * plays) * lanes; }
  [[nodiscard]] std::size_t angles() const { return kAngles * lanes; }
  [[nodiscard]] std::size_t speeds() const { return (kAngles + joints) * lanes; }
  [[nodiscard]] std::size_t rotors() const { return (kAngles + 2 * joints) * lanes; }
  [[nodiscard]] std::size_t rotor_speeds() const { return (kAngles + 2 * joints + plays) * lanes; }

  void read(In state, std::size_t lane, RobotState& out) const;
  void write(const RobotState& in, std::size_t lane, Out state) const;
};

/// Torques and works of the last step, for the ledger and the statistics, not for the trace.
struct StepEffort {
  /// Motors and joints at one time within the step, with the weights of this time.
  struct Part {
    In torque;  ///< motor torque, N m (joint * lanes + lane)
    In speed;   ///< speed of the motor, geared, at that torque, rad/s, for the computation of power; that of the joint unless
                ///< its gear has play
    In angle;   ///< joint angle, rad
    In sum;     ///< per lane: weight in integrals, s; negative if an extrapolation subtracts the part
    In share;   ///< per lane: weight in shares of time, s; 0 for an auxiliary part of the integration or if `instant`
    bool instant = false;  ///< start of the step under its command, without duration; counts for peaks only
  };
  std::span<const Part> parts;
  In contact, friction, stops;  ///< per lane, J: work on the ground along its normal and tangent to it, and on stops
  In hinges;                    ///< per lane, J: work absorbed by dampers and friction of passive hinges
};

/// StepEffort for a plant with one lane whose steps have one part.
class OnePart {
 public:
  void set(In torque, In speed, In angle, double h) {
    h_ = h;
    part_ = {torque, speed, angle, {&h_, 1}, {&h_, 1}};
  }
  /// `works` contains the works contact, friction, stops, hinges, J.
  [[nodiscard]] StepEffort applied(In works) const {
    return {{&part_, 1}, works.subspan(0, 1), works.subspan(1, 1), works.subspan(2, 1), works.subspan(3, 1)};
  }

 private:
  double h_ = 0;
  StepEffort::Part part_;
};

}  // namespace gaitlab
