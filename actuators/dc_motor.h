// Actuator `dc_motor`: core/laws/dc_motor.h for every joint and lane.
#pragma once
#include "core/laws/dc_motor.h"
#include "core/plugin/registry.h"

namespace gaitlab::actuators {

class DcMotorActuator final : public Actuator {
 public:
  enum class EfficiencyModel { paper, directional };
  struct Settings {
    PerJoint R{4.3}, Kt{0.00395}, Ks{0.00395}, gear{594}, efficiency{0.7}, u_max{7.4}, i_max{1.2}, rotor_inertia{0};
    EfficiencyModel efficiency_model = EfficiencyModel::paper;
    double turn_speed = 0.6;
    PerJoint i_continuous, gear_torque_peak, gear_torque_continuous, speed_max;  ///< 0: not stated
    void fields(Fields& f);
  };
  static const char* const kManual;

  DcMotorActuator(const RobotInfo& robot, const std::vector<const Settings*>& lanes);
  [[nodiscard]] std::string_view command_unit() const override { return "V"; }
  [[nodiscard]] In command_limit() const override { return limit_; }
  [[nodiscard]] In reflected_inertia() const override { return inertia_; }
  void effort(In command, In speed, Out torque, Out slope) const override;
  void electrical(In command, In speed, Electrical out) const override;
  void unlimited(In command, In speed, Out torque, Out slope) const override;
  [[nodiscard]] std::span<const DriveRatings> ratings() const override { return ratings_; }
  [[nodiscard]] const DcMotor* dc_motors() const override { return motors_.data(); }

 private:
  std::vector<DcMotor> motors_;
  std::vector<DriveRatings> ratings_;
  std::vector<double> limit_, inertia_;
};

}  // namespace gaitlab::actuators
