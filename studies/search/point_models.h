// Models of a study's objective and violation, learnt from the points that a search has run.
#pragma once
#include <span>

#include "studies/search/gaussian_process.h"
#include "studies/search/rating.h"

namespace gaitlab::studies {

/// Two Gaussian processes, of the objective and of log(0.01 + violation), from the 200 points nearest to a centre. The distance
/// is the largest difference in a coordinate. Objectives far from those of kept points are clipped, so that a robot that is
/// thrown does not decide the scale. A failed point has no objective, and a violation of 10.
class PointModels {
 public:
  /// `centre` has d coordinates. At least one point has a known objective.
  PointModels(std::span<const Rated> points, const Vector& centre);

  /// Order of candidates, best first, from the objective and the violation's logarithm of each: first those with an acceptable
  /// violation, sorted by objective, then the others, sorted by violation.
  [[nodiscard]] static std::vector<std::size_t> order(const Eigen::VectorXd& objective, const Eigen::VectorXd& violation);

  [[nodiscard]] const GaussianProcess& objective() const { return objective_; }
  [[nodiscard]] const GaussianProcess& violation() const { return violation_; }

 private:
  struct Data;
  explicit PointModels(const Data& data);

  GaussianProcess objective_, violation_;
};

/// True if the objective of at least two points is known, so that they have a model.
bool have_models(std::span<const Rated> points);

/// Points as rows of a matrix.
Eigen::MatrixXd matrix_of(std::span<const Vector> points);

}  // namespace gaitlab::studies
