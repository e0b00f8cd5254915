#include "interchange/urdf_motor.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

constexpr double kLeastEffort = 1e-6, kMostEffort = 1e5;  // N m, between which an effort is that of a motor
constexpr double kLeastSpeed = 1e-3, kMostSpeed = 1000;   // rad/s, of a motor behind its gear

/// The sentence's end on numbers that are missing, or that are not those of a motor.
std::string fault_of(const RobotHinge& one) {
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

/// Adds a note on the hinges without a motor because of an effort of 0, which may stand for a missing number.
void note_passive(RobotBodies& made) {
  const auto passive = [](const RobotHinge& one) { return one.hinge.passive.has_value(); };
  const auto first = std::ranges::find_if(made.hinges, passive);
  if (first == made.hinges.end()) return;
  const std::ptrdiff_t number = std::ranges::count_if(made.hinges, passive);
  const RobotElement& of = made.hinge_of[static_cast<std::size_t>(first - made.hinges.begin())];
  const std::string name = in_quotes(of.name);
  made.notes.push_back(
      {of.place, fmt::format("a motor of {}, whose effort is 0",
                             number == 1 ? "joint " + name : fmt::format("{} joints, first {}", number, name))});
}

}  // namespace

void read_motor(const urdf::Joint& joint, const UrdfText& urdf, RobotHinge& hinge, Problems& problems) {
  const urdf::JointDynamics none{};
  const urdf::JointDynamics& dynamics = joint.dynamics == nullptr ? none : *joint.dynamics;
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

void choose_motors(RobotBodies& made, const UrdfText& urdf, Problems& problems) {
  note_passive(made);
  const std::vector<double> holding = holding_torques(made.bodies, made.hinges);
  if (std::ranges::any_of(made.hinges, [](const RobotHinge& one) { return !one.hinge.passive; }))
    made.notes.push_back({urdf.place(), "effort and velocity become the ends of a motor's line", true});
  for (std::size_t j = 0; j < made.hinges.size(); ++j) {
    RobotHinge& one = made.hinges[j];
    const RobotElement& of = made.hinge_of[j];
    if (!one.no_effort && !one.no_speed) continue;
    const std::string fault = fault_of(one);
    if (one.no_effort) one.effort = holding[j];
    if (one.no_speed) one.speed = kChosenSpeed;
    if (!(one.effort <= kMostTorque) && problems.empty()) {  // else the absurd number has its message
      problems.add(of.place,
                   fmt::format("joint {} has {}, and one that holds what it moves has {} N m; expected at most 1e9 N m",
                               in_quotes(of.name), fault, number_text(one.effort)));
    }
    one.source = "chosen: the URDF has " + fault;
    const std::string torque = fmt::format("{} N m at rest", number_text(one.effort));
    const std::string speed = fmt::format("{} rad/s without load", number_text(one.speed));
    made.notes.push_back({of.place,
                          fmt::format("joint {} has {}; {} chosen", in_quotes(of.name), fault,
                                      one.no_effort && one.no_speed ? torque + " and " + speed + " are"
                                      : one.no_effort               ? torque + " is"
                                                                    : speed + " is"),
                          true});
  }
}

}  // namespace gaitlab::interchange
