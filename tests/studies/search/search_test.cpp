// Tests of searches: pagmo by record and replay gives the results of pagmo; limits of parameters, order of points, restarts.
#include "studies/search/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/algorithms/xnes.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "studies/search/fitness.h"
#include "studies/study/population.h"

namespace gaitlab::studies {
namespace {

using Function = Vector (*)(const Vector&);

Vector rosenbrock(const Vector& x) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) sum += 100 * std::pow(x[k + 1] - x[k] * x[k], 2) + std::pow(1 - x[k], 2);
  return {sum};
}

Vector sphere(const Vector& x) {
  double sum = 0;
  for (const double c : x) sum += c * c;
  return {sum};
}

/// Quadratic test function with axes of very different lengths, rotated by 30 degrees in every plane of two neighbouring
/// coordinates.
Vector rotated_ellipsoid(const Vector& x) {
  const double c = std::cos(0.5235987755982988);
  const double s = 0.5;
  Vector y = x;
  for (std::size_t k = 0; k + 1 < y.size(); ++k) {
    const double a = c * y[k] - s * y[k + 1];
    y[k + 1] = s * y[k] + c * y[k + 1];
    y[k] = a;
  }
  double sum = 0;
  for (std::size_t k = 0; k < y.size(); ++k)
    sum += std::pow(1e6, static_cast<double>(k) / static_cast<double>(y.size() - 1)) * y[k] * y[k];
  return {sum};
}

Vector two_hills(const Vector& x) { return {sphere(x)[0], std::pow(x[0] - 2, 2) + std::abs(x[1])}; }

/// Problem for a direct call of pagmo, without gaitlab.
struct Plain {
  Function function = rosenbrock;
  std::size_t objectives = 1;
  [[nodiscard]] Vector fitness(const Vector& x) const { return function(x); }
  [[nodiscard]] std::size_t get_nobj() const { return objectives; }
  [[nodiscard]] std::pair<Vector, Vector> get_bounds() const { return {Vector(10, -5.0), Vector(10, 5.0)}; }
};

void expect_pagmo(Method method, pagmo::algorithm algorithm, Function function, std::size_t objectives) {
  constexpr unsigned kSeed = 7;
  constexpr int kGenerations = 60;
  const pagmo::population first(pagmo::problem(Plain{function, objectives}), 20, kSeed);
  pagmo::population serial = first;
  for (int g = 0; g < kGenerations; ++g) serial = algorithm.evolve(serial);

  const auto ours = pagmo_evolution({.algorithm = method,
                                     .low = Vector(10, -5.0),
                                     .high = Vector(10, 5.0),
                                     .seed = kSeed,
                                     .sigma = 0.25,
                                     .points = first.get_x(),
                                     .values = first.get_f()});
  for (int g = 0; g < kGenerations; ++g) {
    std::vector<Vector> values;
    for (const Vector& point : ours->ask()) values.push_back(function(point));
    EXPECT_GT(values.size(), 1U);
    ours->tell(values);
  }
  EXPECT_EQ(ours->points(), serial.get_x());  // identical bits
  EXPECT_EQ(ours->values(), serial.get_f());
}

TEST(Evolution, IsPagmosOwnBitForBit) {
  const pagmo::algorithm cma(pagmo::cmaes(1, -1, -1, -1, -1, 0.25, 0, 0, true, false, 7));
  for (const Function function : {rosenbrock, sphere, rotated_ellipsoid}) expect_pagmo(Method::cma, cma, function, 1);
  expect_pagmo(Method::xnes, pagmo::algorithm(pagmo::xnes(1, -1, -1, -1, 0.25, 0, 0, true, false, 7)), rosenbrock, 1);
  expect_pagmo(Method::sade, pagmo::algorithm(pagmo::sade(1, 2, 1, 0, 0, true, 7)), rosenbrock, 1);
  expect_pagmo(Method::pso, pagmo::algorithm(pagmo::pso_gen(1, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, true, 7)), rosenbrock, 1);
  expect_pagmo(Method::nsga2, pagmo::algorithm(pagmo::nsga2(1, 0.95, 10, 0.1, 50, 7)), two_hills, 2);
}

/// Rating of a kept point.
Rating rated(const Vector& fitness) { return {fitness, fitness[0], 0}; }

/// Points that the search requests until it ends, at most `most`.
std::vector<Vector> asked(Search& search, Function function, std::size_t most) {
  std::vector<Vector> all;
  while (all.size() < most) {
    const std::vector<Vector> points = search.ask();
    if (points.empty()) break;
    std::vector<Rating> ratings;
    ratings.reserve(points.size());
    for (const Vector& point : points) ratings.push_back(rated(function(point)));
    all.insert(all.end(), points.begin(), points.end());
    search.tell(ratings);
  }
  return all;
}

TEST(Search, StaysInTheBoxAndFindsACorner) {
  Search search({.algorithm = Method::cma, .dimensions = 3, .restarts = 0});
  const auto corner = [](const Vector& x) { return Vector{x[0] + 2 * x[1] - x[2]}; };  // minimum at (0, 0, 1)
  double best = 9;
  for (const Vector& point : asked(search, corner, 2000)) {
    for (const double c : point) {
      ASSERT_GE(c, 0);
      ASSERT_LE(c, 1);
      ASSERT_EQ(c, std::round(c * 1e9) / 1e9);
    }
    best = std::min(best, corner(point)[0]);
  }
  EXPECT_LT(best, -1 + 1e-3);  // less than the convergence of 1e-4, because points outside are mirrored into the box
}

TEST(Search, IsAFunctionOfItsSeed) {
  const SearchSettings settings{.dimensions = 2, .restarts = 1, .seed = 3};
  Search one(settings);
  Search two(settings);
  EXPECT_EQ(asked(one, sphere, 400), asked(two, sphere, 400));
  SearchSettings other = settings;
  other.number = 1;
  Search three(other);
  Search four(settings);
  EXPECT_NE(three.ask(), four.ask());
}

TEST(Search, StartsAgainWithTwiceThePopulationAndEnds) {
  Search search({.dimensions = 1, .population = 5, .restarts = 2});
  std::size_t largest = 0;
  std::uint64_t restarts = 0;
  for (int k = 0; k < 10000; ++k) {
    const std::vector<Vector> points = search.ask();
    if (points.empty()) break;
    restarts = std::max(restarts, search.restart());
    largest = std::max(largest, points.size());
    std::vector<Rating> ratings;
    ratings.reserve(points.size());
    for (const Vector& point : points) ratings.push_back(rated({std::abs(point[0] - 0.3)}));
    search.tell(ratings);
  }
  EXPECT_EQ(restarts, 2U);
  EXPECT_EQ(largest, 20U);
  EXPECT_TRUE(search.ask().empty());
}

TEST(Search, EndsWhereNothingIsEverFeasible) {
  for (const Method method : {Method::cma, Method::xnes, Method::sade, Method::pso}) {
    Search search({.algorithm = method, .dimensions = 2, .population = 8, .restarts = 0});
    const auto flat = [](const Vector&) { return Vector{2e6 + 1}; };
    EXPECT_LT(asked(search, flat, 100000).size(), 1000U) << name_of(method);
  }
  Search search({.algorithm = Method::nsga2, .dimensions = 2, .objectives = 2, .population = 8, .restarts = 0});
  EXPECT_LT(asked(
                search,
                [](const Vector&) {
                  return Vector{2e6, 2e6};
                },
                100000)
                .size(),
            1000U);
}

TEST(Search, PopulationsFillLanes) {
  EXPECT_EQ(usual_population(1), 16U);
  EXPECT_EQ(usual_population(54), 16U);  // 4 + 3 ln 54 = 15.97
  EXPECT_EQ(usual_population(55), 24U);
}

PointResult point(double objective, double violation) {
  PointResult p{0, 1, 0, {}, 0};
  p.score.objectives[0] = objective;
  p.score.violation = violation;
  return p;
}

TEST(Fitness, KeepsTheOrderOfPoints) {
  const std::vector<JournalObjective> most{{"speed", true}};
  PointResult early = point(0, 0);
  early.failed = 1;
  early.lived = 1;
  PointResult late = early;
  late.lived = 11;
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<PointResult> order{
      point(1e300, 0),  point(1e5, 0),  point(2, 0), point(1, 0),  point(-1, 0), point(-1e9, 0),
      point(-1e300, 0), point(9, 1e-3), point(9, 1), point(9, 99), late,         early};
  for (std::size_t k = 0; k + 1 < order.size(); ++k)
    EXPECT_LT(fitness(order[k], most, 12)[0], fitness(order[k + 1], most, 12)[0]) << k;
  for (const PointResult& p : {point(std::nan(""), 1), point(inf, inf), point(0, std::nan("")), point(std::nan(""), 0)})
    EXPECT_TRUE(std::isfinite(fitness(p, most, 12)[0]));
  EXPECT_EQ(fitness(point(2, 0), {{"speed", true}, {"cost", false}}, 12)[0], -2);
}

TEST(Front, IsWhatNothingIsBetterThan) {
  std::vector<PointResult> points;
  for (const auto& [speed, cost, violation] :
       {std::tuple{1.0, 5.0, 0.0}, {2.0, 6.0, 0.0}, {2.0, 7.0, 0.0}, {0.5, 5.5, 0.0}, {3.0, 1.0, 1.0}, {0.5, 4.0, 0.0}}) {
    PointResult p = point(speed, violation);
    p.first_run = points.size();
    p.score.objectives[1] = cost;
    points.push_back(p);
  }
  EXPECT_EQ(front(points, {{"speed", true}, {"cost", false}}), (std::vector<std::size_t>{1, 0, 5}));
  EXPECT_TRUE(front({}, {{"speed", true}, {"cost", false}}).empty());
}

}  // namespace
}  // namespace gaitlab::studies
