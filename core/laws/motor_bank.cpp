#include "core/laws/motor_bank.h"

namespace gaitlab {

void MotorBank::add(const DcMotor& motor, double reflected_inertia, const DriveRatings& ratings,
                    const JointFriction& friction) {
  motors_.push_back(motor);
  ratings_.push_back(ratings);
  friction_.add(friction);
  limit_.push_back(motor.u_max);
  inertia_.push_back(reflected_inertia);
}

void motors::effort(std::span<const DcMotor> motors, In command, In speed, Out torque, Out slope) {
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const DcMotor::Effort e = motors[i](command[i], speed[i]);
    torque[i] = e.torque;
    slope[i] = e.slope;
  }
}

void motors::unlimited(std::span<const DcMotor> motors, In command, In speed, Out torque, Out slope) {
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const DcMotor::Effort e = motors[i].unlimited(command[i], speed[i]);
    torque[i] = e.torque;
    slope[i] = e.slope;
  }
}

void motors::electrical(std::span<const DcMotor> motors, In command, In speed, const Actuator::Electrical& out) {
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const DcMotor::Effort e = motors[i](command[i], speed[i]);
    out.voltage[i] = e.voltage;
    out.current[i] = e.current;
    out.saturation[i] = e.saturation();
    out.power_in[i] = e.drawn;
    out.copper[i] = e.copper;
    out.gear[i] = e.gear;
  }
}

}  // namespace gaitlab
