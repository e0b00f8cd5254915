// Actuators: command and joint speed -> torque and its slope. Standard library only.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab {

template <class T>
struct BasicDcMotor;
using DcMotor = BasicDcMotor<double>;

/// Ratings of a joint's drive, as its maker states them; 0: not stated. Only verdicts use them, not the simulation.
struct DriveRatings {
  double current_continuous = 0;                  ///< A, continuous RMS
  double torque_peak = 0, torque_continuous = 0;  ///< N m at the joint, of the gear: largest; continuous RMS
  double speed = 0;                               ///< rad/s at the joint, largest
};

/// Computes torque from command and joint speed. Without memory and elementwise over joint*lanes + lane, so that one plain loop
/// serves one lane or eight. Does not allocate.
class Actuator {
 public:
  virtual ~Actuator() = default;
  [[nodiscard]] virtual std::string_view command_unit() const = 0;  ///< "V" or "N m"
  [[nodiscard]] virtual In command_limit() const = 0;               ///< largest useful |command|; infinity: no limit
  /// Reflected rotor inertia n^2 J, kg m^2 on the joint, added to the joint's inertia; empty: none.
  [[nodiscard]] virtual In reflected_inertia() const { return {}; }
  /// torque: N m on the joint, positive along its axis; slope = -d(torque)/d(speed) >= 0, N m s/rad, 0 while limited.
  virtual void effort(In command, In speed, Out torque, Out slope) const = 0;
  /// voltage V, current A, saturation (0 none, 1 voltage, 2 current), power drawn, power lost in copper and in the gear, W.
  struct Electrical {
    Out voltage, current, saturation, power_in, copper, gear;
  };
  virtual void electrical(In command, In speed, Electrical) const = 0;  ///< for trace and ledger only
  /// effort without the limit that depends on the speed (a motor's largest current); the same bits where that limit does not
  /// bind. Used by contact.law: bullet, whose rows contain the limit separately. Without such a limit: effort.
  virtual void unlimited(In command, In speed, Out torque, Out slope) const { effort(command, speed, torque, slope); }
  /// Ratings, one per joint * lanes + lane; empty: not stated.
  [[nodiscard]] virtual std::span<const DriveRatings> ratings() const { return {}; }
  /// DC motors (core/laws/dc_motor.h), one per joint * lanes + lane, if effort is exactly their law: an engine may then
  /// evaluate it itself, several lanes at once. Entries of joints without a motor (JointInfo::driven) are not used. Else
  /// nullptr.
  [[nodiscard]] virtual const DcMotor* dc_motors() const { return nullptr; }
};

}  // namespace gaitlab
