// Which contact elements a robot stands on.
#pragma once
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

}  // namespace gaitlab
