// Purpose numbers of random draws, which are hashes of counters and names and therefore independent of earlier runs.
#pragma once
#include <cstdint>

namespace gaitlab::studies {

/// Purpose number for draws of searches. Draws of points have the purposes 1 to 3.
inline constexpr std::uint64_t kSearchDraw = 4;
/// Purpose number for the choice of points whose torque error is estimated.
inline constexpr std::uint64_t kEstimateDraw = 5;

}  // namespace gaitlab::studies
