#include "core/model/outline.h"

#include "core/model/kinematics.h"
#include "core/model/solid.h"

namespace gaitlab {

Vec3 outline_edges(const Robot& robot, std::optional<std::size_t> module) {
  const Kinematics zero = at_zero(robot);
  std::vector<Shape> shapes;
  for (const Body& body : robot.bodies) {
    if (module && body.module != *module) continue;
    const Pose pose = Pose{zero.R[body.link], zero.p[body.link]} * body.in_link;
    for (const Shape& shape : robot.types[robot.modules[body.module].type].bodies[body.type].shapes)
      shapes.push_back({shape.kind, pose * shape.in_body, shape.size});
  }
  if (shapes.empty()) return Vec3::Zero();
  const auto [low, high] = bounds(shapes);
  return high - low;
}

}  // namespace gaitlab
