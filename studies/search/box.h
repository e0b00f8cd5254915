// Coordinates of a search, as shares of the ranges of its parameters.
#pragma once
#include <cmath>

#include "studies/search/rating.h"

namespace gaitlab::studies {

/// Point mirrored at the faces of the unit cube, with a resolution of 1e-9.
inline Vector within_box(Vector point) {
  constexpr double kDigits = 1e9;
  for (double& c : point) {
    const double folded = std::abs(std::fmod(c, 2.0));
    c = std::round(kDigits * (folded > 1 ? 2 - folded : folded)) / kDigits;
  }
  return point;
}

}  // namespace gaitlab::studies
