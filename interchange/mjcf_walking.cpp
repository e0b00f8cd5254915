#include "interchange/mjcf_walking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/laws/hinge_stop.h"
#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

// m, radius of the sphere that represents a point. If the body tilts by an angle a from the start, the bottom of the sphere is
// (1 - cos a) radii below the point: 8 um at 0.4 rad.
constexpr double kTouchRadius = 1e-4;
// m, the same on a ground with boxes. MuJoCo 2.2 takes the radius for the depth of a sphere whose centre is inside a box (3.12
// does not), so that the radius must be greater than the penetration, which is 0.6 mm for a walking hexapod.
constexpr double kTouchRadiusOnBoxes = 1e-3;

}  // namespace

MjcfWalking::MjcfWalking(const Scenario& s, const RobotState& start, const std::vector<MotorLimits>& limits, double step)
    : s_(s),
      limits_(limits),
      step_(step),
      angles_(start.q),
      at_start_(*s.robot),
      weights_(inverse_weights(s, limits)),
      drives_(drives(s)) {
  at_start_.place(*s.robot, start);
  if (penalty()) line_ = contact_line(s);
}

double MjcfWalking::touch_radius() const { return s_.ground.boxes().empty() ? kTouchRadius : kTouchRadiusOnBoxes; }

void MjcfWalking::write_direct(Xml& element, const char* reference, const char* impedance, const DirectReference& r) const {
  set(element, reference, text({-r.stiffness, -r.damping}));
  set(element, impedance, text({r.impedance, r.impedance, 1e-3}));  // the width has no effect on a constant impedance
}

void MjcfWalking::write_options(Xml& option) const {
  set(option, "integrator", "implicit");
  set(option, "cone", "elliptic");
  if (penalty()) set(option, "impratio", text({line_.impratio}));
}

void MjcfWalking::write_ground(Xml& geom, double friction) const {
  if (!touches()) return;
  set(geom, "conaffinity", "1");
  set(geom, "friction", text({friction, 0, 0}));
  set(geom, "solmix", "0");  // the contact has the parameters of the other geom
}

void MjcfWalking::write_element(Xml& geom, const ContactElement& e) const {
  if (!touches()) return;
  const Body& body = s_.robot->bodies[e.body];
  Vec3 centre = e.centre;
  double radius = e.radius - line_.onset;
  if (e.radius > 0 && !(radius > 0)) {
    throw InputError(s_.place("contact.stiffness"),
                     fmt::format("spheres of {} m sink {:.3g} m into the ground under the robot's weight, too deep for MJCF; "
                                 "expected stiffer contacts, or --strict",
                                 number_text(e.radius), line_.depth));
  }
  if (!(e.radius > 0)) {
    radius = touch_radius();
    centre += at_start_.R[e.link].transpose() * Vec3(0, 0, touch_radius() + line_.onset);
  }
  set(geom, "size", text({radius}));
  set(geom, "pos", text(Vec3(body.in_link.inverse() * centre)));
  set(geom, "contype", "1");
  // MuJoCo uses the larger friction of two geoms of equal priority, which is the ground's.
  set(geom, "friction", text({e.friction == 1 ? 0 : e.friction * s_.ground.friction, 0, 0}));
  if (e.friction != 1) set(geom, "priority", "1");
  const double A = weights_.bodies[e.body];
  if (line_.stiffness > 0 && A > 0) {
    write_direct(geom, "solref", "solimp", direct_reference(line_.stiffness, line_.damping, A, step_));
  }
}

void MjcfWalking::write_hinge(Xml& joint, std::size_t j) const {
  const double A = weights_.joints[j];
  if (s_.robot->joints[j].turns_freely() || !(A > 0)) return;
  write_direct(joint, "solreflimit", "solimplimit", direct_reference(HingeStop::kStiffness, HingeStop::kDamping, A, step_));
}

void MjcfWalking::write_motors(Xml& root) const {
  if (drives_.joints.empty()) return;
  Xml& actuator = add(root, "actuator");
  for (std::size_t j = 0; j < drives_.joints.size(); ++j) {
    const Joint& joint = s_.robot->joints[j];
    if (!joint.driven()) continue;
    const GainAndBias& drive = drives_.joints[j];
    Xml& e = add(actuator, "general");
    set(e, "name", joint.name);
    set(e, "joint", joint.name);
    set(e, "gainprm", text({drive.gain}));
    set(e, "biastype", "affine");
    set(e, "biasprm", text({0, -drive.stiffness, -drive.damping}));
    const bool limited = std::isfinite(limits_[j].effort);
    set(e, "forcelimited", limited ? "true" : "false");
    if (limited) set(e, "forcerange", text({-limits_[j].effort, limits_[j].effort}));
  }
}

void MjcfWalking::write_controls(Xml& key) const {
  if (drives_.joints.empty()) return;
  std::vector<double> controls;
  for (std::size_t j = 0; j < drives_.joints.size(); ++j) {
    if (s_.robot->joints[j].driven()) controls.push_back(drives_.by_set_points ? angles_[j] : 0.0);
  }
  if (!controls.empty()) set(key, "ctrl", text(controls));
}

std::string MjcfWalking::contact_comment() const {
  if (!touches()) return " Nothing touches anything.";
  std::string out =
      " Only the contact elements, geoms of group 3 with a site each, touch the ground; no other geoms touch "
      "anything.";
  if (std::ranges::any_of(s_.ground.boxes(), [](const Box& box) { return box.mass > 0; })) {
    out += " Boxes with a mass are fixed here.";
  }
  if (!penalty()) {
    return out + " The contact law is MuJoCo's with its default parameters, in place of Bullet's solver.";
  }
  out += fmt::format(
      " Points are spheres of {} m whose bottom is the point. Contact: Fn = K (p - p1) + C p' with K = {:.6g} N/m, C = {:.6g} "
      "N s/m, p1 = {:.6g} m, the line through the law Fn = Kn p^k + Cd p^d p' (Kn = {}, k = {}, Cd = {}, d = {}) at the depth "
      "{:.6g} m of the standing robot, and friction {} Fn with the slope {:.6g} N s/m, that of the law at this depth. solref "
      "is -(1 - d) A K, -(1 - d) A C with d of solimp and A MuJoCo's body_invweight0; d / ((1 - d) A) is a mass at the contact "
      "that the law does not have.",
      number_text(touch_radius()), line_.stiffness, line_.damping, line_.onset, number_text(s_.contact.penalty.kn),
      number_text(s_.contact.penalty.k), number_text(s_.contact.penalty.cd), number_text(s_.contact.penalty.d), line_.depth,
      number_text(s_.ground.friction), line_.impratio * line_.damping);
  const bool boxes_differ =
      std::ranges::any_of(s_.ground.boxes(), [&](const Box& box) { return box.friction != s_.ground.friction; });
  const bool feet_differ = std::ranges::any_of(s_.robot->modules, [](const Module& m) { return m.build.friction != 1; });
  if (boxes_differ && feet_differ) out += " On boxes, modules with as_built.foot_friction also have the plane's friction.";
  return out;
}

std::string MjcfWalking::motor_comment() const {
  if (drives_.joints.empty()) return "";
  const auto name = [](const PluginSelection& choice) {
    return choice.entry == nullptr ? "none" : std::string(choice.entry->name);
  };
  if (!drives_.by_set_points) {
    return fmt::format(
        " Controls are the commands of actuator {}, {}. Its motors follow their law, linearised about rest, within their "
        "torque "
        "limit. Controller {} is not in this file.",
        name(s_.actuator), drives_.command_unit, name(s_.controller));
  }
  std::string out = fmt::format(
      " Controls are set points, rad (columns setpoint of the trace). Torque = c Kp (ctrl - q) - (c Kd + B) w: controller {} "
      "and "
      "the law T = c u - B w of actuator {}, linearised about rest, within its torque at rest under the largest command. Not "
      "in this file: "
      "the control period of {} s",
      name(s_.controller), name(s_.actuator), number_text(s_.control_period));
  if (drives_.derivative) out += ", the filter of D, and D of the set point";
  if (drives_.integral) out += ", the integral part";
  if (drives_.duty) out += ", dead band, punch, latency, profile and sampling of the servo, and the resistance of the supply";
  return out + ", the command limit, and whatever else makes the actuator's law nonlinear.";
}

std::string MjcfWalking::comment() const {
  std::string out = contact_comment() + motor_comment();
  if (s_.cpg.entry != nullptr) out += fmt::format(" Gait: cpg {}, which is not in this file.", s_.cpg.entry->name);
  if (!s_.sensors.empty()) out += " Sensors have no errors or delays; currents, loads and tilt are left out.";
  return out;
}

}  // namespace gaitlab::interchange
