#include "interchange/robot_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/laws/dc_motor.h"
#include "core/laws/hinge_stop.h"
#include "core/plugin/actuator.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

template <class Numbers>
std::string joined_numbers(const Numbers& numbers) {
  std::string out;
  for (const double x : numbers) out += (out.empty() ? "" : " ") + number_text(x + 0.0);  // adding 0 turns -0 into 0
  return out;
}

/// No-load speed of each joint, at which the torque under `command` becomes zero, rad/s; 0 if the torque never becomes zero.
/// One bisection finds all speeds, because the actuator computes all joints at once.
std::vector<double> no_load_speeds(const Actuator& actuator, const std::vector<double>& command) {
  constexpr double kFastest = 1e6;  // rad/s; no joint turns faster
  constexpr int kMostHalvings = 200;
  const std::size_t joints = command.size();
  std::vector<double> lo(joints, 0.0);
  std::vector<double> hi(joints, kFastest);
  std::vector<double> middle(hi);
  std::vector<double> torque(joints);
  std::vector<double> slope(joints);
  actuator.effort(command, hi, torque, slope);
  for (std::size_t j = 0; j < joints; ++j) {
    if (torque[j] > 0) hi[j] = 0;
  }
  bool between = joints > 0;  // true as long as a double is between the bounds of any joint
  for (int i = 0; i < kMostHalvings && between; ++i) {
    between = false;
    for (std::size_t j = 0; j < joints; ++j) {
      middle[j] = lo[j] + (hi[j] - lo[j]) / 2;
      between = between || (middle[j] > lo[j] && middle[j] < hi[j]);
    }
    actuator.effort(command, middle, torque, slope);
    for (std::size_t j = 0; j < joints; ++j) {
      if (middle[j] > lo[j] && middle[j] < hi[j]) (torque[j] > 0 ? lo : hi)[j] = middle[j];
    }
  }
  return hi;
}

/// Largest command of each motor: its own limit, and what controller and supply let through.
std::vector<double> largest_commands(const Scenario& scenario, const Actuator& actuator) {
  std::vector<double> command(actuator.command_limit().begin(), actuator.command_limit().end());
  const std::unique_ptr<Controller> controller = make_controller(scenario.controller, plugin_info(scenario));
  const bool duty = controller != nullptr && controller->command_unit() == "duty";
  const std::vector<PositionGains> gains = duty ? controller->gains() : std::vector<PositionGains>();
  for (std::size_t j = 0; j < command.size(); ++j) {
    const double bus = scenario.supply.any() ? scenario.supply.voltage : command[j];
    command[j] = std::min(command[j], gains.empty() ? bus : std::min(1.0, gains[j].most) * bus);
  }
  return command;
}

}  // namespace

std::string text(std::initializer_list<double> numbers) { return joined_numbers(numbers); }
std::string text(const std::vector<double>& numbers) { return joined_numbers(numbers); }

Mat3 y_from_z() {
  Mat3 R;
  R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return R;
}

std::vector<MotorLimits> motor_limits(const Scenario& scenario) {
  const std::unique_ptr<Actuator> actuator = make_motors(scenario);
  if (actuator == nullptr) return {};
  const std::size_t joints = scenario.robot->joints.size();
  const std::vector<double> command = largest_commands(scenario, *actuator);
  const std::vector<double> rest(joints, 0.0);
  std::vector<double> torque(joints);
  std::vector<double> slope(joints);
  actuator->effort(command, rest, torque, slope);
  const DcMotor* const motors = actuator->dc_motors();
  for (std::size_t j = 0; motors != nullptr && j < joints; ++j) {  // what a motor gives while it drives
    if (scenario.robot->joints[j].driven() && motors[j].load < 1) torque[j] = motors[j].load * torque[j];
  }
  const In rotors = actuator->reflected_inertia();
  const std::span<const JointFriction> friction = actuator->friction();
  const std::vector<double> fastest = no_load_speeds(*actuator, command);
  std::vector<MotorLimits> limits(joints);
  for (std::size_t j = 0; j < joints; ++j)
    limits[j] = {torque[j], fastest[j], rotors.empty() ? 0 : rotors[j], friction.empty() ? JointFriction() : friction[j]};
  return limits;
}

std::string left_out(const Scenario& s) {
  std::string out;
  if (s.ground.exists() && s.contact.on != ContactSet::none) {
    out += !s.contact.model().penalty_settings
               ? fmt::format(" Contact: Bullet's own solver, friction {}, on the contact elements.",
                             number_text(s.ground.friction))
               : fmt::format(
                     " Contact: a penalty force Fn = Kn p^k + Cd p^d p', Kn = {}, k = {}, Cd = {}, d = {}, and friction {} Fn "
                     "with its "
                     "slope up to "
                     "{} m/s, on the contact elements.",
                     number_text(s.contact.penalty.kn), number_text(s.contact.penalty.k), number_text(s.contact.penalty.cd),
                     number_text(s.contact.penalty.d), number_text(s.ground.friction), number_text(s.contact.penalty.v_lim));
  }
  if (std::ranges::any_of(s.robot->modules, [](const Module& module) { return module.build.friction != 1; }))
    out += " Friction of each module times as_built.foot_friction.";
  const auto name = [](const PluginSelection& choice) {
    return choice.entry == nullptr ? "none" : std::string(choice.entry->name);
  };
  if (s.actuator.entry != nullptr) {
    out += fmt::format(" Drive: actuator {} behind controller {}, sampled every {} s.", name(s.actuator), name(s.controller),
                       number_text(s.control_period));
  }
  if (s.cpg.entry != nullptr) out += fmt::format(" Gait: cpg {}.", name(s.cpg));
  if (!s.sensors.empty()) out += " Sensors: errors and delays, currents, loads and tilt; in URDF, all sensors.";
  for (const std::size_t j : joints_with_play(*s.robot))
    out += fmt::format(" Play of the gear of {}: {} rad.", s.robot->joints[j].name, number_text(s.robot->joints[j].play.width));
  return out + fmt::format(" Hinge stops: a spring of {} N m/rad and a damper of {} N m s/rad outside the range.",
                           number_text(HingeStop::kStiffness), number_text(HingeStop::kDamping));
}

}  // namespace gaitlab::interchange
