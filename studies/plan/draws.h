// Random numbers by counter and names by content: the draws of a run depend only on its number, not on earlier runs.
#pragma once
#include <cstdint>

namespace gaitlab::studies {

/// The draws of searches (points have 1 to 3).
inline constexpr std::uint64_t kSearchDraw = 4;
/// The choice of points whose torque error is estimated.
inline constexpr std::uint64_t kEstimateDraw = 5;

}  // namespace gaitlab::studies
