// A population that evolves generation by generation, with external evaluation, by the algorithms of pagmo.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "studies/study/study.h"

namespace gaitlab::studies {

/// Coordinates, or the values of the objectives.
using Vector = std::vector<double>;

struct EvolutionSettings {
  Method algorithm = Method::cma;  ///< one of the searches
  Vector low, high;                ///< the box; searches may exceed it
  unsigned seed = 1;
  double sigma = 0.25;  ///< first step of cma and xnes, as a share of the box
  /// The first population with its values; smaller is better. No value is NaN.
  std::vector<Vector> points, values;
};

/// Alternate ask() and tell(). The points and the end are those of pagmo's serial evolution, bit for bit: a generation is
/// evolved on a copy with a problem that records its requests, and again when the values are known.
class Evolution {
 public:
  virtual ~Evolution() = default;
  /// The points of the next generation; none: the algorithm ends here.
  virtual std::vector<Vector> ask() = 0;
  /// Sets the values of these points. Throws RunError if a point of the generation depends on the value of another.
  virtual void tell(const std::vector<Vector>& values) = 0;
  /// Points of the population.
  [[nodiscard]] virtual std::vector<Vector> points() const = 0;
  [[nodiscard]] virtual std::vector<Vector> values() const = 0;
};

std::unique_ptr<Evolution> evolution(const EvolutionSettings& settings);

/// `pagmo 2.18.0`: other versions may choose other points.
const char* evolution_library();

}  // namespace gaitlab::studies
