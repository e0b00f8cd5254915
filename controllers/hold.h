// Controller `hold`, which gives a constant command in the actuator's unit.
#pragma once
#include "core/plugin/registry.h"

namespace gaitlab::controllers {

class Hold final : public Controller {
 public:
  struct Settings {
    PerJoint command{0};
    void fields(Fields& f) {
      f.per_joint("command", command, {"V or N m", -1e9, 1e9, "Constant command, in the actuator's unit."});
    }
  };
  static constexpr const char* kManual =
      R"(Open loop: the command is constant, whatever the set point. Takes the actuator's unit.

    u = command

Source: none; for tests of motors and for joints that stay free.

    controller: {type: hold, command: {default: 0, m1/passive: 3}})";

  Hold(const RobotInfo& robot, Settings settings) : joints_(robot.joints.size()), s_(std::move(settings)) {}
  [[nodiscard]] std::string_view command_unit() const override { return ""; }
  void update(const Measured&, In, In, Out, Out command) const override {
    for (std::size_t j = 0; j < joints_; ++j) command[j] = s_.command[j];
  }

 private:
  std::size_t joints_;
  Settings s_;
};

}  // namespace gaitlab::controllers
