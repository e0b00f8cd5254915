// Gaussian processes against the textbook's formulas, written with an inverse matrix, and against functions that they must
// find.
#include "studies/search/gaussian_process.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/random.h"

namespace gaitlab::studies {
namespace {

Eigen::MatrixXd cube_points(Eigen::Index count, Eigen::Index coordinates, std::uint64_t stream) {
  Eigen::MatrixXd points(count, coordinates);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index c = 0; c < coordinates; ++c)
      points(i, c) = math::uniform({stream, static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(c)});
  }
  return points;
}

Eigen::VectorXd wave(const Eigen::MatrixXd& points) { return (3 * points.col(0).array()).sin() + 0.5 * points.col(1).array(); }

/// Covariance of two points (Rasmussen and Williams 2006, eq. 4.17 with nu = 5/2), with the standard library's functions.
double textbook_pair(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& length) {
  const double r = std::sqrt(5.0) * ((a - b).cwiseQuotient(length)).norm();
  return (1 + r + r * r / 3) * std::exp(-r);
}

Eigen::MatrixXd textbook(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& length) {
  Eigen::MatrixXd all(a.rows(), b.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < b.rows(); ++j) all(i, j) = textbook_pair(a.row(i).transpose(), b.row(j).transpose(), length);
  }
  return all;
}

/// Mean and covariance of the posterior by eq. 2.25 and 2.26, for values with mean 0 and deviation 1 that are scaled back.
struct Posterior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Posterior(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, const Eigen::MatrixXd& at, const GaussianProcess::Hyper& h) {
    const double middle = y.mean();
    const double scale = std::sqrt((y.array() - middle).square().mean());
    const Eigen::MatrixXd of_values =
        (textbook(x, x, h.length) + h.noise * Eigen::MatrixXd::Identity(x.rows(), x.rows())).inverse();
    const Eigen::MatrixXd across = textbook(at, x, h.length);
    mean = (middle + (across * of_values * (y.array() - middle).matrix()).array()).matrix();
    covariance = scale * scale * (textbook(at, at, h.length) - across * of_values * across.transpose());
  }
};

TEST(GaussianProcess, IsTheTextbooks) {
  const Eigen::MatrixXd x = cube_points(30, 2, 1);
  const Eigen::VectorXd y = wave(x);
  const Eigen::MatrixXd at = cube_points(6, 2, 2);
  const GaussianProcess process(x, y);
  const Posterior expected(x, y, at, process.hyper());
  EXPECT_LT((process.mean(at) - expected.mean).cwiseAbs().maxCoeff(), 1e-8) << "rounding of an inverse of condition 1e4";

  constexpr std::size_t kDraws = 20000;
  const Eigen::MatrixXd draws = process.samples(at, kDraws, 4);
  const Eigen::MatrixXd deviation = draws.colwise() - expected.mean;
  const Eigen::MatrixXd covariance = deviation * deviation.transpose() / static_cast<double>(kDraws);
  const double most = expected.covariance.cwiseAbs().maxCoeff();
  // The tolerance is five standard errors of a covariance of n normal numbers, 5 sqrt(2 / n) of the largest variance.
  EXPECT_LT((covariance - expected.covariance).cwiseAbs().maxCoeff(), 5 * std::sqrt(2.0 / kDraws) * most);
}

TEST(GaussianProcess, FindsAFunctionAndItsLengths) {
  const Eigen::MatrixXd x = cube_points(60, 3, 5);
  const GaussianProcess process(x, wave(x));  // the third coordinate has no effect
  const Eigen::MatrixXd at = cube_points(200, 3, 7);
  EXPECT_LT((process.mean(at) - wave(at)).cwiseAbs().maxCoeff(), 0.1) << "a fifteenth of its range";
  EXPECT_GT(process.hyper().length[2], 2 * process.hyper().length[0]);
  EXPECT_LT(process.hyper().noise, 0.01);
}

TEST(GaussianProcess, FindsNoise) {
  const Eigen::MatrixXd x = cube_points(100, 2, 8);
  Eigen::VectorXd y = wave(x);
  for (Eigen::Index k = 0; k < y.size(); ++k) y[k] += 0.3 * math::normal({9, static_cast<std::uint64_t>(k)});
  const double share = 0.09 / (y.array() - y.mean()).square().mean();
  const GaussianProcess process(x, y);
  EXPECT_GT(process.hyper().noise, share / 3);
  EXPECT_LT(process.hyper().noise, share * 3);
}

TEST(GaussianProcess, IsAFunctionOfItsArguments) {
  const Eigen::MatrixXd x = cube_points(40, 2, 11);
  const Eigen::MatrixXd at = cube_points(50, 2, 12);
  const GaussianProcess one(x, wave(x));
  const GaussianProcess two(x, wave(x));
  EXPECT_EQ(one.samples(at, 3, 14), two.samples(at, 3, 14)) << "bits";
  EXPECT_NE(one.samples(at, 3, 14), one.samples(at, 3, 15));
}

/// Eigen divides products into blocks by the sizes of the caches. Without fixed sizes, a machine with smaller caches would give
/// other bits.
TEST(GaussianProcess, HasTheSameBitsWithOtherCaches) {
  const Eigen::MatrixXd x = cube_points(200, 4, 20);
  const Eigen::MatrixXd at = cube_points(400, 4, 21);
  const Eigen::MatrixXd here = GaussianProcess(x, wave(x)).samples(at, 2, 22);
  Eigen::setCpuCacheSizes(4 << 10, 16 << 10, 64 << 10);
  EXPECT_EQ(GaussianProcess(x, wave(x)).samples(at, 2, 22), here);
}

TEST(GaussianProcess, BearsEqualPointsAndEqualValues) {
  Eigen::MatrixXd x = cube_points(8, 2, 16);
  x.row(3) = x.row(2);
  const GaussianProcess flat(x, Eigen::VectorXd::Constant(8, 2.5));
  EXPECT_NEAR(flat.mean(x)[0], 2.5, 1e-12);
  EXPECT_TRUE(flat.samples(x, 2, 18).allFinite());
  const GaussianProcess only(x.topRows(1), Eigen::VectorXd::Constant(1, 1.0));
  EXPECT_NEAR(only.mean(x)[5], 1, 1e-12);
}

}  // namespace
}  // namespace gaitlab::studies
