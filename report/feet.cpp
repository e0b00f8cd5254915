#include "report/feet.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/model/kinematics.h"

namespace gaitlab::report {

namespace {

/// A contact element and its columns.
struct Pressed {
  ContactElement element;
  Series fn, fx, fy, fz;
};

/// Where the ground meets an element: its deepest point. Boxes may have moved, and are looked for nowhere.
Vec3 meeting_point(const Scenario& scenario, const ContactElement& element, const Vec3& centre) {
  if (scenario.ground.kind == Ground::Kind::none || scenario.contact.moves_boxes())
    return centre - element.radius * Vec3::UnitZ();
  return scenario.ground.query(centre, element.radius).point;
}

Foot foot_of(const Scenario& scenario, const Recording& r, std::size_t body, const std::vector<Pressed>& elements,
             Kinematics& k) {
  const Robot& robot = *scenario.robot;
  Foot foot{robot.bodies[body].name, robot.bodies[body].module, body, {}, {}, {}, {}, {}, {}};
  Vec3 centre = Vec3::Zero();
  for (std::size_t row = 0; row < r.rows(); ++row) {
    Vec3 force = Vec3::Zero();
    double normal = 0;
    for (const Pressed& one : elements) {
      force += Vec3(one.fx[row], one.fy[row], one.fz[row]);
      normal += one.fn[row];
    }
    if (normal > 0 || row == 0) {
      k.update(robot, r.state(robot, row));
      centre = normal > 0 ? Vec3(Vec3::Zero()) : k.point(robot.bodies[body].link, robot.bodies[body].in_link.p);
      for (const Pressed& one : elements) {
        const ContactElement& element = one.element;
        if (!(one.fn[row] > 0)) continue;
        centre += one.fn[row] / normal * meeting_point(scenario, element, k.point(element.link, element.centre));
      }
    }
    foot.fx.push_back(force.x());
    foot.fy.push_back(force.y());
    foot.fz.push_back(force.z());
    foot.x.push_back(centre.x());
    foot.y.push_back(centre.y());
    foot.z.push_back(centre.z());
  }
  return foot;
}

bool carries(const Foot& foot) {
  const auto loads = [](double force) { return force != 0 && std::isfinite(force); };
  return std::ranges::any_of(foot.fx, loads) || std::ranges::any_of(foot.fy, loads) || std::ranges::any_of(foot.fz, loads);
}

}  // namespace

std::vector<Foot> feet(const Scenario& scenario, const Recording& r) {
  const Robot& robot = *scenario.robot;
  std::map<std::size_t, std::vector<Pressed>> of_body;
  std::map<std::size_t, std::size_t> first_of_module;
  const std::vector<ContactElement> elements = contact_elements(robot, scenario.contact.on);
  bool whole = r.has_states(robot);
  for (std::size_t c = 0; c < elements.size(); ++c) {
    const auto column = [&](const char* name) { return r.series(fmt::format("contact.{}.{}", c, name)); };
    const Pressed one{elements[c], column("fn"), column("fx"), column("fy"), column("fz")};
    for (const Series* each : {&one.fn, &one.fx, &one.fy, &one.fz}) whole = whole && !each->empty();
    of_body[elements[c].body].push_back(one);
    first_of_module.emplace(robot.bodies[elements[c].body].module, elements[c].body);
  }
  std::vector<Foot> found;
  Kinematics k(robot);
  for (const auto& [body, pressed] : of_body) {
    if (whole) found.push_back(foot_of(scenario, r, body, pressed, k));
  }
  for (const auto& [module, body] : first_of_module) {
    const Series load = r.series(fmt::format("load.{}", module));
    if (!whole && !load.empty()) found.push_back({robot.bodies[body].name, module, body, {}, {}, load.values(), {}, {}, {}});
  }
  std::erase_if(found, [](const Foot& foot) { return !carries(foot); });
  return found;
}

}  // namespace gaitlab::report
