#include "interchange/urdf_motor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

constexpr double kMostEffort = 1e5;  // N m, below which an effort is that of a motor
constexpr double kMostSpeed = 1000;  // rad/s, of a motor behind its gear
constexpr double kChosenSpeed = 20;  // rad/s
constexpr double kChosenShare = 2;   // of the weight that the motor holds
constexpr double kStandard = 9.81;   // m/s^2

/// Load of a hinge: mass of all that it moves, and the longest distance from its origin to a centre of mass, or radius of
/// gyration.
struct Carried {
  double mass = 0, lever = 0;
};

std::vector<Carried> carried_by_body(const std::vector<BodyType>& bodies, const std::vector<UrdfHinge>& hinges) {
  std::vector<Carried> carried;
  for (const BodyType& body : bodies) {
    const double gyration = body.mass > 0 ? std::sqrt(std::max(body.inertia.diagonal().maxCoeff(), 0.0) / body.mass) : 0;
    carried.push_back({body.mass, body.mass > 0 ? std::max(body.com.norm(), gyration) : 0});
  }
  std::vector<const HingeType*> inwards;
  for (const UrdfHinge& one : hinges) inwards.push_back(&one.hinge);
  std::ranges::sort(inwards, [](const HingeType* a, const HingeType* b) { return a->child > b->child; });
  for (const HingeType* const hinge : inwards) {
    const Carried& child = carried[hinge->child];
    Carried& parent = carried[hinge->parent];
    parent.mass += child.mass;
    parent.lever = std::max(parent.lever, hinge->in_parent.p.norm() + child.lever);
  }
  return carried;
}

double three_digits(double value) { return std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr); }

}  // namespace

void read_motor(const urdf::Joint& joint, const UrdfText& urdf, UrdfHinge& hinge, Problems& problems) {
  const urdf::JointDynamics none{};
  const urdf::JointDynamics& dynamics = joint.dynamics == nullptr ? none : *joint.dynamics;
  hinge.of = &joint;
  const bool limited = joint.limits != nullptr;
  if (limited && joint.limits->effort == 0) {
    hinge.hinge.passive = Passive{.damping = dynamics.damping, .friction = dynamics.friction};
    return;
  }
  hinge.dry = dynamics.friction;
  hinge.viscous = dynamics.damping;
  if (limited) {
    hinge.effort = joint.limits->effort;
    hinge.speed = joint.limits->velocity;
  }
  hinge.no_effort = !limited || hinge.effort >= kMostEffort;
  hinge.no_speed = !limited || hinge.speed == 0 || hinge.speed > kMostSpeed;
  const auto check = [&](const char* key, double value, const char* what) {
    if (value >= 0) return;
    problems.add(urdf.place("joint", joint.name), fmt::format("joint {} has {} {}; expected {} of its motor, not negative",
                                                              in_quotes(joint.name), key, number_text(value), what));
  };
  check("effort", hinge.effort, "the torque at rest, N m,");
  check("velocity", hinge.speed, "the no-load speed, rad/s,");
}

void choose_motors(const std::vector<BodyType>& bodies, const UrdfText& urdf, std::vector<UrdfHinge>& hinges,
                   std::vector<UrdfNote>& notes) {
  const std::vector<Carried> carried = carried_by_body(bodies, hinges);
  if (std::ranges::any_of(hinges, [](const UrdfHinge& one) { return !one.hinge.passive; }))
    notes.push_back({urdf.place(), "effort and velocity become the ends of a motor's line", true});
  for (UrdfHinge& one : hinges) {
    if (!one.no_effort && !one.no_speed) continue;
    const Carried& load = carried[one.hinge.child];
    if (one.no_effort) one.effort = three_digits(kChosenShare * load.mass * kStandard * load.lever);
    if (one.no_speed) one.speed = kChosenSpeed;
    const char* const missing = one.no_effort && one.no_speed ? "limit" : one.no_effort ? "effort" : "velocity";
    one.source = fmt::format("chosen: the URDF has no {}", missing);
    const std::string torque = fmt::format("{} N m at rest", number_text(one.effort));
    const std::string speed = fmt::format("{} rad/s without load", number_text(one.speed));
    notes.push_back({urdf.place("joint", one.of->name),
                     fmt::format("joint {} has no {} of a motor; {} chosen", in_quotes(one.of->name), missing,
                                 one.no_effort && one.no_speed ? torque + " and " + speed + " are"
                                 : one.no_effort               ? torque + " is"
                                                               : speed + " is"),
                     true});
  }
}

}  // namespace gaitlab::interchange
