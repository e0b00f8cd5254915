// Actuator `torque`: an ideal torque source.
#pragma once
#include <algorithm>
#include <limits>

#include "actuators/friction_keys.h"
#include "core/laws/motor_bank.h"
#include "core/plugin/registry.h"

namespace gaitlab::actuators {

class TorqueActuator final : public Actuator {
 public:
  struct Settings : FrictionKeys {
    PerJoint limit{0};
    void fields(Fields& f) {
      f.limit("limit", limit, {"N m", 0, 1e9, "Commands are limited to +- this torque; 0: no limit."});
      FrictionKeys::fields(f);
    }
  };
  static constexpr const char* kManual = R"(An ideal torque source. It draws the power T w.

    T = command, cut to +- limit, less the friction of the joint

Source: none; the limit of a motor without resistance. Takes commands in N m; its columns voltage and current are 0, voltage_command holds the command in N m.

    actuator: {type: torque, limit: 1.9}
    controller: {type: pid, unit: N m, Kp: 5, Kd: 0.05})";

  TorqueActuator(const RobotInfo& robot, const std::vector<const Settings*>& lanes) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      for (const Settings* s : lanes) {
        limit_.push_back(s->limit[j] > 0 ? s->limit[j] : std::numeric_limits<double>::infinity());
        friction_.add(s->friction_of(j));
      }
    }
  }
  [[nodiscard]] std::string_view command_unit() const override { return "N m"; }
  [[nodiscard]] In command_limit() const override { return limit_; }
  [[nodiscard]] std::span<const JointFriction> friction() const override { return friction_.all(); }

  void effort(In command, In, Out torque, Out slope) const override {
    for (std::size_t i = 0; i < limit_.size(); ++i) {
      torque[i] = std::clamp(command[i], -limit_[i], limit_[i]);
      slope[i] = 0;
    }
  }

  void electrical(In command, In speed, Electrical out) const override {
    for (std::size_t i = 0; i < limit_.size(); ++i) {
      const double torque = std::clamp(command[i], -limit_[i], limit_[i]);
      out.voltage[i] = out.current[i] = out.copper[i] = out.gear[i] = 0;
      out.saturation[i] = torque != command[i] ? 2 : 0;
      out.power_in[i] = torque * speed[i];
    }
  }

 private:
  std::vector<double> limit_;
  FrictionList friction_;
};

}  // namespace gaitlab::actuators
