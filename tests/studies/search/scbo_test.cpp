// Tests of searches with models: they find the best point under a constraint with fewer points than other methods, bear
// failures, and repeat their points.
#include "studies/search/scbo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "studies/search/point_models.h"
#include "studies/search/search.h"

namespace gaitlab::studies {
namespace {

using Rate = Rating (*)(const Vector&);

/// Rating of a value, smaller is better, that is kept if `beyond` is at most 0.
Rating constrained(double value, double beyond) {
  const double violation = beyond > 0 ? beyond / (1 + beyond) : 0;
  return {{violation > 0 ? 1e6 + violation : value}, value, violation};
}

/// The corner (1, 1) is best, but outside the allowed circle about the origin. The best allowed value is -1 at (0.5, 0.5).
Rating inside_a_circle(const Vector& x) { return constrained(-(x[0] + x[1]), 10 * (x[0] * x[0] + x[1] * x[1] - 0.5)); }

/// A function of four coordinates with an allowed valley, along which the value falls to -1 at its end.
Rating in_a_valley(const Vector& x) {
  const double across = std::abs(x[1] - x[0] * x[0]) + std::abs(x[2] - 0.4) + std::abs(x[3] - 0.6);
  return constrained(-x[0] + 0.3 * across, 5 * (across - 0.2));
}

/// Best kept value of `runs` points of a search.
double best_of(Method method, Rate rate, std::size_t dimensions, std::size_t runs, std::uint64_t seed) {
  Search search({.algorithm = method, .dimensions = dimensions, .seed = seed});
  double best = 9;
  for (std::size_t done = 0; done < runs;) {
    std::vector<Rating> ratings;
    for (const Vector& point : search.ask()) {
      ratings.push_back(rate(point));
      if (++done <= runs && ratings.back().kept()) best = std::min(best, ratings.back().objective);
    }
    if (ratings.empty()) break;
    search.tell(ratings);
  }
  return best;
}

double median_of(Method method, Rate rate, std::size_t dimensions, std::size_t runs) {
  std::vector<double> best;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) best.push_back(best_of(method, rate, dimensions, runs, seed));
  std::ranges::sort(best);
  return best[1];
}

/// The measured median of three seeds is -0.9966.
TEST(Scbo, FindsTheBestOfABoxUnderAConstraint) { EXPECT_LT(median_of(Method::scbo, inside_a_circle, 2, 80), -0.99); }

/// The measured medians are -0.969 and -0.437. Every seed of scbo (worst -0.936) is better than the best of cma (-0.858).
TEST(Scbo, IsBetterThanCmaWhereRunsAreFew) {
  const double found = median_of(Method::scbo, in_a_valley, 4, 128);
  EXPECT_LT(found, -0.9);
  EXPECT_LT(found, median_of(Method::cma, in_a_valley, 4, 128));
}

/// The measured medians are -0.896 and -0.716, and -0.688 without preselection. Results of single seeds overlap, so that the
/// test applies only to the three seeds of median_of.
TEST(CmaGp, IsBetterThanCmaWhereRunsAreFew) {
  EXPECT_LT(median_of(Method::cma_gp, in_a_valley, 4, 240), median_of(Method::cma, in_a_valley, 4, 240));
}

/// If all points fail, there is no model and no preselection. CMA-ES alone must then find the best point of an ellipsoid with
/// axes of 1 : 30. With 27 of 30 seeds it does, after a median of 1120 points; pagmo's cmaes does with 29, after 1140. The
/// others end because 19 generations did not improve the best point. The test uses seed 1.
TEST(CmaGp, IsCmaEsWithoutItsModels) {
  const Rate failed_ellipsoid = [](const Vector& x) {
    double sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += std::pow(1000, static_cast<double>(k) / 4) * std::pow(x[k] - 0.3, 2);
    return Rating{{2e6 + sum}};
  };
  Search search({.algorithm = Method::cma_gp, .dimensions = 5, .restarts = 0});
  double best = 9e9;
  for (std::size_t done = 0; done < 3000;) {
    std::vector<Rating> ratings;
    for (const Vector& point : search.ask()) ratings.push_back(failed_ellipsoid(point));
    if (ratings.empty()) break;
    for (const Rating& one : ratings) best = std::min(best, one.fitness[0] - 2e6);
    done += ratings.size();
    search.tell(ratings);
  }
  EXPECT_LT(best, 1e-6);  // reached after 1083 points; by pagmo's cmaes with this seed after 1148
}

TEST(Scbo, SearchesWhereAllPointsFailAndWhereSomeDo) {
  const Rate fails = [](const Vector& x) { return Rating{{2e6 + x[0]}}; };
  EXPECT_EQ(best_of(Method::scbo, fails, 2, 100, 1), 9);
  const Rate fails_partly = [](const Vector& x) { return x[1] > 0.5 ? Rating{{2e6 + x[1]}} : inside_a_circle(x); };
  EXPECT_LT(best_of(Method::scbo, fails_partly, 2, 100, 1), -0.95);
}

TEST(Scbo, RequestsTheSamePointsAgain) {
  for (const Method method : {Method::scbo, Method::cma_gp}) {
    Search one({.algorithm = method, .dimensions = 3, .seed = 4});
    Search two({.algorithm = method, .dimensions = 3, .seed = 4});
    for (int k = 0; k < 6; ++k) {
      const std::vector<Vector> points = one.ask();
      ASSERT_EQ(points, two.ask()) << name_of(method) << ", generation " << k;
      std::vector<Rating> ratings;
      for (const Vector& point : points) ratings.push_back(inside_a_circle(point));
      one.tell(ratings);
      two.tell(ratings);
    }
  }
}

/// A search whose only point so far is the centre of the box, without an objective. No model therefore chooses among the
/// candidates, and candidates made from the best points stay near the centre.
class TrustRegion {
 public:
  static constexpr double kSpread = 0.02;  ///< largest distance of a candidate that is made of the best points
  TrustRegion() { generation(2e6); }
  /// Largest distance of the next points from the centre in a coordinate: half the side of the trust region.
  double reach() {
    double most = 0;
    for (const Vector& point : search_->ask()) {
      for (const double x : point) most = std::max(most, std::abs(x - 0.5));
    }
    return most;
  }
  /// A generation whose best fitness is `fitness`.
  void generation(double fitness) {
    rated_.push_back({{0.5, 0.5}, {{fitness}}});
    if (search_) return search_->tell({});
    EvolutionSettings settings;
    settings.points.resize(kPoints);
    settings.rated = &rated_;
    search_ = scbo(settings);
  }

 private:
  static constexpr std::size_t kPoints = 400;  // about 120 of them lie in the trust region
  std::vector<Rated> rated_;
  std::unique_ptr<Evolution> search_;
};

/// At least one of 120 points lies in the outermost twentieth of the region.
void expect_side(TrustRegion& region, double side) {
  const double reach = std::max(side / 2, TrustRegion::kSpread);
  EXPECT_LE(region.reach(), reach * (1 + 1e-12)) << side;  // rounding error of 0.5 + x - 0.5
  EXPECT_GT(region.reach(), 0.95 * reach) << side;
}

TEST(Scbo, TrustRegionShrinksWithoutGains) {
  TrustRegion region;
  double side = 0.8;
  for (; side >= 0.02; side /= 1.7) {
    expect_side(region, side);
    region.generation(2e6);
    expect_side(region, side);  // one generation without a gain is not enough
    region.generation(2e6);
  }
  expect_side(region, 0.6);  // the trust region starts again
}

TEST(Scbo, TrustRegionGrowsWithGains) {
  TrustRegion region;
  for (int generation = 0; generation < 4; ++generation) region.generation(2e6);
  double fitness = 2e6;
  for (double side = 0.8 / 1.7 / 1.7; side < 1; side *= 1.6) {
    expect_side(region, side);
    region.generation(fitness /= 2);
    expect_side(region, side);
    region.generation(fitness /= 2);
  }
}

/// The best point is at a face of the box. Points that were clamped there would be equal.
TEST(Scbo, RequestsNoPointTwiceAtAFaceOfTheBox) {
  Search search({.algorithm = Method::scbo, .dimensions = 1});
  std::vector<Vector> all;
  while (all.size() < 100) {
    std::vector<Rating> ratings;
    for (const Vector& point : search.ask()) {
      EXPECT_EQ(std::ranges::find(all, point), all.end()) << point[0];
      all.push_back(point);
      ratings.push_back(constrained(point[0], 0));
    }
    search.tell(ratings);
  }
}

TEST(Search, BeginsWithTheGivenPoints) {
  Search search({.algorithm = Method::scbo, .dimensions = 2, .starts = {{0.25, 0.75}, {0.5, 0.125}}});
  const std::vector<Vector> block = search.ask();
  EXPECT_EQ(block.size(), 16U);
  EXPECT_EQ(block[0], (Vector{0.25, 0.75}));
  EXPECT_EQ(block[1], (Vector{0.5, 0.125}));
}

TEST(PointModels, OrdersByObjectiveWhereTheViolationIsAcceptable) {
  const Eigen::Vector4d objective(3, 1, 2, 0);
  const Eigen::Vector4d violation(std::log(0.01), std::log(0.5), std::log(0.012), std::log(0.3));
  EXPECT_EQ(PointModels::order(objective, violation), (std::vector<std::size_t>{2, 0, 3, 1}));
}

/// A robot that is thrown (a value of -1000 that breaks all limits) does not change the model of the others.
TEST(PointModels, BearAnObjectiveFarFromTheOthers) {
  std::vector<Rated> points;
  for (int k = 0; k < 40; ++k) {
    const int column = k % 8;
    const int row = k / 8;
    const Vector x{column / 7.0, row / 4.0};
    points.push_back({x, constrained(-x[0], x[1] - 0.8)});
  }
  points[39].rating.objective = -1000;
  const PointModels models(points, {0.5, 0.5});
  const std::vector<Vector> at{{0.2, 0.3}, {0.8, 0.3}};
  const Eigen::VectorXd value = models.objective().mean(matrix_of(at));
  EXPECT_NEAR(value[0], -0.2, 0.1);
  EXPECT_NEAR(value[1], -0.8, 0.1);
}

}  // namespace
}  // namespace gaitlab::studies
