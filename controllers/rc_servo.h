// Controller `rc_servo`, the firmware of hobby servos and smart servos.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::controllers {

/// Unit of the proportional gain `P` of a maker's firmware.
enum class FirmwareUnit { dynamixel_x, dynamixel_1, feetech_sts };

class RcServo final : public Controller {
 public:
  struct Settings {
    PerJoint gain{kNotStated}, P;  ///< duty/rad; in `unit`, 0 if not stated
    FirmwareUnit unit = FirmwareUnit::dynamixel_x;
    PerJoint I, D;                             ///< duty/(rad s), duty s/rad
    PerJoint speed_limit, acceleration_limit;  ///< rad/s, rad/s^2; 0 for none
    PerJoint latency, dead_band, punch;        ///< s, rad, duty
    PerJoint limit{1};                         ///< duty
    std::int64_t every = 1;                    ///< control periods
    void fields(Fields& f);
    [[nodiscard]] double proportional(std::size_t joint) const;  ///< duty/rad
    [[nodiscard]] double gain_of_P(std::size_t joint) const;     ///< duty/rad
  };
  static const char* const kManual;

  RcServo(const RobotInfo& robot, Settings settings);
  [[nodiscard]] std::string_view command_unit() const override { return "duty"; }
  /// Number of states: the count of ticks, then for every joint a Joint and its goals on the way.
  [[nodiscard]] std::size_t states() const override { return 1 + joints_ * (kJointStates + on_way_); }
  void start(Out x) const override;
  [[nodiscard]] std::string note() const override;
  [[nodiscard]] std::vector<PositionGains> gains() const override;
  void update(const Measured& measured, In setpoint, In command_limit, Out x, Out command) const override;

 private:
  /// State of a joint.
  struct Joint {
    double goal = 0, speed = 0;                     ///< of the profile: rad, rad/s
    double integral = 0, last_error = 0, duty = 0;  ///< duty, rad, duty
  };
  static constexpr std::size_t kJointStates = 5;
  void follow(std::size_t joint, double goal, double period, Joint& x) const;
  void command(std::size_t joint, double error, double period, bool first, Joint& x) const;

  std::size_t joints_;
  std::string rounded_;  ///< note on the latency that the control period changes most
  Settings s_;
  std::vector<std::size_t> delay_;  ///< by joint: control periods from a set point until it acts
  std::size_t on_way_ = 0;          ///< goals that are kept for every joint, so that a joint's latency can change in a run
};

}  // namespace gaitlab::controllers
