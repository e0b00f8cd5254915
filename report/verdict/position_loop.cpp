#include "report/verdict/position_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/laws/dc_motor.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/buses.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/settings_numbers.h"

namespace gaitlab::report {

namespace {

constexpr double kOtherParts = 0.25;  // largest share of the proportional part that derivative and integral part have
constexpr double kSlow = 4;           // time constant, in samples, above which the derivative part does not make up for a delay

/// Number of a joint under this key, or `otherwise`.
double number(const SettingsNumbers& settings, const char* key, std::size_t joint, double otherwise) {
  const SettingsNumbers::Found* const found = settings.find(key);
  return found == nullptr ? otherwise : found->value[joint];
}

/// Angle of a joint as its encoder gives it.
struct Measured {
  double period = 0, resolution = 0, delay = 0, gain = 1;  // s, rad, s, 1
};

std::vector<Measured> measured(const Scenario& s) {
  std::vector<Measured> joints(s.robot->joints.size(), {s.control_period});
  const auto sensors = make_sensors(s);
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    const SettingsNumbers settings(s.sensors[k].plugin);
    const auto value = [&](const char* key, double otherwise) { return number(settings, key, 0, otherwise); };
    for (const SensorReading& reading : sensors[k]->readings()) {
      if (reading.replaces != Replaces::angle) continue;
      joints[reading.part] = {std::max(s.control_period, value("period", 0)), value("resolution", 0), value("delay", 0),
                              std::abs(value("gain", 1))};
    }
  }
  return joints;
}

}  // namespace

double PositionLoop::derivative() const {
  if (!(Kd > 0)) return 0;
  if (delay == 0) return 2 * Kd / (2 * Kd * sharp + period);
  return Kd * sharp > kSlow * period ? Kd / (Kd * sharp + period) : 0;
}
double PositionLoop::gain() const { return factor * (Kp + derivative()) * period / emf; }
double PositionLoop::settles() const { return 2 / (2 * delay / period + 1); }
double PositionLoop::share() const { return bounded ? gain() / settles() : 0; }
double PositionLoop::Kp_of(double share) const { return share * settles() * emf / (factor * period) - derivative(); }
double PositionLoop::period_of(double share) const {
  // (Kp + 2 Kd / (2 Kd sharp + T)) T = 2 share emf / factor, a quadratic equation in T.
  const double most = 2 * share * emf / factor;
  const double b = 2 * Kd * Kp * sharp + 2 * Kd - most;
  const double c = -2 * Kd * sharp * most;
  return (std::sqrt(b * b - 4 * Kp * c) - b) / (2 * Kp);
}

std::string PositionLoop::key_text(double gain) const {
  return fmt::format("{} {:.4g}{}{}", key, gain / per_key, *unit == '\0' || *unit == '/' ? "" : " ", unit);
}

std::vector<PositionLoop> position_loops(const Scenario& s) {
  std::vector<PositionLoop> loops;
  if (s.actuator.entry == nullptr || s.controller.entry == nullptr || s.robot->joints.empty()) return loops;
  const std::unique_ptr<Actuator> actuator = make_motors(s);
  const DcMotor* const motors = actuator->dc_motors();
  const std::unique_ptr<Controller> controller = make_controller(s.controller, plugin_info(s));
  const bool duty = controller->command_unit() == "duty";
  const std::vector<PositionGains> gains = controller->gains();
  if (motors == nullptr || gains.empty() || !(duty || controller->command_unit() == "V")) return loops;
  const std::vector<Measured> angles = measured(s);
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    const DcMotor& motor = motors[j];
    const Measured& angle = angles[j];
    const double volts = !duty ? 1 : supply_of(s, j).any() ? supply_of(s, j).voltage : motor.u_max;  // per unit of the command
    const double Kp = volts * gains[j].P;
    const double per_volt = motor.u_max > 0 ? motor.unlimited(motor.u_max, 0).torque / motor.u_max : 0;  // N m/V
    const double stall = motor(motor.u_max, 0).torque;
    if (!s.robot->joints[j].driven() || !(Kp * angle.gain > 0) || !(per_volt > 0) || !(stall > 0)) continue;
    PositionLoop& loop = loops.emplace_back();
    loop.joint = j;
    loop.Kp = Kp;
    loop.key = gains[j].key;
    loop.unit = gains[j].unit;
    loop.per_key = volts * gains[j].per_key;
    loop.Kd = volts * gains[j].D;
    loop.factor = angle.gain;
    loop.sharp = 1 / (volts * gains[j].N);
    loop.emf = motor.Ks * motor.gear;
    loop.tick = s.control_period * static_cast<double>(gains[j].every);
    loop.period = std::max(angle.period, loop.tick);
    loop.delay = angle.delay;
    loop.stiffness = angle.gain * Kp * per_volt;
    loop.stall = stall;
    loop.resolution = angle.resolution;
    loop.step = Kp * per_volt * angle.resolution;
    const double damping = loop.Kd > 0 ? loop.Kd / (loop.Kd * loop.sharp + loop.tick) : 0;
    const double integral = std::abs(volts * gains[j].I) * loop.tick;
    loop.bounded = loop.emf > 0 && std::max(damping, integral) <= kOtherParts * Kp;
  }
  return loops;
}

std::string commands_text(const PositionLoop& loop) {
  std::string text = fmt::format("commands every {:.4g} s", loop.tick);
  if (loop.period > loop.tick) text += fmt::format(", angles every {:.4g} s", loop.period);
  if (loop.delay > 0) text += fmt::format(", angles up to {:.4g} s old", loop.delay);
  return text;
}

std::string loop_text(const Scenario& s, const std::vector<PositionLoop>& loops) {
  const auto [soft, stiff] = std::ranges::minmax(loops, {}, &PositionLoop::stiffness);
  const PositionLoop& nearest = *std::ranges::max_element(loops, {}, &PositionLoop::share);
  const auto same = [&](PositionLoop loop) {
    loop.joint = nearest.joint;
    return loop == nearest;
  };
  const auto driven = static_cast<std::size_t>(std::ranges::count_if(s.robot->joints, &Joint::driven));
  const bool equal = loops.size() == driven && std::ranges::all_of(loops, same);
  std::string text =
      soft.stiffness == stiff.stiffness ? "" : fmt::format("k = {:.3g} to {:.3g} N m/rad; ", soft.stiffness, stiff.stiffness);
  text += fmt::format("k = {:.3g} N m/rad at {} ({})", nearest.stiffness,
                      equal ? "every joint" : s.robot->joints[nearest.joint].name, nearest.key_text(nearest.Kp));
  const double most = nearest.Kp_of(1);
  if (!nearest.bounded || !(most > 0)) return text;
  return fmt::format("{}; the loop settles up to {:.4g} N m/rad ({}) with {}", text, nearest.stiffness * most / nearest.Kp,
                     nearest.key_text(most), commands_text(nearest));
}

}  // namespace gaitlab::report
