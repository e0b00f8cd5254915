// A population that evolves, while the caller evaluates each generation.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "studies/search/rating.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

struct EvolutionSettings {
  Method algorithm = Method::cma;  ///< one of the search methods
  Vector low, high;                ///< lower and upper corner of the box; the algorithm may leave the box
  unsigned seed = 1;
  double sigma = 0.25;  ///< first step of cma and xnes, as a share of the box
  /// The first population with its objective values. A smaller value is better, and no value is NaN.
  std::vector<Vector> points, values;
  /// For methods with models: all points of the search so far, and the number of points before the present restart.
  const std::vector<Rated>* rated = nullptr;
  std::size_t since = 0;
};

/// An evolving population, for alternate calls of ask() and tell().
class Evolution {
 public:
  virtual ~Evolution() = default;
  /// The points of the next generation. Empty if the algorithm has ended.
  virtual std::vector<Vector> ask() = 0;
  /// Sets the values of the points from ask(). Throws RunError if a point of the generation depends on the value of another
  /// point.
  virtual void tell(const std::vector<Vector>& values) = 0;
};

/// Evolution by an algorithm of pagmo, bit for bit as pagmo's serial one. A copy of the population first evolves with a problem
/// that records the requested points. When the values of these points are known, the generation evolves again.
class PagmoEvolution : public Evolution {
 public:
  /// Points of the present population, and their values.
  [[nodiscard]] virtual std::vector<Vector> points() const = 0;
  [[nodiscard]] virtual std::vector<Vector> values() const = 0;
};

/// `settings.algorithm` is one of cma, xnes, sade, pso, nsga2.
std::unique_ptr<PagmoEvolution> pagmo_evolution(const EvolutionSettings& settings);

/// Name and version of the library, such as `pagmo 2.18.0`. Other versions may choose other points.
const char* evolution_library();

}  // namespace gaitlab::studies
