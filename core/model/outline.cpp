#include "core/model/outline.h"

#include "core/model/kinematics.h"
#include "core/model/solid.h"

namespace gaitlab {

namespace {

/// Shapes of the robot in the base frame, as one list per module.
std::vector<std::vector<Shape>> shapes_of_modules(const Robot& robot) {
  const Kinematics zero = at_zero(robot);
  std::vector<std::vector<Shape>> all(robot.modules.size());
  for (const Body& body : robot.bodies) {
    const Pose pose = Pose{zero.R[body.link], zero.p[body.link]} * body.in_link;
    for (const Shape& shape : robot.types[robot.modules[body.module].type].bodies[body.type].shapes) {
      all[body.module].push_back(shape);
      all[body.module].back().in_body = pose * shape.in_body;
    }
  }
  return all;
}

Vec3 edges(const std::vector<Shape>& shapes) {
  if (shapes.empty()) return Vec3::Zero();
  const auto [low, high] = bounds(shapes);
  return high - low;
}

}  // namespace

Vec3 outline_edges(const Robot& robot) {
  std::vector<Shape> all;
  for (const std::vector<Shape>& shapes : shapes_of_modules(robot)) all.insert(all.end(), shapes.begin(), shapes.end());
  return edges(all);
}

std::vector<Vec3> outline_edges_of_modules(const Robot& robot) {
  std::vector<Vec3> all;
  for (const std::vector<Shape>& shapes : shapes_of_modules(robot)) all.push_back(edges(shapes));
  return all;
}

}  // namespace gaitlab
