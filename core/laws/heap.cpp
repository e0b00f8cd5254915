#include "core/laws/heap.h"

#include <algorithm>

namespace gaitlab {

std::size_t boxes_at(const Boxes& boxes, const Vec3& place) {
  std::size_t found = 0;
  for (const std::uint32_t i : boxes.near(place, 0)) {
    const Box& box = boxes[i];
    const Vec3 local = box.R.transpose() * (place - box.center);
    if ((local.cwiseAbs().array() <= 0.5 * box.size.array()).all() && ++found > kMostInOnePlace) break;
  }
  return found;
}

std::optional<std::size_t> first_in_heap(const Boxes& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes_at(boxes, boxes[i].center) > kMostInOnePlace) return i;
  }
  return {};
}

std::size_t most_in_one_place(const Boxes& boxes) {
  std::size_t most = 0;
  for (const Box& box : boxes) most = std::max(most, boxes_at(boxes, box.center));
  return most;
}

}  // namespace gaitlab
