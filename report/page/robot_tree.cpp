#include "report/page/robot_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <tuple>

#include "core/model/docking.h"
#include "core/model/role.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

std::string key_of(const ModuleType& type, std::size_t body) { return type.name + "/" + type.bodies[body].name; }

/// Number of docks between a module and the first one.
std::size_t docks_away(const Robot& robot, std::size_t module) {
  std::size_t count = 0;
  for (int parent = robot.modules[module].parent; parent >= 0; ++count)
    parent = robot.modules[static_cast<std::size_t>(parent)].parent;
  return count;
}

}  // namespace

Json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json json_of(const Pose& pose) {
  const Quat q(pose.R);
  return {pose.p.x(), pose.p.y(), pose.p.z(), q.w(), q.x(), q.y(), q.z()};
}

namespace {

Json json_of_shape(const Shape& shape) {
  Json made{{"kind", name_of(shape.kind)}, {"pose", json_of(shape.in_body)}, {"size", json_of(shape.size)}};
  if (shape.kind != Shape::Kind::hull) return made;
  for (const Vec3& corner : shape.hull->corners) made["corners"].push_back(json_of(corner));
  for (const Hull::Face& face : shape.hull->faces) made["faces"].push_back(face.corners);
  return made;
}

}  // namespace

RobotTree::RobotTree(const Robot& robot) : robot_(robot), order_(robot.bodies.size()), place_(robot.bodies.size()) {
  // Parent links come first. Within a link, a module comes after the module that it is docked to.
  std::vector<std::size_t> away;
  for (std::size_t m = 0; m < robot.modules.size(); ++m) away.push_back(docks_away(robot, m));
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::sort(order_, {}, [&](std::size_t b) {
    const Body& body = robot.bodies[b];
    return std::tuple(body.link, away[body.module], b);
  });
  for (std::size_t i = 0; i < order_.size(); ++i) place_[order_[i]] = i;
}

/// Body of a module in a link. There is only one, because a hinge separates any two bodies of a module.
std::size_t RobotTree::body_in(std::size_t module, std::size_t link) const {
  std::size_t body = robot_.modules[module].first_body;
  while (robot_.bodies[body].link != link) ++body;
  return body;
}

std::size_t RobotTree::moved_by(std::size_t joint) const {
  return body_in(robot_.joints[joint].module, robot_.joints[joint].link);
}

RobotTree::Hung RobotTree::hung(std::size_t b) const {
  const Body& body = robot_.bodies[b];
  const Module& module = robot_.modules[body.module];
  if (b != module.reference) {
    const Link& link = robot_.links[body.link];
    const std::size_t parent = body_in(body.module, static_cast<std::size_t>(link.parent));
    return {static_cast<int>(parent), link.joint, robot_.bodies[parent].in_link.inverse() * link.in_parent, body.in_link,
            link.axis};
  }
  if (module.parent < 0) return {.post = body.in_link};
  const Module& on = robot_.modules[static_cast<std::size_t>(module.parent)];
  const std::vector<FaceType>& faces = robot_.types[on.type].faces;
  const auto face = std::ranges::find(faces, module.dock.parent_face, &FaceType::id);
  const std::size_t parent = on.first_body + face->body;
  return {.parent = static_cast<int>(parent), .pre = robot_.bodies[parent].in_link.inverse() * body.in_link};
}

Json RobotTree::bodies() const {
  Json all = Json::array();
  for (const std::size_t b : order_) {
    const Body& body = robot_.bodies[b];
    const ModuleType& type = robot_.types[robot_.modules[body.module].type];
    const Hung at = hung(b);
    all.push_back({{"name", body.name},
                   {"module", body.module},
                   {"type", key_of(type, body.type)},
                   {"role", name_of(role_of(type, body.type))},
                   {"parent", at.parent < 0 ? Json(-1) : Json(place_[static_cast<std::size_t>(at.parent)])},
                   {"joint", at.joint},
                   {"pre", json_of(at.pre)},
                   {"axis", json_of(at.axis)},
                   {"post", json_of(at.post)}});
  }
  return all;
}

Json RobotTree::geometry() const {
  Json all = Json::object();
  for (const ModuleType& type : robot_.types) {
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
      Json shapes = Json::array();
      for (const Shape& shape : type.bodies[b].shapes) shapes.push_back(json_of_shape(shape));
      all[key_of(type, b)] = shapes;
    }
  }
  return all;
}

Json RobotTree::faces() const {
  Json all = Json::object();
  for (const ModuleType& type : robot_.types) {
    for (std::size_t b = 0; b < type.bodies.size(); ++b) all[key_of(type, b)] = Json::array();
    for (const FaceType& face : type.faces) {
      all[key_of(type, face.body)].push_back({{"id", face.id},
                                              {"gender", name_of(face.gender)},
                                              {"origin", json_of(face.origin)},
                                              {"normal", json_of(face.normal)},
                                              {"reference", json_of(face.reference)}});
    }
  }
  return all;
}

Json RobotTree::docks() const {
  Json all = Json::array();
  for (std::size_t m = 1; m < robot_.modules.size(); ++m) {
    const Dock& dock = robot_.modules[m].dock;
    all.push_back({{"name", fmt::format("m{}", m)},
                   {"module", m},
                   {"parent", dock.parent_module},
                   {"face", dock.child_face},
                   {"parent_face", dock.parent_face}});
  }
  return all;
}

}  // namespace gaitlab::report
