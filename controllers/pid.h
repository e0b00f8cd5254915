// Controller `pid`, the sampled PID of the paper with a filtered derivative.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::controllers {

class Pid final : public Controller {
 public:
  enum class Unit { volt, newton_metre };  ///< unit of the command
  struct Settings {
    PerJoint Kp{100}, Ki{0}, Kd{0.6}, N{10};
    bool anti_windup = true;
    Unit unit = Unit::volt;
    void fields(Fields& f);
  };
  static const char* const kManual;

  Pid(const RobotInfo& robot, Settings settings) : joints_(robot.joints.size()), s_(std::move(settings)) {}
  [[nodiscard]] std::string_view command_unit() const override { return s_.unit == Unit::volt ? "V" : "N m"; }
  /// Number of states: a flag that the first tick sets, then I, D, e and u of the last tick for every joint.
  [[nodiscard]] std::size_t states() const override { return 1 + 4 * joints_; }
  void start(Out x) const override;
  [[nodiscard]] std::vector<PositionGains> gains() const override;
  void update(const Measured& measured, In setpoint, In command_limit, Out x, Out command) const override;

 private:
  std::size_t joints_;
  Settings s_;
};

}  // namespace gaitlab::controllers
