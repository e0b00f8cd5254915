#include "core/model/hull_shape.h"

#include <limits>
#include <memory>
#include <utility>

namespace gaitlab {

std::optional<Shape> hull_shape(const Pose& in_body, std::span<const Vec3> points) {
  Hull hull = convex_hull(points);
  if (hull.faces.empty()) return {};
  Vec3 mean = Vec3::Zero();
  for (const Vec3& corner : hull.corners) mean += corner / static_cast<double>(hull.corners.size());
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (Vec3& corner : hull.corners) {
    corner -= mean;
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  for (Hull::Face& face : hull.faces) face.offset -= face.normal.dot(mean);
  return Shape{Shape::Kind::hull, {in_body.R, in_body * mean}, high - low, std::make_shared<const Hull>(std::move(hull))};
}

Solid solid(const Hull& hull) {
  Solid sum;
  for (const Hull::Face& face : hull.faces) {
    for (std::size_t k = 2; k < face.corners.size(); ++k) {
      const Vec3& a = hull.corners[face.corners[0]];
      const Vec3& b = hull.corners[face.corners[k - 1]];
      const Vec3& c = hull.corners[face.corners[k]];
      const double volume = a.dot(b.cross(c)) / 6;
      const Vec3 s = a + b + c;
      sum.volume += volume;
      sum.centre += volume / 4 * s;
      sum.second += volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
  }
  sum.centre /= sum.volume;
  sum.second -= sum.volume * sum.centre * sum.centre.transpose();
  return sum;
}

}  // namespace gaitlab
