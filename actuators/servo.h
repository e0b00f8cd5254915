// Actuator `servo`, which applies core/laws/dc_motor.h with the numbers of a servo's data sheet.
#pragma once
#include "actuators/friction_keys.h"
#include "actuators/rating_keys.h"
#include "core/laws/motor_bank.h"
#include "core/plugin/registry.h"

namespace gaitlab::actuators {

/// Meaning of a servo's stall torque and no-load speed: those of the motor, before the losses of gear and friction, or those of
/// the driven joint, after them.
enum class StallTorqueAt { motor, joint };

class ServoActuator final : public MotorBank {
 public:
  struct Settings : FrictionKeys, RatingKeys {
    Settings();
    PerJoint voltage, stall_torque, no_load_speed;  ///< V, N m, rad/s; 0 if not given
    PerJoint stall_current, efficiency;             ///< A, 1; 0 if not stated
    PerJoint u_max, i_max;                          ///< V, A; 0 if not stated: motor() then derives the values
    PerJoint rotor_inertia;                         ///< kg m^2 at the joint
    PerJoint load_friction;                         ///< share of the sum of motor's and load's torque that the gear eats
    StallTorqueAt stall_torque_at = StallTorqueAt::motor;
    void fields(Fields& f);
    /// The motor of a joint. It has no torque if the necessary numbers are not given.
    [[nodiscard]] DcMotor motor(std::size_t joint) const;
    [[nodiscard]] JointFriction friction(std::size_t joint) const;
    [[nodiscard]] double inertia(std::size_t joint) const;  ///< kg m^2 at the joint

   private:
    /// Line of the motor, from the torque at rest to the speed without torque, at `voltage`.
    struct Line {
      double torque, speed;  ///< N m, rad/s
    };
    [[nodiscard]] Line line(std::size_t joint) const;
    [[nodiscard]] double load(std::size_t joint) const;
    /// Reports errors in the numbers of a joint at their keys. Returns false if there is an error.
    bool check(Fields& f, std::size_t joint, bool alone) const;
  };
  static const char* const kManual;

  ServoActuator(const RobotInfo& robot, const std::vector<const Settings*>& lanes);
};

}  // namespace gaitlab::actuators
