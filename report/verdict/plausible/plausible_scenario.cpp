#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model/outline.h"
#include "core/scenario/sections.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"
#include "core/simulation/start.h"
#include "report/analysis/collisions.h"
#include "report/analysis/cpg_alone.h"
#include "report/analysis/envelope.h"
#include "report/analysis/own_overlap.h"
#include "report/verdict/plausible/plausible_number.h"

namespace gaitlab::report {

namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr double kNoStopMeant = 360;  // rad; a range above this number means "no stop", not an angle in degrees
constexpr double kOnTheLimit = 1 + 1e-9;

Finding angle(const Scenario& s, const std::string& part, const std::string& key, double value) {
  return {s.nearest_place(key),
          {part},
          fmt::format("{} is {} rad, {:.3g} turns", key, number_text(value), std::abs(value) / kWholeTurn),
          value,
          {},
          {},
          {{value, "rad"}}};
}

/// Place of the range of a joint's hinge in the text of its module type.
SourceLocation range_place(const Scenario& s, std::size_t joint) {
  const Node* const hinge = hinge_map(s, joint);
  const Node* const range = hinge == nullptr ? nullptr : hinge->find("range");
  return range == nullptr ? s.nearest_place("robot") : range->place;
}

std::vector<Finding> angles(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  const auto larger = [](const Finding& a, const Finding& b) { return std::abs(a.value) < std::abs(b.value); };
  for (const PluginSelection* plugin : {&s.cpg, &s.controller, &s.actuator}) {
    if (plugin->entry == nullptr) continue;
    const std::string section = word(plugin->entry->kind);
    const SettingsNumbers numbers(*plugin);
    for (const SettingsNumbers::Found& one : numbers.all()) {
      std::vector<Finding> of_joints;
      for (std::size_t j = 0; one.unit == "rad" && j < s.robot->joints.size(); ++j) {
        if (!s.robot->joints[j].turns_freely()) of_joints.push_back(angle(s, section, section + "." + one.key, one.value[j]));
      }
      if (!of_joints.empty()) found.push_back(*std::max_element(of_joints.begin(), of_joints.end(), larger));
    }
  }
  for (Eigen::Index i = 0; i < 3; ++i) found.push_back(angle(s, "robot.orientation", "robot.orientation", s.orientation[i]));
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    const Joint& joint = s.robot->joints[j];
    const double widest = std::max(std::abs(joint.lo), std::abs(joint.hi));
    if (widest > kNoStopMeant) continue;
    found.push_back(angle(s, joint.name, "the range of hinge " + joint.name, widest));
    found.back().place = range_place(s, j);
  }
  return found;
}

std::vector<Finding> control_periods(const Subject& subject) {
  const Scenario& s = subject.scenario;
  if (s.controller.entry == nullptr) return {};
  return {{s.nearest_place("controller.period"),
           {"controller.period"},
           fmt::format("controller.period is {} s", number_text(s.control_period)),
           s.control_period,
           {},
           {},
           {{s.control_period, "s"}}}};
}

std::vector<Finding> contacts(const Subject& subject) {
  const Scenario& s = subject.scenario;
  if (!stands(s)) return {};
  const std::size_t known = contact_elements(*s.robot, s.contact.on).size();
  std::vector<std::string> files;
  for (const Node& document : *s.module_documents) files.push_back(document.place.file);
  const bool only_feet = s.contact.on == ContactSet::feet && !contact_elements(*s.robot, ContactSet::all).empty();
  return {
      {s.nearest_place("contact.on"),
       {"contact"},
       fmt::format("contact.on is {}, but no {} has a contact element, so that the robot falls through the ground",
                   name_of(s.contact.on), s.contact.on == ContactSet::feet ? "free body of a module without children" : "body"),
       static_cast<double>(known),
       {},
       {},
       {},
       only_feet ? "take contact: {on: all}" : fmt::format("take contacts: {{all: shapes}} in {}", joined(files))}};
}

std::vector<Finding> frictions(const Subject& subject) {
  const Scenario& s = subject.scenario;
  if (!s.ground.exists()) return {};
  return {{s.nearest_place("ground.friction"),
           {"ground.friction"},
           fmt::format("ground.friction is {}", number_text(s.ground.friction)),
           s.ground.friction,
           {},
           {},
           {{s.ground.friction, ""}}}};
}

std::vector<Finding> start_heights(const Subject& subject) {
  const Scenario& s = subject.scenario;
  const double edge = outline_edges(*s.robot).maxCoeff();
  if (!stands(s) || !(edge > 0) || !(s.physics.gravity.norm() > 0)) return {};
  const RobotState start = start_state(s);
  Kinematics k(*s.robot);
  k.place(*s.robot, start);
  const double lowest = lowest_point(*s.robot, k, contact_elements(*s.robot, s.contact.on)) - s.ground.highest();
  const double z = start.position.z();
  return {{s.nearest_place("robot.position"),
           {"robot.position"},
           fmt::format("the lowest point of the robot starts {:.4g} m above the ground; the robot's largest edge is {:.3g} m",
                       lowest, edge),
           std::max(lowest, 0.0) / edge,  // the highest point of boxes is an upper bound
           [lowest, z, edge](const Slip& slip) { return (lowest - z + slip.corrected(z)) / edge; },
           [lowest, z, edge](const Slip& slip) { return lowest - z + slip.corrected(z) >= -kLeastShare * edge; },
           {{z, "m"}}}};
}

std::vector<Finding> trace_periods(const Subject& subject) {
  const Scenario& s = subject.scenario;
  const std::vector<double> all = frequencies(s, s.cpg);
  if (all.empty()) return {};
  const double frequency = *std::max_element(all.begin(), all.end());
  return {{s.nearest_place("trace.period"),
           {"trace.period"},
           fmt::format("trace.period is {} s, but the set points repeat every {:.4g} s", number_text(s.trace.period),
                       1 / frequency),
           s.trace.period * frequency,
           {},
           {},
           {{s.trace.period, "s"}}}};
}

/// Place of the dock of one of the bodies' modules, or else of the robot.
SourceLocation dock_place(const Scenario& s, std::size_t first, std::size_t second) {
  for (const std::size_t body : {second, first}) {
    const Module& module = s.robot->modules[s.robot->bodies[body].module];
    if (module.parent >= 0) return module.dock.place;
  }
  return s.nearest_place("robot");
}

std::vector<Finding> overlaps_at_start(const Subject& subject) {
  const Scenario& s = subject.scenario;
  const std::optional<Collision> met = collision_in(s, start_state(s));
  if (!met) return {};
  const auto of_type = [&](std::size_t body) {
    const ModuleType& type = s.robot->types[s.robot->modules[s.robot->bodies[body].module].type];
    return type.name + "/" + type.bodies[s.robot->bodies[body].type].name;
  };
  const std::string more = met->pairs > 1 ? fmt::format("; {} pairs of bodies overlap", met->pairs) : "";
  return {{dock_place(s, met->deepest_first, met->deepest_second),
           {of_type(met->deepest_first), of_type(met->deepest_second)},
           fmt::format("{} and {} overlap by {:.3g} mm at the start{}", s.robot->bodies[met->deepest_first].name,
                       s.robot->bodies[met->deepest_second].name, 1000 * met->depth, more),
           met->depth,
           {},
           {},
           {},
           "look at the docks and at initial.angles"}};
}

/// Overlaps of the two bodies of a hinge within its range, beyond those by design.
std::vector<Finding> overlaps_in_range(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  const BodyPairs of_robot(s.may_overlap, gaitlab::body_names(*s.robot));
  for (std::size_t t = 0; t < s.robot->types.size(); ++t) {
    const ModuleType& type = s.robot->types[t];
    const BodyPairs left_out(type.may_overlap, body_names(type));
    for (std::size_t h = 0; h < type.hinges.size(); ++h) {
      const HingeType& hinge = type.hinges[h];
      const auto compared = [&](const Module& one) {
        return one.type == t && !of_robot.has(one.first_body + hinge.parent, one.first_body + hinge.child);
      };
      if (left_out.has(hinge.parent, hinge.child) || std::ranges::none_of(s.robot->modules, compared)) continue;
      const double depth = deepest_in_range(type, h);
      const Node* const map =
          t < s.module_documents->size() ? entry_map((*s.module_documents)[t], "hinges", "name", hinge.name) : nullptr;
      found.push_back({map == nullptr ? s.nearest_place("robot") : map->place,
                       {type.name + "/" + type.bodies[hinge.parent].name, type.name + "/" + type.bodies[hinge.child].name},
                       fmt::format("over its range the bodies of hinge {} of {} overlap by up to {:.2g} mm more than by design",
                                   in_quotes(hinge.name), clipped(type.name), 1000 * depth),
                       depth,
                       {},
                       {},
                       {},
                       "take a narrower range, draw the bodies as they are, or list them in may_overlap"});
    }
  }
  return found;
}

SourceLocation gait_place(const Scenario& s) { return s.nearest_place("cpg.amplitude"); }

std::vector<Finding> set_points_beyond(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  for (const SetPointRange& one : subject.set_points()) {
    const Joint& joint = s.robot->joints[one.joint];
    if (joint.turns_freely()) continue;
    const double beyond = std::max(joint.lo - one.least, one.most - joint.hi);
    const auto again = [one, joint](const Slip& slip) {
      return std::max({0.0, joint.lo - slip.corrected(one.least), slip.corrected(one.most) - joint.hi});
    };
    const auto sensible = [one](const Slip& slip) {
      constexpr double kLeastSwing = 0.1;  // rad
      return slip.corrected(one.most) - slip.corrected(one.least) >= kLeastSwing;
    };
    found.push_back({gait_place(s),
                     {"cpg", s.robot->joints[one.joint].name},
                     fmt::format("the set points of {} go from {:.4g} to {:.4g} rad, but its range from {:.4g} to {:.4g} rad",
                                 joint.name, one.least, one.most, joint.lo, joint.hi),
                     std::max(0.0, beyond),
                     again,
                     sensible});
  }
  return found;
}

std::vector<Finding> set_point_speeds(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  if (s.actuator.entry == nullptr) return found;
  const Motors known = motors(s, 0);
  for (const SetPointRange& one : subject.set_points()) {
    if (known.of_joint.empty() || !known.joint(one.joint).no_load) continue;
    const double most = *known.joint(one.joint).no_load;
    found.push_back({gait_place(s),
                     {"cpg", s.robot->joints[one.joint].name},
                     fmt::format("the set points of {} move at up to {:.3g} rad/s, but its motor reaches only {:.3g} rad/s "
                                 "without load",
                                 s.robot->joints[one.joint].name, one.speed, most),
                     one.speed / most});
  }
  return found;
}

}  // namespace

bool stands(const Scenario& s) { return s.base != Base::fixed && s.ground.exists() && s.contact.on != ContactSet::none; }

std::vector<PlausibleNumber> plausible_scenario() {
  return {
      {"angle", -2 * kWholeTurn, 2 * kWholeTurn, "expected at most two turns", {{"is it in degrees", of_degrees}}, {}, angles},
      {"control period", 0, 0.5, "expected at most 0.5 s", {{"is it in ms", of_milli}}, {}, control_periods, false, 1e-3},
      {"contact", 1, kNoLimit, "expected at least one", {}, {}, contacts},
      {"friction",
       0,
       3,
       "expected at most 3 (rubber on concrete: about 1)",
       {{"is it in percent", of_centi}},
       {},
       frictions,
       false,
       0.05},
      {"height",
       -1,
       1,
       "expected at most the length of that edge",
       {{"is position in mm", of_milli}, {"is position in cm", of_centi}},
       {},
       start_heights},
      {"trace period",
       0,
       0.1 * kOnTheLimit,
       "expected at most a tenth of that time",
       {{"is it in ms", of_milli}},
       {},
       trace_periods,
       false,
       1e-3},
      {"overlap", 0, 0, "expected bodies that do not overlap", {}, {"density"}, overlaps_at_start},
      {"range overlap", 0, Limits().collision, "expected at most 2 mm", {}, {"density", "overlap"}, overlaps_in_range},
      {"set points",
       0,
       0.01,
       "expected set points in the range",
       {{"are they in degrees", of_degrees}},
       {"angle"},
       set_points_beyond,
       true},
      {"set point speed",
       0,
       1,
       "expected less than the speed of the motor",
       {},
       {"angle", "set points", "no-load speed", "wheel speed"},
       set_point_speeds,
       true},
  };
}

}  // namespace gaitlab::report
