#include "studies/search/gaussian_process.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math/functions.h"
#include "core/math/random.h"

namespace gaitlab::studies {

namespace {

constexpr double kLeastLength = 0.05, kMostLength = 2;  // shares of the cube
constexpr double kLeastNoise = 1e-4, kMostNoise = 0.3;  // shares of the variance of the values

/// Squared distances of the rows of a from those of b.
Eigen::MatrixXd squared_distances(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd d = -2 * a * b.transpose();
  d.colwise() += a.rowwise().squaredNorm();
  d.rowwise() += b.rowwise().squaredNorm().transpose();
  return d;
}

double matern(double squared) {
  const double r = std::sqrt(5 * std::max(0.0, squared));
  return (1 + r + r * r / 3) * math::exp(-r);
}

/// Sets the cache sizes that Eigen uses to compute the blocks of a product. The sizes of the processor's caches would make the
/// rounding errors of products, and thus the points of a search, depend on the machine.
void fix_blocks() {
  constexpr std::ptrdiff_t kFirst = 32 << 10;
  constexpr std::ptrdiff_t kSecond = 256 << 10;
  constexpr std::ptrdiff_t kThird = 2 << 20;
  Eigen::setCpuCacheSizes(kFirst, kSecond, kThird);
}

/// Lower factor of a covariance that may be singular within rounding.
Eigen::MatrixXd lower_factor(Eigen::MatrixXd covariance) {
  constexpr std::array kJitters{1e-8, 1e-6, 1e-4, 1e-2};
  for (const double jitter : kJitters) {
    covariance.diagonal().array() += jitter;
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    if (factor.info() == Eigen::Success) return factor.matrixL();
  }
  return covariance.diagonal().cwiseMax(0).cwiseSqrt().asDiagonal();
}

}  // namespace

GaussianProcess::GaussianProcess(Eigen::MatrixXd points, const Eigen::VectorXd& values)
    : points_(std::move(points)), mean_(values.mean()) {
  fix_blocks();
  values_ = values.array() - mean_;
  scale_ = std::sqrt(values_.squaredNorm() / static_cast<double>(values_.size()));
  if (!(scale_ > 0)) scale_ = 1;
  values_ /= scale_;
  choose();
}

void GaussianProcess::choose() {
  constexpr std::array kLengths{0.1, 0.2, 0.4, 0.8};
  constexpr std::array kNoises{1e-3, 3e-2};
  constexpr int kPasses = 2;
  const Eigen::Index d = points_.cols();
  Hyper best;
  double most = -std::numeric_limits<double>::infinity();
  const auto try_one = [&](const Hyper& hyper) {
    const double likelihood = factor(hyper);
    const bool better = best.length.size() == 0 || likelihood > most;
    if (!better) return false;
    most = likelihood;
    best = hyper;
    return true;
  };
  for (const double length : kLengths) {
    for (const double noise : kNoises) try_one({Eigen::VectorXd::Constant(d, length), noise});
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    for (Eigen::Index c = 0; c <= d; ++c) {
      for (const bool up : {true, false}) {
        Hyper moved = best;
        double& number = c < d ? moved.length[c] : moved.noise;
        const double by = c < d ? 2 : 5;
        number =
            std::clamp(up ? number * by : number / by, c < d ? kLeastLength : kLeastNoise, c < d ? kMostLength : kMostNoise);
        if (try_one(moved)) break;
      }
    }
  }
  factor(best);
}

double GaussianProcess::factor(const Hyper& hyper) {
  hyper_ = hyper;
  const Eigen::MatrixXd scaled = points_ * hyper.length.cwiseInverse().asDiagonal();
  Eigen::MatrixXd k = squared_distances(scaled, scaled);
  for (Eigen::Index j = 0; j < k.cols(); ++j) {
    for (Eigen::Index i = j; i < k.rows(); ++i) k(i, j) = matern(k(i, j));  // the lower triangle is all that LLT reads
    k(j, j) = 1 + hyper.noise;
  }
  factor_.compute(k);
  weights_ = factor_.solve(values_);
  return -0.5 * values_.dot(weights_) - factor_.matrixLLT().diagonal().unaryExpr([](double x) { return math::log(x); }).sum();
}

Eigen::MatrixXd GaussianProcess::covariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const {
  const auto scale = hyper_.length.cwiseInverse().asDiagonal();
  return squared_distances(a * scale, b * scale).unaryExpr([](double x) { return matern(x); });
}

Eigen::VectorXd GaussianProcess::mean(const Eigen::MatrixXd& at) const {
  return (mean_ + scale_ * (covariance(at, points_) * weights_).array()).matrix();
}

Eigen::MatrixXd GaussianProcess::samples(const Eigen::MatrixXd& at, std::size_t count, std::uint64_t stream) const {
  const Eigen::MatrixXd across = covariance(points_, at);
  const Eigen::MatrixXd known = factor_.matrixL().solve(across);
  const Eigen::MatrixXd factor = lower_factor(covariance(at, at) - known.transpose() * known);
  Eigen::MatrixXd normal(at.rows(), static_cast<Eigen::Index>(count));
  for (Eigen::Index j = 0; j < normal.cols(); ++j) {
    for (Eigen::Index i = 0; i < normal.rows(); ++i)
      normal(i, j) = math::normal({stream, static_cast<std::uint64_t>(j), static_cast<std::uint64_t>(i)});
  }
  Eigen::MatrixXd drawn = factor * normal;
  drawn.colwise() += across.transpose() * weights_;
  return (mean_ + scale_ * drawn.array()).matrix();
}

}  // namespace gaitlab::studies
