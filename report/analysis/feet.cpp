#include "report/analysis/feet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/model/kinematics.h"
#include "report/analysis/states.h"

namespace gaitlab::report {

namespace {

/// A contact element and its columns of the trace.
struct Pressed {
  ContactElement element;
  Series fn, fx, fy, fz;
};

/// Point at which the ground acts on an element: the element's deepest point. Boxes that move are ignored.
Vec3 meeting_point(const Scenario& scenario, const ContactElement& element, const Vec3& centre) {
  if (!scenario.ground.exists() || scenario.contact.model().moves_boxes) return centre - element.radius * Vec3::UnitZ();
  return scenario.ground.query(centre, element.radius).point;
}

void add_row(Foot& foot, const Scenario& scenario, const std::vector<Pressed>& elements, const Kinematics& k, std::size_t row) {
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  double normal = 0;
  for (const Pressed& one : elements) {
    force += Vec3(one.fx[row], one.fy[row], one.fz[row]);
    if (!(one.fn[row] > 0)) continue;
    normal += one.fn[row];
    moment += one.fn[row] * meeting_point(scenario, one.element, k.point(one.element.link, one.element.centre));
  }
  const Body& body = scenario.robot->bodies[foot.body];
  Vec3 point = k.point(body.link, body.in_link.p);
  if (row > 0) point = {foot.x.back(), foot.y.back(), foot.z.back()};
  if (normal > 0) point = moment / normal;
  foot.fx.push_back(force.x());
  foot.fy.push_back(force.y());
  foot.fz.push_back(force.z());
  foot.x.push_back(point.x());
  foot.y.push_back(point.y());
  foot.z.push_back(point.z());
}

Foot unloaded(const Robot& robot, std::size_t body) {
  Foot foot;
  foot.name = robot.bodies[body].name;
  foot.module = robot.bodies[body].module;
  foot.body = body;
  return foot;
}

/// Foot of a body whose columns are in `loads`.
Foot loaded(const Robot& robot, std::size_t body, const Trace& loads) {
  Foot foot = unloaded(robot, body);
  const auto take = [&](const char* quantity, std::vector<double>& into) {
    const std::size_t column = loads.find(fmt::format("foot.{}.{}", foot.name, quantity));
    if (column < loads.columns.size() && loads.rows() > 0) into = Series(loads, column).values();
  };
  take("fx", foot.fx);
  take("fy", foot.fy);
  take("fz", foot.fz);
  take("x", foot.x);
  take("y", foot.y);
  take("z", foot.z);
  return foot;
}

bool carries(const Foot& foot) {
  const auto loads = [](double force) { return force != 0 && std::isfinite(force); };
  return std::ranges::any_of(foot.fx, loads) || std::ranges::any_of(foot.fy, loads) || std::ranges::any_of(foot.fz, loads);
}

}  // namespace

std::vector<Foot> feet(const Scenario& scenario, const Recording& r, const Trace& loads) {
  const Robot& robot = *scenario.robot;
  std::map<std::size_t, std::vector<Pressed>> of_body;
  std::map<std::size_t, std::size_t> first_of_module;
  const std::vector<ContactElement> elements = contact_elements(robot, scenario.contact.on);
  bool whole = !elements.empty() && r.has_states(robot);
  for (std::size_t c = 0; c < elements.size(); ++c) {
    const auto column = [&](const char* name) { return r.series(fmt::format("contact.{}.{}", c, name)); };
    const Pressed one{elements[c], column("fn"), column("fx"), column("fy"), column("fz")};
    for (const Series* each : {&one.fn, &one.fx, &one.fy, &one.fz}) whole = whole && !each->empty();
    of_body[elements[c].body].push_back(one);
    first_of_module.emplace(robot.bodies[elements[c].body].module, elements[c].body);
  }
  std::vector<Foot> found;
  if (whole) {
    for (const auto& entry : of_body) found.push_back(unloaded(robot, entry.first));
    const States states(r, robot);
    Kinematics k(robot);
    for (std::size_t row = 0; row < r.rows(); ++row) {
      k.update(robot, states(row));
      for (Foot& foot : found) add_row(foot, scenario, of_body[foot.body], k, row);
    }
  } else if (loads.rows() > 0) {
    for (const auto& entry : of_body) found.push_back(loaded(robot, entry.first, loads));
  } else {
    for (const auto& entry : first_of_module) {
      found.push_back(unloaded(robot, entry.second));
      found.back().fz = r.series(fmt::format("load.{}", entry.first)).values();
    }
  }
  std::erase_if(found, [](const Foot& foot) { return !carries(foot); });
  return found;
}

}  // namespace gaitlab::report
