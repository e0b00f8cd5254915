#include "core/dynamics/body_tree.h"

#include "core/model/docking.h"

namespace gaitlab {

namespace {

/// The body of `module` that is part of `link`; there is at most one, because hinges are between links.
std::size_t body_on(const Robot& robot, std::size_t module, std::size_t link) {
  std::size_t body = robot.modules[module].first_body;
  while (robot.bodies[body].link != link) ++body;
  return body;
}

Attachment attachment(const Robot& robot, std::size_t b) {
  const Body& body = robot.bodies[b];
  const Module& module = robot.modules[body.module];
  if (b != module.reference) {
    const Link& link = robot.links[body.link];
    return {Attachment::Kind::hinge, body_on(robot, body.module, static_cast<std::size_t>(link.parent)),
            static_cast<std::size_t>(link.joint), Vec3::Zero()};
  }
  if (module.parent < 0) return {Attachment::Kind::base, b, 0, Vec3::Zero()};
  const Module& parent = robot.modules[static_cast<std::size_t>(module.parent)];
  const FaceType& own_face = *find_face(robot.types[module.type], module.dock.child_face);
  const FaceType& face = *find_face(robot.types[parent.type], module.dock.parent_face);
  return {Attachment::Kind::dock, parent.first_body + face.body, body.module, body.in_link * own_face.origin};
}

}  // namespace

std::string dock_name(std::size_t module) { return "m" + std::to_string(module) + "/dock"; }

BodyTree::BodyTree(const Robot& robot) {
  std::vector<std::vector<std::size_t>> children(robot.bodies.size());
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    attachments.push_back(attachment(robot, b));
    if (attachments[b].kind != Attachment::Kind::base) children[attachments[b].parent].push_back(b);
  }
  order.push_back(robot.modules[0].reference);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::vector<std::size_t>& next = children[order[i]];
    order.insert(order.end(), next.begin(), next.end());
  }
}

}  // namespace gaitlab
