#include "app/look/module_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "app/look/cells.h"
#include "core/model/docking.h"
#include "core/model/outline.h"
#include "core/model/solid.h"
#include "core/robot_files/type_presets.h"
#include "core/settings/wording.h"
#include "report/analysis/envelope.h"

namespace gaitlab::app {

using namespace report;

namespace {

double mass_of(const ModuleType& type) {
  double mass = 0;
  for (const BodyType& body : type.bodies) mass += body.mass;
  return mass;
}

/// Text of a direction: `+y` if it is an axis of the frame, else its coordinates.
std::string direction(const Vec3& d) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(std::abs(d[axis]) - 1) < 1e-9) return fmt::format("{}{}", d[axis] > 0 ? '+' : '-', "xyz"[axis]);
  }
  return fmt::format("{:.3g} {:.3g} {:.3g}", d.x(), d.y(), d.z());
}

std::string range_of(const HingeType& hinge) {
  constexpr double kDegree = std::numbers::pi / 180;
  return hinge.hi == kNoStop ? "free" : fmt::format("{:.4g} to {:.4g} deg", hinge.lo / kDegree, hinge.hi / kDegree);
}

std::string quantity(const std::optional<double>& value, const char* unit) {
  return value ? fmt::format("{:.4g} {}", *value, unit) : "-";
}

std::string stated(double value, const char* unit) { return value > 0 ? fmt::format("{:.4g} {}", value, unit) : "-"; }

std::string spring_of(const Passive& p) {
  std::string text = "no motor";
  if (p.stiffness > 0) text += fmt::format(", spring {:.4g} N m/rad (at rest at {:.4g} rad)", p.stiffness, p.rest);
  if (p.damping > 0) text += fmt::format(", damper {:.4g} N m s/rad", p.damping);
  if (p.friction > 0) text += fmt::format(", friction {:.4g} N m", p.friction);
  return text;
}

std::string drive_of(const HingeType& hinge) {
  if (hinge.passive) return spring_of(*hinge.passive);
  if (!hinge.play.any()) return "";
  return fmt::format("play {:.4g} rad{}", hinge.play.width, hinge.play.encoder_at_motor ? ", encoder at the motor" : "");
}

std::string battery(const Supply& supply) {
  if (!supply.any()) return "";
  return fmt::format("battery: {:.4g} V, {:.4g} ohm, {}, {}\n", supply.voltage, supply.resistance, stated(supply.current, "A"),
                     stated(supply.capacity, "A h"));
}

/// Motors of a module type. Empty if the type names no actuator, because the scenario's default actuator is not that of the
/// module.
Motors motors_of(const Scenario& one) {
  for (const Node& document : *one.module_documents) {
    if (!preset_maps(document, Kind::actuator).empty()) return motors(one, 0);
  }
  return {};
}

std::string hinges(const Robot& robot, const Motors& known) {
  const ModuleType& type = robot.types[0];
  std::vector<Cells> rows{{"hinge", "axis", "range", "at rest", "no load", "continuous", ""}};
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const std::string name = robot.joints[j].name.substr(robot.joints[j].name.find('/') + 1);
    const HingeType& hinge = *std::ranges::find(type.hinges, name, &HingeType::name);
    const bool asked = robot.joints[j].driven() && !known.of_joint.empty();
    const Envelope motor = asked ? known.joint(j) : Envelope();
    rows.push_back({name, direction(hinge.in_parent.R * hinge.axis), range_of(hinge), quantity(motor.rest, "N m"),
                    quantity(motor.no_load, "rad/s"), quantity(motor.continuous, "A"), drive_of(hinge)});
  }
  return rows.size() > 1 ? cells_text(rows) : "  no hinges\n";
}

/// Centre of mass, m, with 0 in place of coordinates that are only rounding errors.
Vec3 clean_com(const BodyType& body) {
  constexpr double kNoise = 1e-9;  // share of the body's largest edge
  Vec3 com = body.com;
  if (body.shapes.empty()) return com;
  const auto [low, high] = bounds(body.shapes);
  const double least = kNoise * (high - low).maxCoeff();
  for (double& x : com) x = std::abs(x) < least ? 0 : x;
  return com;
}

std::string bodies(const ModuleType& type) {
  std::vector<Cells> rows{{"body", "mass", "centre of mass (body axes)", "inertia xx, yy, zz (kg m^2)"}};
  for (const BodyType& body : type.bodies) {
    const Vec3 com = 1000 * clean_com(body);
    rows.push_back({body.name, fmt::format("{:.4g} kg", body.mass),
                    fmt::format("{:.4g} {:.4g} {:.4g} mm", com.x(), com.y(), com.z()),
                    fmt::format("{:.4g} {:.4g} {:.4g}", body.inertia(0, 0), body.inertia(1, 1), body.inertia(2, 2))});
  }
  return cells_text(rows);
}

std::string faces(const ModuleType& type) {
  std::vector<Cells> rows{{"face", "body", "gender", "connector", "turns", "normal (body axes)"}};
  for (const FaceType& face : type.faces) {
    std::string turns;
    for (std::size_t turn = 0; turn < face.turns.size(); ++turn) {
      if (face.turns[turn]) turns += fmt::format("{}{}", turns.empty() ? "" : " ", turn);
    }
    rows.push_back({std::to_string(face.id), type.bodies[face.body].name, name_of(face.gender),
                    face.connector.empty() ? "-" : face.connector, turns, direction(face.normal)});
  }
  return rows.size() > 1 ? cells_text(rows) : "  no faces\n";
}

std::string connectors(const ModuleType& type) {
  std::vector<Cells> rows{{"connector", "tension", "shear", "bending", "torsion"}};
  for (const auto& [name, one] : type.connectors) {
    rows.push_back(
        {name, stated(one.tension, "N"), stated(one.shear, "N"), stated(one.bending, "N m"), stated(one.torsion, "N m")});
  }
  return rows.size() > 1 ? cells_text(rows) : "";
}

/// Adds a line `WHERE: SOURCE` for every `source` in the document, where WHERE is the path of its keys.
void add_sources(const Node& node, const std::string& where, std::string& text) {
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    if (node.kind == Node::Kind::map && node.keys[i].first == "source") {
      std::string source = item.text;
      std::ranges::replace(source, '\n', ' ');
      text += "  " + wrapped(fmt::format("{}: {}", where.empty() ? "type" : where, one_line(source)), 4, 98)
                         .substr(4);  // continuation lines have a larger indentation
      continue;
    }
    const Node* name = item.kind == Node::Kind::map ? item.find("name") : nullptr;
    const std::string key = node.kind == Node::Kind::map ? node.keys[i].first : name != nullptr ? name->text : "";
    if (item.kind == Node::Kind::map || item.kind == Node::Kind::list) {
      add_sources(item, key.empty() || where.empty() ? where + key : where + "." + key, text);
    }
  }
}

}  // namespace

std::string size_text(const Robot& robot) {
  Vec3 size = 1000 * outline_edges(robot);
  std::sort(size.begin(), size.end());
  return size.z() > 0 ? fmt::format("{:.4g} x {:.4g} x {:.4g} mm", size.x(), size.y(), size.z()) : "no shape";
}

std::string module_row(const Scenario& one) {
  const Robot& robot = *one.robot;
  const Motors known = motors_of(one);
  std::optional<double> most;
  for (std::size_t j = 0; j < known.of_joint.size(); ++j) {
    if (robot.joints[j].driven() && known.joint(j).rest) most = std::max(most.value_or(0), *known.joint(j).rest);
  }
  return fmt::format("{:<26} {:>7.3f} kg  {:<8}  {}", size_text(robot), mass_of(robot.types[0]),
                     counted(robot.joints.size(), "hinge"), quantity(most, "N m"));
}

std::string module_table(const Scenario& one) {
  const Robot& robot = *one.robot;
  const ModuleType& type = robot.types[0];
  std::string sources;
  if (!one.module_documents->empty()) add_sources(one.module_documents->front(), "", sources);
  return fmt::format("{}: {}, {:.4g} kg in {}, {} and {}\n\n{}\n{}{}\n{}{}{}", type.name, size_text(robot), mass_of(type),
                     type.bodies.size() == 1 ? "1 body" : fmt::format("{} bodies", type.bodies.size()),
                     counted(type.hinges.size(), "hinge"), counted(type.faces.size(), "face"), bodies(type),
                     hinges(robot, motors_of(one)), battery(type.battery), faces(type),
                     type.connectors.empty() ? "" : "\n" + connectors(type), sources.empty() ? "" : "\nsources\n" + sources);
}

}  // namespace gaitlab::app
