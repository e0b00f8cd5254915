#include "interchange/mjcf_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dynamics/mobility.h"
#include "core/errors.h"
#include "core/laws/dc_motor.h"
#include "core/plugin/actuator.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/buses.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/wording.h"
#include "core/simulation/start.h"

namespace gaitlab::interchange {

namespace {

// Least impedance d, and greatest ratio of the slopes of friction and damping (chosen): with d = 0.05 the mass at a contact is
// a twentieth of the inertia there, and MuJoCo's solver converges within its tolerance.
constexpr double kLeastImpedance = 0.05;
constexpr double kMostImpratio = 100;
constexpr double kUsualGravity = 9.81;  // m/s^2, for the standing depth if gravity does not press the robot on the ground
constexpr int kHalvings = 60;           // halvings from the first bracket to the rounding of a double

/// Total force of the springs of the contact elements if the robot sinks by `sunk` from its start on the ground, and the mean
/// depth of the elements that touch.
struct Press {
  double force = 0, depth = 0;
};
Press press(const Scenario& s, const std::vector<ContactElement>& elements, const Kinematics& k, double sunk) {
  Press sum;
  int touching = 0;
  for (const ContactElement& e : elements) {
    const Vec3 centre = k.point(e.link, e.centre) - sunk * Vec3::UnitZ();
    const double p = s.ground.query(centre, e.radius).penetration;
    if (!(p > 0)) continue;
    sum.force += s.contact.penalty.spring(p);
    sum.depth += p;
    ++touching;
  }
  if (touching > 0) sum.depth /= touching;
  return sum;
}

double standing_depth(const Scenario& s) {
  const std::vector<ContactElement> elements = contact_elements(*s.robot, s.contact.on);
  if (elements.empty() || !s.ground.exists()) return 0;
  Kinematics k(*s.robot);
  k.place(*s.robot, lowered_start(s));
  const double g = s.physics.gravity.z() < 0 ? -s.physics.gravity.z() : kUsualGravity;
  const double weight = s.robot->mass * g;
  double lo = 0;
  double hi = 1e-6;
  while (press(s, elements, k, hi).force < weight && hi < 1) hi *= 2;
  if (press(s, elements, k, hi).force < weight) {
    throw InputError(s.place("contact.stiffness"),
                     fmt::format("{} N/m is too soft to carry the robot of {:.3g} N; expected stiffer contacts, or --strict",
                                 number_text(s.contact.penalty.kn), weight));
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = lo + (hi - lo) / 2;
    (press(s, elements, k, middle).force < weight ? lo : hi) = middle;
  }
  return press(s, elements, k, hi).depth;
}

}  // namespace

InverseWeights inverse_weights(const Scenario& s, const std::vector<MotorLimits>& limits) {
  const Robot& robot = *s.robot;
  RobotState zero = start_state(s);
  zero.q.assign(robot.joints.size(), 0.0);
  zero.qd.assign(robot.joints.size(), 0.0);
  Kinematics k(robot);
  k.update(robot, zero);
  std::vector<double> armature(robot.joints.size(), 0.0);
  for (std::size_t j = 0; j < limits.size(); ++j) armature[j] = limits[j].armature;
  Mobility all = mobility(robot, s.base, k, armature);
  InverseWeights out{.joints = std::move(all.joints)};
  for (const Body& body : robot.bodies) {
    out.bodies.push_back(all.at(body.link, k.point(body.link, body.in_link * body.com), k));
  }
  return out;
}

ContactLine contact_line(const Scenario& s) {
  const PenaltyContact& law = s.contact.penalty;
  ContactLine line;
  line.depth = standing_depth(s);
  if (!(line.depth > 0)) return line;
  const double force = law.spring(line.depth);
  line.stiffness = law.stiffness(line.depth);
  line.onset = line.depth - force / line.stiffness;
  const double friction_slope = s.ground.friction * force / law.v_lim;
  line.damping = std::max(law.damping(line.depth), friction_slope / kMostImpratio);
  if (friction_slope > 0) line.impratio = friction_slope / line.damping;
  return line;
}

DirectReference direct_reference(double stiffness, double damping, double mobility, double step) {
  const double mass_of_step = step * damping * mobility;  // m' of a semi-implicit step, times A_0
  const double d = std::max(kLeastImpedance, mass_of_step / (1 + mass_of_step));
  return {(1 - d) * mobility * stiffness, (1 - d) * mobility * damping, d};
}

Drives drives(const Scenario& s) {
  const std::unique_ptr<Actuator> actuator = make_motors(s);
  if (actuator == nullptr) return {};
  const std::size_t joints = s.robot->joints.size();
  // The law is evaluated at rest and far below its limits. A power of two keeps the slope free of rounding.
  constexpr double kSmall = 1.0 / 1024;
  const std::vector<double> command(joints, kSmall);
  const std::vector<double> rest(joints, 0.0);
  std::vector<double> torque(joints);
  std::vector<double> slope(joints);
  actuator->effort(command, rest, torque, slope);
  const DcMotor* const motors = actuator->dc_motors();
  for (std::size_t j = 0; motors != nullptr && j < joints; ++j) {  // with the gear's loss while the motor drives
    if (!s.robot->joints[j].driven() || !(motors[j].load < 1)) continue;
    torque[j] *= motors[j].load;
    slope[j] = motors[j].efficiency * motors[j].load * motors[j].back_emf_damping;
  }
  Drives out;
  out.command_unit = actuator->command_unit();
  const std::unique_ptr<Controller> controller = make_controller(s.controller, plugin_info(s));
  const std::vector<PositionGains> gains = controller == nullptr ? std::vector<PositionGains>() : controller->gains();
  const bool duty = controller != nullptr && controller->command_unit() == "duty";
  out.by_set_points = !gains.empty();
  out.duty = duty;
  for (std::size_t j = 0; j < joints; ++j) {
    const double c = torque[j] / kSmall;
    if (!out.by_set_points) {
      out.joints.push_back({c, 0, slope[j]});
      continue;
    }
    const double volts = duty ? (supply_of(s, j).any() ? supply_of(s, j).voltage : actuator->command_limit()[j]) : 1;
    const double stiffness = c * volts * gains[j].P;
    out.joints.push_back({stiffness, stiffness, c * volts * gains[j].D + slope[j]});
    out.integral = out.integral || gains[j].I != 0;
    out.derivative = out.derivative || gains[j].D != 0;
  }
  return out;
}

}  // namespace gaitlab::interchange
