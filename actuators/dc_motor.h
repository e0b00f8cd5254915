// Actuator `dc_motor`, which applies core/laws/dc_motor.h with the constants of motor and gear.
#pragma once
#include "actuators/efficiency_keys.h"
#include "actuators/friction_keys.h"
#include "actuators/rating_keys.h"
#include "core/laws/motor_bank.h"
#include "core/plugin/registry.h"

namespace gaitlab::actuators {

class DcMotorActuator final : public MotorBank {
 public:
  struct Settings : EfficiencyKeys, FrictionKeys, RatingKeys {
    PerJoint R{4.3}, Kt{0.00395}, Ks{0.00395}, gear{594}, efficiency{0.7}, u_max{7.4}, i_max{1.2}, rotor_inertia{0};
    void fields(Fields& f);
  };
  static const char* const kManual;

  DcMotorActuator(const RobotInfo& robot, const std::vector<const Settings*>& lanes);
};

}  // namespace gaitlab::actuators
