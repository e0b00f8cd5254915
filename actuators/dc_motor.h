// Actuator `dc_motor`, which applies core/laws/dc_motor.h with the constants of motor and gear.
#pragma once
#include "actuators/friction_keys.h"
#include "actuators/rating_keys.h"
#include "core/laws/motor_bank.h"
#include "core/plugin/registry.h"

namespace gaitlab::actuators {

/// Efficiency of the gear: as printed in eq. 2, or directional.
enum class EfficiencyModel { paper, directional };

class DcMotorActuator final : public MotorBank {
 public:
  struct Settings : FrictionKeys, RatingKeys {
    PerJoint R{4.3}, Kt{0.00395}, Ks{0.00395}, gear{594}, efficiency{0.7}, u_max{7.4}, i_max{1.2}, rotor_inertia{0};
    EfficiencyModel efficiency_model = EfficiencyModel::paper;
    double turn_speed = 0.6;  ///< rad/s, at the joint
    void fields(Fields& f);
  };
  static const char* const kManual;

  DcMotorActuator(const RobotInfo& robot, const std::vector<const Settings*>& lanes);
};

}  // namespace gaitlab::actuators
