// Plugins of every kind. In the function that their setting `where` selects, they throw an exception or end the process.
#include <cstdlib>
#include <stdexcept>

#include "core/plugin/plugin.h"

namespace {
using namespace gaitlab;

struct Settings {
  std::string where;
  void fields(Fields& f) {
    f.text("where", where, "Name of the function that throws.");
    at("fields");
  }
  void at(std::string_view function) const {
    if (where == function) throw std::invalid_argument("no luck");
    if (where == "int" && function == "output") throw 42;
    if (where == "abort" && function == "output") std::abort();
  }
};

struct ThrowingCpg final : Cpg {
  using Settings = ::Settings;
  ThrowingCpg(const RobotInfo&, const Settings& settings) : s(settings) { s.at("constructor"); }
  std::size_t states() const override { return 1; }
  void start(Out) const override {
    s.at("start");
    if (!judged) return;
    s.at("second start");
    ran = false;
    second = true;
  }
  void derivative(const Measured&, In, Out) const override { s.at("derivative"); }
  void event(const Measured&, Out) const override { s.at("event"); }
  void output(double t, In, Out setpoint) const override {
    for (double& each : setpoint) each = 0;
    if (t <= 0.1) return;
    s.at("output");
    ran = true;
  }
  [[nodiscard]] SetPointTimes times() const override {
    if (!ran) return {};
    s.at("times");
    if (second) s.at("second times");
    judged = true;
    return {};
  }
  std::string note() const override {
    s.at("note");
    return {};
  }
  Settings s;
  static inline bool ran = false;     // times() works when the scenario is read, and fails when the run is judged
  static inline bool judged = false;  // a start after the run was judged is that of a second run
  static inline bool second = false;
};

struct ThrowingController final : Controller {
  using Settings = ::Settings;
  ThrowingController(const RobotInfo&, const Settings& settings) : s(settings) { s.at("constructor"); }
  std::string_view command_unit() const override {
    s.at("command_unit");
    return "V";
  }
  void update(const Measured&, In, In, Out, Out) const override { s.at("update"); }
  Settings s;
};

struct ThrowingActuator final : Actuator {
  using Settings = ::Settings;
  ThrowingActuator(const RobotInfo& robot, const std::vector<const Settings*>& lanes)
      : limit(robot.joints.size() + (lanes[0]->where == "size" ? 1 : 0), 1.0), s(*lanes[0]) {
    s.at("constructor");
  }
  std::string_view command_unit() const override { return "V"; }
  In command_limit() const override { return limit; }
  void effort(In, In, Out, Out) const override { s.at("effort"); }
  void electrical(In, In, Electrical) const override { s.at("electrical"); }
  std::vector<double> limit;
  Settings s;
};
}  // namespace

GAITLAB_PLUGIN(registry) {
  add_cpg<ThrowingCpg>(registry, "throws", "");
  add_controller<ThrowingController>(registry, "throws", "");
  add_actuator<ThrowingActuator>(registry, "throws", "");
}
