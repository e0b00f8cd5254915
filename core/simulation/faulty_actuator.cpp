#include "core/simulation/faulty_actuator.h"

#include <utility>

#include "core/laws/motor_bank.h"

namespace gaitlab {

FaultyActuator::FaultyActuator(std::unique_ptr<Actuator> whole, std::size_t size) : whole_(std::move(whole)), faults_(size) {
  if (const DcMotor* const motors = whole_->dc_motors()) motors_.assign(motors, motors + size);
}

bool FaultyActuator::set(std::size_t motor, const Fault& fault) {
  if (faults_[motor] == fault) return false;
  faults_[motor] = fault;
  if (motors_.empty()) return true;
  DcMotor& own = motors_[motor];
  own = whole_->dc_motors()[motor];
  if (fault.open) own.Kt = own.Ks = own.back_emf_damping = 0;
  if (fault.share != 1) {
    own.Kt *= fault.share;
    own.back_emf_damping *= fault.share;
  }
  return true;
}

void FaultyActuator::scale(Out torque, Out slope) const {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const double share = faults_[i].open ? 0 : faults_[i].share;
    if (share == 1) continue;
    torque[i] *= share;
    slope[i] *= share;
  }
}

void FaultyActuator::effort(In command, In speed, Out torque, Out slope) const {
  if (!motors_.empty()) return motors::effort(motors_, command, speed, torque, slope);
  whole_->effort(command, speed, torque, slope);
  scale(torque, slope);
}

void FaultyActuator::unlimited(In command, In speed, Out torque, Out slope) const {
  if (!motors_.empty()) return motors::unlimited(motors_, command, speed, torque, slope);
  whole_->unlimited(command, speed, torque, slope);
  scale(torque, slope);
}

void FaultyActuator::electrical(In command, In speed, Electrical out) const {
  if (!motors_.empty()) return motors::electrical(motors_, command, speed, out);
  whole_->electrical(command, speed, out);
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    if (faults_[i].open) {
      for (const Out values : {out.voltage, out.current, out.saturation, out.power_in, out.copper, out.gear}) values[i] = 0;
    } else if (faults_[i].share != 1) {
      out.gear[i] += (1 - faults_[i].share) * (out.power_in[i] - out.copper[i] - out.gear[i]);
    }
  }
}

}  // namespace gaitlab
