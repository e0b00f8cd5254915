#include "report/verdict/position_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/laws/dc_motor.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/settings_numbers.h"

namespace gaitlab::report {

namespace {

constexpr double kDamps = 0.25;  // least share of the proportional part at which the derivative part changes the bound

/// Response of the derivative part to a step of the error, Kd N / (Kd + N Ts) (eq. 5), V/rad.
double derivative(const SettingsNumbers& settings, std::size_t joint, double period) {
  const SettingsNumbers::Found* Kd = settings.find("Kd");
  const SettingsNumbers::Found* N = settings.find("N");
  if (Kd == nullptr || !(Kd->value[joint] > 0)) return 0;
  const double d = Kd->value[joint];
  return N == nullptr ? d / period : d * N->value[joint] / (d + N->value[joint] * period);
}

/// Angle of a joint as its encoder gives it.
struct Measured {
  double period = 0, resolution = 0, delay = 0;  // s, rad, s
};

std::vector<Measured> measured(const Scenario& s) {
  std::vector<Measured> joints(s.robot->joints.size(), {s.control_period});
  const auto sensors = make_sensors(s);
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    const SettingsNumbers settings(s.sensors[k].plugin);
    const auto value = [&](const char* key) {
      const SettingsNumbers::Found* const found = settings.find(key);
      return found == nullptr ? 0.0 : found->value[0];
    };
    for (const SensorReading& reading : sensors[k]->readings()) {
      if (reading.replaces != Replaces::angle) continue;
      joints[reading.part] = {std::max(s.control_period, value("period")), value("resolution"), value("delay")};
    }
  }
  return joints;
}

}  // namespace

std::vector<PositionLoop> position_loops(const Scenario& s) {
  std::vector<PositionLoop> loops;
  if (s.actuator.entry == nullptr || s.controller.entry == nullptr || s.robot->joints.empty()) return loops;
  const std::unique_ptr<Actuator> actuator = make_motors(s);
  const DcMotor* const motors = actuator->dc_motors();
  const SettingsNumbers settings(s.controller);
  const SettingsNumbers::Found* const gain = settings.find("Kp");
  if (motors == nullptr || gain == nullptr || make_controller(s.controller, plugin_info(s))->command_unit() != "V")
    return loops;
  const std::vector<Measured> angles = measured(s);
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    const DcMotor& motor = motors[j];
    const double Kp = gain->value[j];
    if (!s.robot->joints[j].driven() || !(Kp > 0) || !(motor.u_max > 0)) continue;
    const Measured& angle = angles[j];
    const double samples = std::ceil(angle.delay / angle.period);
    PositionLoop& loop = loops.emplace_back(PositionLoop{j, Kp});
    loop.stiffness = Kp * motor.unlimited(motor.u_max, 0).torque / motor.u_max;
    loop.stall = motor(motor.u_max, 0).torque;
    loop.resolution = angle.resolution;
    loop.period = angle.period;
    loop.delay = angle.delay;
    const bool bound = motor.Ks > 0 && derivative(settings, j, s.control_period) <= kDamps * Kp;
    loop.gain = motor.Ks > 0 ? Kp * angle.period / (motor.Ks * motor.gear) : 0;
    if (!bound) loop.settles = loop.never_settles = std::numeric_limits<double>::infinity();
    if (!bound || !(samples > 0)) continue;
    loop.settles = 2 / (2 * samples + 1);
    loop.never_settles = 2 * std::sin(std::numbers::pi / (2 * (2 * samples + 1)));
  }
  return loops;
}

std::string commands_text(const Scenario& s, const PositionLoop& loop) {
  std::string text = fmt::format("commands every {:.4g} s", s.control_period);
  if (loop.period > s.control_period) text += fmt::format(", angles every {:.4g} s", loop.period);
  if (loop.delay > 0) text += fmt::format(", angles that are {:.4g} s old", loop.delay);
  return text;
}

std::string loop_text(const Scenario& s, const std::vector<PositionLoop>& loops) {
  const auto [soft, stiff] = std::ranges::minmax(loops, {}, &PositionLoop::stiffness);
  const PositionLoop& nearest = *std::ranges::max_element(loops, {}, &PositionLoop::share);
  const bool equal = soft.stiffness == stiff.stiffness;
  const std::string own = fmt::format("k = {:.3g} N m/rad", nearest.stiffness);
  std::string text =
      fmt::format("{} at {} (Kp {:.4g} V/rad)", own, equal ? "every joint" : s.robot->joints[nearest.joint].name, nearest.Kp);
  if (!equal) text = fmt::format("k = {:.3g} to {:.3g} N m/rad; {}", soft.stiffness, stiff.stiffness, text);
  if (!std::isfinite(nearest.settles)) return text;
  return fmt::format("{}; settles up to {:.4g} N m/rad (Kp {:.4g} V/rad) with {}", text, nearest.stiffness / nearest.share(),
                     nearest.Kp / nearest.share(), commands_text(s, nearest));
}

}  // namespace gaitlab::report
