#include "actuators/register.h"

#include "actuators/dc_motor.h"
#include "actuators/servo.h"
#include "actuators/torque.h"

namespace gaitlab::actuators {

void register_actuators(Registry& registry) {
  add_actuator<DcMotorActuator>(registry, "dc_motor", DcMotorActuator::kManual);
  add_actuator<ServoActuator>(registry, "servo", ServoActuator::kManual);
  add_actuator<TorqueActuator>(registry, "torque", TorqueActuator::kManual);
}

}  // namespace gaitlab::actuators
