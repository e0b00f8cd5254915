#include "interchange/urdf_motor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

constexpr double kLeastEffort = 1e-6, kMostEffort = 1e5;  // N m, between which an effort is that of a motor
constexpr double kLeastSpeed = 1e-3, kMostSpeed = 1000;   // rad/s, of a motor behind its gear
constexpr double kMostTorque = 1e9;                       // N m, that the servo permits; also of friction, N m s/rad
constexpr double kChosenSpeed = 20;                       // rad/s
constexpr double kChosenShare = 2;                        // of the weight that the motor holds
constexpr double kStandard = 9.81;                        // m/s^2

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

/// The sentence's end on numbers that are missing, or that are not those of a motor.
std::string fault_of(const UrdfHinge& one) {
  const bool effort_stated = one.no_effort && one.effort != kNoEffort;
  const bool speed_stated = one.no_speed && one.speed != kNoSpeed;
  if (one.no_effort && one.no_speed && !effort_stated && !speed_stated) return "no limit of a motor";
  std::string text;
  const auto add = [&](bool missing, bool stated, const char* key, double value) {
    if (!missing) return;
    text += text.empty() ? "" : ", and ";
    text += stated ? fmt::format("{} {}, which counts as not stated", key, number_text(value))
                   : fmt::format("no {} of a motor", key);
  };
  add(one.no_effort, effort_stated, "effort", one.effort);
  add(one.no_speed, speed_stated, "velocity", one.speed);
  return text;
}

double three_digits(double value) { return std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr); }

/// Adds a note on the hinges without a motor because of an effort of 0, which may stand for a missing number.
void note_passive(const UrdfText& urdf, const std::vector<UrdfHinge>& hinges, std::vector<UrdfNote>& notes) {
  const auto passive = [](const UrdfHinge& one) { return one.hinge.passive.has_value(); };
  const auto first = std::ranges::find_if(hinges, passive);
  if (first == hinges.end()) return;
  const std::ptrdiff_t number = std::ranges::count_if(hinges, passive);
  const std::string name = in_quotes(first->of->name);
  notes.push_back({urdf.place("joint", first->of->name),
                   fmt::format("a motor of {}, whose effort is 0",
                               number == 1 ? "joint " + name : fmt::format("{} joints, first {}", number, name))});
}

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
  hinge.effort = limited ? joint.limits->effort : kNoEffort;
  hinge.speed = limited ? joint.limits->velocity : kNoSpeed;
  hinge.no_effort = hinge.effort < kLeastEffort || hinge.effort >= kMostEffort;
  hinge.no_speed = hinge.speed < kLeastSpeed || hinge.speed > kMostSpeed;
  const auto check = [&](const char* key, double value, const char* what) {
    if (value >= 0) return;
    problems.add(urdf.place("joint", joint.name), fmt::format("joint {} has {} {}; expected {} of its motor, not negative",
                                                              in_quotes(joint.name), key, number_text(value), what));
  };
  check("effort", hinge.effort, "the torque at rest, N m,");
  check("velocity", hinge.speed, "the no-load speed, rad/s,");
  const auto check_friction = [&](const char* key, double value, const char* unit) {
    if (value >= 0 && value <= kMostTorque) return;
    problems.add(urdf.place("joint", joint.name),
                 fmt::format("joint {} has {} {}; expected 0 to 1e9 {}", in_quotes(joint.name), key, number_text(value), unit));
  };
  check_friction("damping", hinge.viscous, "N m s/rad");
  check_friction("friction", hinge.dry, "N m");
}

void choose_motors(const std::vector<BodyType>& bodies, const UrdfText& urdf, std::vector<UrdfHinge>& hinges,
                   std::vector<UrdfNote>& notes, Problems& problems) {
  note_passive(urdf, hinges, notes);
  const std::vector<Carried> carried = carried_by_body(bodies, hinges);
  if (std::ranges::any_of(hinges, [](const UrdfHinge& one) { return !one.hinge.passive; }))
    notes.push_back({urdf.place(), "effort and velocity become the ends of a motor's line", true});
  for (UrdfHinge& one : hinges) {
    if (!one.no_effort && !one.no_speed) continue;
    const Carried& load = carried[one.hinge.child];
    const std::string fault = fault_of(one);
    if (one.no_effort) one.effort = three_digits(kChosenShare * load.mass * kStandard * load.lever);
    if (one.no_speed) one.speed = kChosenSpeed;
    if (!(one.effort <= kMostTorque) && problems.empty()) {  // else the absurd number has its message
      problems.add(urdf.place("joint", one.of->name),
                   fmt::format("joint {} has {}, and one that holds what it moves has {} N m; expected at most 1e9 N m",
                               in_quotes(one.of->name), fault, number_text(one.effort)));
    }
    one.source = "chosen: the URDF has " + fault;
    const std::string torque = fmt::format("{} N m at rest", number_text(one.effort));
    const std::string speed = fmt::format("{} rad/s without load", number_text(one.speed));
    notes.push_back({urdf.place("joint", one.of->name),
                     fmt::format("joint {} has {}; {} chosen", in_quotes(one.of->name), fault,
                                 one.no_effort && one.no_speed ? torque + " and " + speed + " are"
                                 : one.no_effort               ? torque + " is"
                                                               : speed + " is"),
                     true});
  }
}

}  // namespace gaitlab::interchange
