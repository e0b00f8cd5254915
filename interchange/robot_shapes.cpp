#include "interchange/robot_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "core/model/hull.h"
#include "core/model/hull_shape.h"
#include "core/settings/wording.h"
#include "interchange/robot_xml.h"

namespace gaitlab::interchange {

void add_cylinder_along_z(const Pose& pose, double radius, double length, bool capsule, std::vector<Shape>& shapes) {
  for (const double side : {-0.5, 0.5}) {
    if (capsule) shapes.push_back({Shape::Kind::sphere, {pose.R, pose * Vec3(0, 0, side * length)}, {radius, 0, 0}});
  }
  shapes.push_back({Shape::Kind::cylinder, {pose.R * y_from_z().transpose(), pose.p}, {radius, length, 0}});
}

std::vector<Vec3> ellipsoid_points(const Vec3& radii) {
  constexpr int kParts = 12;  // of an edge
  std::vector<Vec3> points;
  for (int x = -kParts; x <= kParts; ++x) {
    for (int y = std::abs(x) - kParts; y <= kParts - std::abs(x); ++y) {
      const int z = kParts - std::abs(x) - std::abs(y);
      for (const int side : {z, -z}) points.push_back(Vec3(x, y, side).normalized().cwiseProduct(radii));
    }
  }
  return points;
}

void RobotHulls::add(const RobotElement& of, const std::string& what, const Pose& pose, const MeshHull& hull,
                     std::vector<Shape>& shapes, std::vector<RobotNote>& notes) {
  std::optional<Shape> shape = hull_shape(pose, hull.points);
  if (!shape) {
    notes.push_back({of.place, what + ", all points of which are in one plane; it has no shape", true});
    return;
  }
  shapes.push_back(std::move(*shape));
  constexpr double kHollow = 0.5;
  if (const double fill = hull.enclosed / solid(convex_hull(hull.points)).volume; fill < kHollow) {
    ++hollow_;
    if (fill < least_fill_) emptiest_ = of;
    least_fill_ = std::min(least_fill_, fill);
  }
  if (count_++ > 0 && hull.gap <= gap_) return;
  gap_ = hull.gap;
  widest_ = of;
}

void RobotHulls::add_note(const char* body, std::vector<RobotNote>& notes) const {
  if (count_ == 0) return;
  notes.push_back(
      {widest_.place,
       fmt::format("{} the convex hull of at most {} of its points; the widest gap is {:.2g} % of its longest edge, "
                   "in {} {}",
                   count_ == 1 ? fmt::format("1 {} is", one_) : fmt::format("each of {} {} is", count_, several_), kFewPoints,
                   100 * gap_, body, in_quotes(widest_.name)),
       true});
  if (hollow_ == 0) return;
  notes.push_back({emptiest_.place,
                   fmt::format("{} less than half of the hull, whose openings and bays touch as if they were filled; {} {} "
                               "fills {:.0f} %",
                               hollow_ == 1 ? fmt::format("1 {} fills", one_) : fmt::format("{} {} fill", hollow_, several_),
                               body, in_quotes(emptiest_.name), 100 * least_fill_),
                   true});
}

}  // namespace gaitlab::interchange
