#include "core/laws/motor_bank.h"

namespace gaitlab {

void MotorBank::add(const DcMotor& motor, double reflected_inertia, const DriveRatings& ratings) {
  motors_.push_back(motor);
  ratings_.push_back(ratings);
  limit_.push_back(motor.u_max);
  inertia_.push_back(reflected_inertia);
}

void MotorBank::effort(In command, In speed, Out torque, Out slope) const {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const DcMotor::Effort e = motors_[i](command[i], speed[i]);
    torque[i] = e.torque;
    slope[i] = e.slope;
  }
}

void MotorBank::unlimited(In command, In speed, Out torque, Out slope) const {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const DcMotor::Effort e = motors_[i].unlimited(command[i], speed[i]);
    torque[i] = e.torque;
    slope[i] = e.slope;
  }
}

void MotorBank::electrical(In command, In speed, Electrical out) const {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const DcMotor::Effort e = motors_[i](command[i], speed[i]);
    out.voltage[i] = e.voltage;
    out.current[i] = e.current;
    out.saturation[i] = e.saturation();
    out.power_in[i] = e.drawn;
    out.copper[i] = e.copper;
    out.gear[i] = e.gear;
  }
}

}  // namespace gaitlab
