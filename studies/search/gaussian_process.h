// Gaussian process regression: a model of a function on the unit cube from noisy values at points.
#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>

namespace gaitlab::studies {

/// Model of a function of d coordinates from its values at n points (Rasmussen and Williams 2006, eq. 2.22 to 2.30, 4.17):
///     f = m + s g,  g ~ GP(0, k),  value = f + s e,  e ~ N(0, noise)
///     k(a, b) = (1 + r + r^2 / 3) exp(-r),  r^2 = 5 sum_i (a_i - b_i)^2 / length_i^2     (Matern 5/2)
/// m and s are mean and standard deviation of the values. Lengths (0.05 to 2) and noise (1e-4 to 0.3) are those with the
/// largest likelihood among at most 8 + 4 (d + 1) tries: first with equal lengths, then with one number at a time multiplied or
/// divided by a factor. The time is O(n^3) per try.
class GaussianProcess {
 public:
  /// `points` is n x d with n >= 1, `values` has n finite numbers.
  GaussianProcess(Eigen::MatrixXd points, const Eigen::VectorXd& values);

  /// Expected values of f at the rows of `at`.
  [[nodiscard]] Eigen::VectorXd mean(const Eigen::MatrixXd& at) const;
  /// `count` functions drawn from the posterior of f: one column per function, one row per row of `at`.
  [[nodiscard]] Eigen::MatrixXd samples(const Eigen::MatrixXd& at, std::size_t count, std::uint64_t stream) const;

  struct Hyper {
    Eigen::VectorXd length;  ///< lengths by coordinate
    double noise;            ///< variance of e
  };
  [[nodiscard]] const Hyper& hyper() const { return hyper_; }

 private:
  /// Sets the factorisation for these lengths and this noise. Returns the logarithm of the likelihood, without its constant.
  double factor(const Hyper& hyper);
  void choose();
  [[nodiscard]] Eigen::MatrixXd covariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const;

  Eigen::MatrixXd points_;
  double mean_ = 0, scale_ = 1;
  Eigen::VectorXd values_;  ///< values with mean 0 and deviation 1
  Hyper hyper_;
  Eigen::LLT<Eigen::MatrixXd> factor_;  ///< factor of the covariance of the values
  Eigen::VectorXd weights_;             ///< inverse of this covariance times the values
};

}  // namespace gaitlab::studies
