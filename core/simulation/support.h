// Which contact elements a robot stands on, and how far its centre of mass is within them.
#pragma once
#include <span>
#include <vector>

#include "core/model/frames.h"

namespace gaitlab {

/// An element over the ground: its height above it, m, and where it is, world.
struct SupportElement {
  std::size_t element = 0;
  double gap = 0;
  Vec3 point = Vec3::Zero();
};

/// The lowest elements whose support polygon (convex hull seen from above) holds the centre of mass, and all within 1 mm above
/// the last of them; where no polygon holds it, the lowest within 1 mm. Sorted by height, then element.
std::vector<SupportElement> support_elements(std::vector<SupportElement> elements, const Vec3& com);

/// m: how far `com` is inside the edge of the support polygon (the convex hull of the points), seen from above; outside of it,
/// and of a line or a point, the distance is negative. NaN: no points.
double support_margin(std::span<const Vec3> points, const Vec3& com);

}  // namespace gaitlab
