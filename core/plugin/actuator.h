// Interface for actuators, which compute torque and its slope from command and joint speed. Standard library only.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab {

template <class T>
struct BasicDcMotor;
using DcMotor = BasicDcMotor<double>;

/// Ratings of a joint's drive, as stated by its maker. 0 means that the rating is not stated. Verdicts use ratings; the
/// simulation does not.
struct DriveRatings {
  double current_continuous = 0;                  ///< largest continuous RMS current, A
  double torque_peak = 0, torque_continuous = 0;  ///< largest and continuous RMS torque of the gear at the joint, N m
  double speed = 0;                               ///< largest speed at the joint, rad/s
};

/// Friction of a driven joint: T = -dry sign(w) - viscous w. At rest, T is any torque in [-dry, dry], so that the joint sticks
/// as long as the other torques on it are within these bounds.
struct JointFriction {
  double dry = 0, viscous = 0;  ///< N m, N m s/rad
  bool operator==(const JointFriction&) const = default;
};

/// Function from command and joint speed to torque. It has no memory and does not allocate. Inputs and outputs have an element
/// joint * lanes + lane for each joint and lane. An output element depends only on the input elements with its index, so that
/// one loop serves one lane or eight.
class Actuator {
 public:
  virtual ~Actuator() = default;
  [[nodiscard]] virtual std::string_view command_unit() const = 0;  ///< "V" or "N m"
  [[nodiscard]] virtual In command_limit() const = 0;               ///< largest useful |command|; infinity for no limit
  /// Reflected rotor inertia n^2 J, kg m^2, which is added to the joint's inertia. Empty for no rotor inertia.
  [[nodiscard]] virtual In reflected_inertia() const { return {}; }
  /// Computes torque (N m, positive along the joint's axis) and slope = -d(torque)/d(speed) >= 0 (N m s/rad), without the
  /// friction of the joint. The slope is 0 while the torque is limited.
  virtual void effort(In command, In speed, Out torque, Out slope) const = 0;
  /// Electrical quantities: voltage V, current A, saturation (0 none, 1 voltage, 2 current), and power drawn, lost in copper
  /// and lost in the gear, W.
  struct Electrical {
    Out voltage, current, saturation, power_in, copper, gear;
  };
  virtual void electrical(In command, In speed, Electrical) const = 0;  ///< used for trace and ledger only
  /// Computes the effort without the limit that depends on the speed (a motor's largest current). If that limit is not active,
  /// the result equals effort() bit for bit. The contact law `bullet` uses this function, because its solver has separate rows
  /// for the limit. An actuator without such a limit calls effort().
  virtual void unlimited(In command, In speed, Out torque, Out slope) const { effort(command, speed, torque, slope); }
  /// Friction by joint * lanes + lane. Empty for joints without friction.
  [[nodiscard]] virtual std::span<const JointFriction> friction() const { return {}; }
  /// Ratings by joint * lanes + lane. Empty if no rating is stated.
  [[nodiscard]] virtual std::span<const DriveRatings> ratings() const { return {}; }
  /// DC motors (core/laws/dc_motor.h) by joint * lanes + lane, if effort() is exactly the law of these motors; otherwise null.
  /// An engine may then evaluate that law directly, several lanes at once. Entries of joints without a motor
  /// (JointInfo::driven) are not used.
  [[nodiscard]] virtual const DcMotor* dc_motors() const { return nullptr; }
};

}  // namespace gaitlab
