// Plausible numbers of docks and of contacts with the ground.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/model/kinematics.h"
#include "core/model/outline.h"
#include "core/settings/wording.h"
#include "core/simulation/start.h"
#include "report/verdict/plausible/plausible_number.h"

namespace gaitlab::report {

namespace {

double of_kilo(double value) { return value * 1e3; }
double halved(double value) { return value / 2; }

/// A load that a dock holds, and its key.
struct DockLoad {
  const char* key;
  double Connector::*load;
};
constexpr std::array kForces{DockLoad{"tension", &Connector::tension}, DockLoad{"shear", &Connector::shear}};
constexpr std::array kMoments{DockLoad{"bending", &Connector::bending}, DockLoad{"torsion", &Connector::torsion}};

SourceLocation connector_place(const Scenario& s, std::size_t type, const std::string& name, const char* key) {
  const Node* at = type < s.module_documents->size() ? &(*s.module_documents)[type] : nullptr;
  SourceLocation place = at == nullptr ? SourceLocation() : at->place;
  for (const std::string& one : {std::string("connectors"), name, std::string(key)}) {
    at = at == nullptr ? nullptr : at->find(one);
    if (at != nullptr) place = at->place;
  }
  return place;
}

/// `own` and the bodies of all module types, because their masses make up the weight.
std::vector<std::string> with_bodies(const Scenario& s, const std::string& own) {
  std::vector<std::string> parts{own};
  for (const ModuleType& type : s.robot->types) {
    for (const BodyType& body : type.bodies) parts.push_back(type.name + "/" + body.name);
  }
  return parts;
}

/// Loads of the connectors of all module types, relative to `scale`, the robot's weight or its moment.
std::vector<Finding> dock_loads(const Scenario& s, std::span<const DockLoad> loads, double scale, const char* unit,
                                const std::string& of) {
  std::vector<Finding> found;
  for (std::size_t t = 0; scale > 0 && t < s.robot->types.size(); ++t) {
    for (const auto& [name, connector] : s.robot->types[t].connectors) {
      for (const DockLoad& one : loads) {
        const double value = connector.*one.load;
        found.push_back({connector_place(s, t, name, one.key),
                         with_bodies(s, s.robot->types[t].name + "/" + name),
                         fmt::format("{} of connector {} of {} is {} {}, {:.3g} times {}", one.key, in_quotes(name),
                                     clipped(s.robot->types[t].name), number_text(value), unit, value / scale, of),
                         value / scale,
                         {},
                         {},
                         {{value, unit}}});
      }
    }
  }
  return found;
}

std::vector<Finding> dock_forces(const Subject& subject) {
  const Robot& robot = *subject.scenario.robot;
  return dock_loads(subject.scenario, kForces, robot.mass * kGravity, "N",
                    fmt::format("the weight of the robot ({:.3g} kg)", robot.mass));
}

std::vector<Finding> dock_moments(const Subject& subject) {
  const Robot& robot = *subject.scenario.robot;
  const double size = outline_edges(robot).norm();
  return dock_loads(
      subject.scenario, kMoments, robot.mass * kGravity * size, "N m",
      fmt::format("the weight of the robot ({:.3g} kg) at a distance of its extent ({:.3g} m)", robot.mass, size));
}

/// Size of the largest contact element that touches the ground, m: its diameter, or the largest edge of its body.
double contact_size(const Subject& subject) {
  const Robot& robot = *subject.scenario.robot;
  double largest = 0;
  for (const ContactElement& one : contact_elements(robot, subject.scenario.contact.on)) {
    const Body& body = robot.bodies[one.body];
    const Subject::Size& size = subject.sizes[robot.modules[body.module].type][body.type];
    const double edge = one.radius > 0 ? 2 * one.radius : size.shapes.empty() ? 0 : size.largest_edge();
    largest = std::max(largest, edge);
  }
  return largest;
}

std::vector<Finding> stiffnesses(const Subject& subject) {
  const Scenario& s = subject.scenario;
  const double feet = std::max(4.0, static_cast<double>(s.robot->modules.size()));  // elements that carry the robot
  const double size = stands(s) && s.contact.model().penalty_settings ? contact_size(subject) : 0;
  if (!(size > 0)) return {};
  const double load = s.robot->mass * kGravity / feet;  // N
  const auto sink = [load, k = s.contact.penalty.k](double stiffness) { return std::pow(load / stiffness, 1 / k); };
  const double kn = s.contact.penalty.kn;
  return {
      {s.nearest_place("contact.stiffness"),
       with_bodies(s, "contact.stiffness"),
       fmt::format("contact.stiffness is {}: {} contact elements under the weight of the robot ({:.3g} kg) sink by {:.3g} m, "
                   "but the largest element or its body measures {:.3g} m",
                   number_text(kn), feet, s.robot->mass, sink(kn), size),
       sink(kn) / size,
       [sink, size, kn](const Slip& slip) { return sink(slip.corrected(kn)) / size; },
       {},
       {{kn, s.contact.penalty.k == 1 ? "N/m" : nullptr}}}};
}

std::vector<Finding> slip_speeds(const Subject& subject) {
  const Scenario& s = subject.scenario;
  if (!stands(s) || !s.contact.model().penalty_settings) return {};
  double fastest = 0;  // rad/s
  for (const SetPointRange& one : subject.set_points()) fastest = std::max(fastest, one.speed);
  const double speed = fastest * outline_edges(*s.robot).maxCoeff();  // m/s
  if (!(speed > 0)) return {};
  const double slip = s.contact.penalty.v_lim;
  return {
      {s.nearest_place("contact.slip_speed"),
       {"contact.slip_speed"},
       fmt::format("contact.slip_speed is {} m/s, below which feet creep, but the gait moves the robot's parts at up to {:.3g} "
                   "m/s (set points {:.3g} rad/s x largest edge {:.3g} m)",
                   number_text(slip), speed, fastest, speed / fastest),
       slip / speed,
       {},
       {},
       {{slip, "m/s"}}}};
}

SourceLocation contacts_place(const Scenario& s, std::size_t type) {
  const Node* const document = type < s.module_documents->size() ? &(*s.module_documents)[type] : nullptr;
  const Node* const contacts = document == nullptr ? nullptr : document->find("contacts");
  return contacts != nullptr ? contacts->place : document != nullptr ? document->place : SourceLocation();
}

/// The contact element that reaches farthest below the shapes of the robot at the start.
std::vector<Finding> contacts_below(const Subject& subject) {
  const Scenario& s = subject.scenario;
  const Robot& robot = *s.robot;
  const std::vector<ContactElement> elements =
      stands(s) ? contact_elements(robot, s.contact.on) : std::vector<ContactElement>();
  if (elements.empty() || !(outline_edges(robot).maxCoeff() > 0)) return {};
  Kinematics k(robot);
  k.place(robot, start_state(s));
  const auto bottom = [&k](const ContactElement& one) { return k.point(one.link, one.centre).z() - one.radius; };
  const ContactElement& lowest = *std::ranges::min_element(elements, {}, bottom);
  const Body& body = robot.bodies[lowest.body];
  const std::size_t type = robot.modules[body.module].type;
  if (robot.types[type].bodies[body.type].shapes.empty()) return {};  // a foot that is not drawn
  const double edge = subject.sizes[type][body.type].largest_edge();
  const double below = std::max(0.0, lowest_point(robot, k, {}) - bottom(lowest));
  return {{contacts_place(s, type),
           {robot.types[type].name + "/" + robot.types[type].bodies[body.type].name},
           fmt::format(
               "the contact element {}{} is {:.3g} m below the lowest shape of the robot at the start; the largest edge of "
               "its body is {:.3g} m",
               lowest.name, lowest.radius > 0 ? fmt::format(" of radius {} m", number_text(lowest.radius)) : "", below, edge),
           below / edge,
           [below, edge, radius = lowest.radius](const Slip& slip) {
             return std::max(0.0, below - radius + slip.corrected(radius)) / edge;
           },
           [radius = lowest.radius, edge](const Slip& slip) { return slip.corrected(radius) >= kLeastShare * edge; },
           {{lowest.radius, "m"}}}};
}

}  // namespace

std::vector<PlausibleNumber> plausible_contacts() {
  return {
      {"dock force",
       0,
       1000,
       "expected at most 1000 times that",
       {{"is it in mN", of_milli}},
       {"density"},
       dock_forces,
       false,
       kLeastShare},
      {"dock moment",
       0,
       1000,
       "expected at most 1000 times that",
       {{"is it in mN m", of_milli}},
       {"density"},
       dock_moments,
       false,
       kLeastShare},
      {"stiffness", 0, 0.1, "expected at most a tenth of that size", {{"is it in N/mm", of_kilo}}, {"density"}, stiffnesses},
      {"slip speed",
       0,
       1,
       "expected less than the speed of the parts",
       {{"is it in mm/s", of_milli}},
       {"angle"},
       slip_speeds,
       true,
       1e-6},
      {"contact element",
       0,
       0.25,
       "expected at most a quarter of that edge",
       {{"is the radius in mm", of_milli}, {"is the radius in cm", of_centi}, {"is it the diameter", halved}},
       {"height"},
       contacts_below},
  };
}

}  // namespace gaitlab::report
