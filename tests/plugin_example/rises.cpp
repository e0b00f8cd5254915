// Actuator plugin that violates the requirements: its torque increases with the speed of the joint, and jumps when the speed
// changes sign. An implicit step may then have many solutions, or none.
#include "core/plugin/plugin.h"

namespace {
using namespace gaitlab;

struct Rises final : Actuator {
  struct Settings {
    double rise = 0, dry = 0;
    void fields(Fields& f) {
      f.number("rise", rise, {"N m s/rad", -100, 100, "By which the torque rises with the speed."});
      f.number("dry", dry, {"N m", 0, 100, "Dry friction, against the speed."});
    }
  };
  Rises(const RobotInfo& robot, const std::vector<const Settings*>& lanes)
      : limit(robot.joints.size() * lanes.size(), 2.0), s(*lanes.front()) {}
  std::string_view command_unit() const override { return "N m"; }
  In command_limit() const override { return limit; }
  void effort(In command, In speed, Out torque, Out slope) const override {
    for (std::size_t i = 0; i < limit.size(); ++i) {
      const double whole = command[i] + s.rise * speed[i] - (speed[i] > 0 ? s.dry : speed[i] < 0 ? -s.dry : 0);
      torque[i] = whole > limit[i] ? limit[i] : whole < -limit[i] ? -limit[i] : whole;
      slope[i] = whole == torque[i] ? -s.rise : 0;
    }
  }
  void electrical(In command, In speed, Electrical out) const override {
    effort(command, speed, out.copper, out.gear);
    for (std::size_t i = 0; i < limit.size(); ++i) {
      out.power_in[i] = out.copper[i] * speed[i];
      out.voltage[i] = out.current[i] = out.copper[i] = out.gear[i] = out.saturation[i] = 0;
    }
  }
  std::vector<double> limit;
  Settings s;
};
}  // namespace

GAITLAB_PLUGIN(registry) { add_actuator<Rises>(registry, "rises", "T = command + rise w - dry sign(w), within +-2 N m"); }
