// Actuators: command and joint speed -> torque and its slope. Standard library only.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab {

template <class T>
struct BasicDcMotor;
using DcMotor = BasicDcMotor<double>;

/// What the drive of a joint bears, as its maker states it; 0: not stated. Verdicts read this; nothing is simulated with it.
struct DriveRatings {
  double current_continuous = 0;                  ///< A, RMS
  double torque_peak = 0, torque_continuous = 0;  ///< N m at the joint, of the gear: largest; RMS
  double speed = 0;                               ///< rad/s at the joint, largest
};

/// Memoryless and elementwise over joint*lanes + lane, so that one plain loop serves one lane and eight. No allocation.
class Actuator {
 public:
  virtual ~Actuator() = default;
  [[nodiscard]] virtual std::string_view command_unit() const = 0;  ///< "V" or "N m"
  [[nodiscard]] virtual In command_limit() const = 0;               ///< largest useful |command|; infinity where there is none
  /// Reflected rotor inertia n^2 J, kg m^2 on the joint, added to the joint's inertia; empty: none anywhere.
  [[nodiscard]] virtual In reflected_inertia() const { return {}; }
  /// torque: N m on the joint, positive along its axis; slope = -d(torque)/d(speed) >= 0, N m s/rad, 0 while limited.
  virtual void effort(In command, In speed, Out torque, Out slope) const = 0;
  /// voltage V, current A, saturation (0 none, 1 voltage, 2 current), power drawn, lost in copper and in the gear, W.
  struct Electrical {
    Out voltage, current, saturation, power_in, copper, gear;
  };
  virtual void electrical(In command, In speed, Electrical) const = 0;  ///< for trace and ledger only
  /// effort as it would be without the limit that depends on the speed (a motor's largest current); the same bits where that
  /// does not bind. Asked by contact.law: bullet, whose rows have the limit apart. Without such a limit: effort.
  virtual void unlimited(In command, In speed, Out torque, Out slope) const { effort(command, speed, torque, slope); }
  /// One per joint * lanes + lane; empty: the maker states none.
  [[nodiscard]] virtual std::span<const DriveRatings> ratings() const { return {}; }
  /// Where effort is nothing but DC motors (core/laws/dc_motor.h): one per joint * lanes + lane, which an engine may then
  /// evaluate itself, several lanes at once; those of joints without a motor (JointInfo::driven) mean nothing. Else nullptr.
  [[nodiscard]] virtual const DcMotor* dc_motors() const { return nullptr; }
};

}  // namespace gaitlab
