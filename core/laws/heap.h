// Heaps of boxes: many boxes in one place. No touch needs so many boxes, and searches in a heap take long.
#pragma once
#include <cstddef>
#include <optional>

#include "core/laws/boxes.h"

namespace gaitlab {

/// Largest number of boxes that may contain one position. A touch combines at most four.
inline constexpr std::size_t kMostInOnePlace = 100;

/// Number of boxes that contain a position, up to kMostInOnePlace + 1.
std::size_t boxes_at(const Boxes& boxes, const Vec3& place);

/// First box whose centre is in more than kMostInOnePlace boxes.
std::optional<std::size_t> first_in_heap(const Boxes& boxes);

/// Largest number of boxes that contain the centre of one of them, up to kMostInOnePlace + 1.
std::size_t most_in_one_place(const Boxes& boxes);

}  // namespace gaitlab
