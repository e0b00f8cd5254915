// Support polygon: the contact elements that carry a robot, and the margin of its centre of mass within them.
#pragma once
#include <span>
#include <vector>

#include "core/model/frames.h"

namespace gaitlab {

/// A contact element, its height `gap` above the ground, m, and its position in the world, m.
struct SupportElement {
  std::size_t element = 0;
  double gap = 0;
  Vec3 point = Vec3::Zero();
};

/// Elements that carry the robot, sorted by height, then element. They are the fewest lowest elements whose support polygon
/// (convex hull seen from above) contains the centre of mass, and all elements up to 1 mm higher. If no polygon contains the
/// centre of mass, they are the elements within 1 mm of the lowest.
std::vector<SupportElement> support_elements(std::vector<SupportElement> elements, const Vec3& com);

/// Distance of `com` from the edge of the support polygon (the convex hull of the points), seen from above, m. It is positive
/// inside and negative outside, also for a line or a point. NaN without points.
double support_margin(std::span<const Vec3> points, const Vec3& com);

}  // namespace gaitlab
