// DC motors of every joint and lane: the motor law applied to lists, and the base class of actuators that use this law.
#pragma once
#include "core/laws/dc_motor.h"
#include "core/plugin/actuator.h"

namespace gaitlab {

/// Counterparts of the functions of equal name in Actuator, for a list of motors.
namespace motors {
void effort(std::span<const DcMotor> motors, In command, In speed, Out torque, Out slope);
void unlimited(std::span<const DcMotor> motors, In command, In speed, Out torque, Out slope);
void electrical(std::span<const DcMotor> motors, In command, In speed, const Actuator::Electrical& out);
}  // namespace motors

/// Friction by joint * lanes + lane, for Actuator::friction().
class FrictionList {
 public:
  void add(const JointFriction& friction) {
    any_ = any_ || !(friction == JointFriction());
    list_.push_back(friction);
  }
  /// Empty if no joint has friction.
  [[nodiscard]] std::span<const JointFriction> all() const { return any_ ? list_ : std::span<const JointFriction>(); }

 private:
  std::vector<JointFriction> list_;
  bool any_ = false;
};

/// Applies core/laws/dc_motor.h.
class MotorBank : public Actuator {
 public:
  [[nodiscard]] std::string_view command_unit() const override { return "V"; }
  [[nodiscard]] In command_limit() const override { return limit_; }
  [[nodiscard]] In reflected_inertia() const override { return inertia_; }
  void effort(In command, In speed, Out torque, Out slope) const override {
    motors::effort(motors_, command, speed, torque, slope);
  }
  void electrical(In command, In speed, Electrical out) const override { motors::electrical(motors_, command, speed, out); }
  void unlimited(In command, In speed, Out torque, Out slope) const override {
    motors::unlimited(motors_, command, speed, torque, slope);
  }
  [[nodiscard]] std::span<const DriveRatings> ratings() const override { return ratings_; }
  [[nodiscard]] std::span<const JointFriction> friction() const override { return friction_.all(); }
  [[nodiscard]] const DcMotor* dc_motors() const override { return motors_.data(); }

 protected:
  /// Adds the next motor, in the order joint * lanes + lane. `reflected_inertia` is the inertia of the rotor as seen at the
  /// joint, kg m^2.
  void add(const DcMotor& motor, double reflected_inertia, const DriveRatings& ratings, const JointFriction& friction);

 private:
  std::vector<DcMotor> motors_;
  std::vector<DriveRatings> ratings_;
  FrictionList friction_;
  std::vector<double> limit_, inertia_;
};

}  // namespace gaitlab
