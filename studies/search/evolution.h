// A population that evolves by an algorithm of pagmo, while the caller evaluates each generation.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "studies/study/study.h"

namespace gaitlab::studies {

/// Coordinates of a point, or values of the objectives.
using Vector = std::vector<double>;

struct EvolutionSettings {
  Method algorithm = Method::cma;  ///< one of the search methods
  Vector low, high;                ///< lower and upper corner of the box; the algorithm may leave the box
  unsigned seed = 1;
  double sigma = 0.25;  ///< first step of cma and xnes, as a share of the box
  /// The first population with its objective values. A smaller value is better, and no value is NaN.
  std::vector<Vector> points, values;
};

/// An evolving population, for alternate calls of ask() and tell(). Points and end agree bit for bit with pagmo's serial
/// evolution. A copy first evolves with a problem that records the requested points. When the values of these points are known,
/// the generation evolves again.
class Evolution {
 public:
  virtual ~Evolution() = default;
  /// The points of the next generation. Empty if the algorithm has ended.
  virtual std::vector<Vector> ask() = 0;
  /// Sets the values of the points from ask(). Throws RunError if a point of the generation depends on the value of another
  /// point.
  virtual void tell(const std::vector<Vector>& values) = 0;
  /// Points of the present population.
  [[nodiscard]] virtual std::vector<Vector> points() const = 0;
  [[nodiscard]] virtual std::vector<Vector> values() const = 0;
};

std::unique_ptr<Evolution> evolution(const EvolutionSettings& settings);

/// Name and version of the library, such as `pagmo 2.18.0`. Other versions may choose other points.
const char* evolution_library();

}  // namespace gaitlab::studies
