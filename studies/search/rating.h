// Rating of a point for a search: its fitness, and the numbers that the models use.
#pragma once
#include <limits>
#include <vector>

namespace gaitlab::studies {

/// Coordinates of a point, or values of the objectives.
using Vector = std::vector<double>;

struct Rating {
  Vector fitness;  ///< finite numbers by objective; smaller is better
  /// First objective, negated for maximisation. NaN if not known.
  double objective = std::numeric_limits<double>::quiet_NaN();
  double violation = std::numeric_limits<double>::quiet_NaN();  ///< NaN for a failed point
  [[nodiscard]] bool kept() const { return violation == 0; }
};

/// A point that a search has run. Its coordinates are shares of the box.
struct Rated {
  Vector point;
  Rating rating;
};

}  // namespace gaitlab::studies
