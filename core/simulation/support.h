// Support polygon: the contact elements that carry a robot, and the margin of its centre of mass within them.
#pragma once
#include <span>
#include <vector>

#include "core/model/frames.h"

namespace gaitlab {

/// An element above the ground: its height, m, and its place, world.
struct SupportElement {
  std::size_t element = 0;
  double gap = 0;
  Vec3 point = Vec3::Zero();
};

/// The lowest elements whose support polygon (convex hull seen from above) contains the centre of mass, and all within 1 mm
/// above the last of them; if no polygon contains it, the elements within 1 mm of the lowest. Sorted by height, then element.
std::vector<SupportElement> support_elements(std::vector<SupportElement> elements, const Vec3& com);

/// Distance of `com` from the edge of the support polygon (the convex hull of the points), seen from above, m: positive inside,
/// negative outside, also for a line or a point. NaN: no points.
double support_margin(std::span<const Vec3> points, const Vec3& com);

}  // namespace gaitlab
