#include "sensors/register.h"

#include "sensors/encoder.h"
#include "sensors/imu.h"
#include "sensors/load.h"
#include "sensors/motor.h"
#include "sensors/steering.h"

namespace gaitlab::sensors {

void register_sensors(Registry& registry) {
  add_sensor<EncoderSensor>(registry, "encoder", EncoderSensor::kManual);
  add_sensor<ImuSensor>(registry, "imu", ImuSensor::kManual);
  add_sensor<LoadSensor>(registry, "load", LoadSensor::kManual);
  add_sensor<MotorSensor>(registry, "motor", MotorSensor::kManual);
  add_sensor<SteeringSensor>(registry, "steering", SteeringSensor::kManual);
}

}  // namespace gaitlab::sensors
