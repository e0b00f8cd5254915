#include "core/simulation/support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace gaitlab {
namespace {

std::vector<std::size_t> names(const std::vector<SupportElement>& support) {
  std::vector<std::size_t> list;
  for (const SupportElement& s : support) list.push_back(s.element);
  return list;
}

TEST(Support, GrowsUntilItHoldsTheCentreOfMass) {
  const std::vector<SupportElement> legs = {
      {0, 0.0, {1, 1, 0}}, {1, 0.0, {1, -1, 0}}, {2, 0.02, {-1, 0, 0}}, {3, 0.5, {-2, 0, 0}}};
  EXPECT_EQ(names(support_elements(legs, Vec3(0, 0, 1))), (std::vector<std::size_t>{0, 1, 2}));
  // The robot would topple on any of its elements. The lowest elements then count as support.
  EXPECT_EQ(names(support_elements(legs, Vec3(5, 0, 1))), (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(support_elements({}, Vec3::Zero()).empty());
}

/// The result equals that of a search that adds one element after the other.
TEST(Support, IsThatOfTheSearchFromTheLowest) {
  std::mt19937 bits(3);
  const auto uniform = [&] { return static_cast<double>(bits()) / 2147483648.0 - 1; };
  for (int k = 0; k < 200; ++k) {
    std::vector<SupportElement> elements;
    std::vector<Vec3> points;
    const Vec3 com(0.7 * uniform(), 0.7 * uniform(), 0);
    std::size_t holding = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(1 + k % 40); ++i) {
      points.emplace_back(uniform(), uniform(), 0);
      elements.push_back({i, 0.002 * static_cast<double>(i), points.back()});
      if (holding == 0 && support_margin(points, com) > 0) holding = points.size();
    }
    EXPECT_EQ(support_elements(elements, com).size(), std::max<std::size_t>(1, holding)) << k;
  }
}

TEST(SupportMargin, OfFourFeetIsTheDistanceToTheNearestEdge) {
  const std::vector<Vec3> square = {{1, 1, 0}, {-1, 1, 5}, {1, -1, 0}, {-1, -1, 0}, {0, 0, 0}, {1, 0, 0}};
  EXPECT_DOUBLE_EQ(support_margin(square, Vec3(0, 0, 9)), 1);
  EXPECT_DOUBLE_EQ(support_margin(square, Vec3(0.25, -0.5, 9)), 0.5);
  EXPECT_DOUBLE_EQ(support_margin(square, Vec3(1.5, 0.3, 9)), -0.5);
  EXPECT_DOUBLE_EQ(support_margin(square, Vec3(4, 5, 9)), -5) << "from the corner";
  EXPECT_NEAR(support_margin(square, Vec3(1, 0.3, 0)), 0, 1e-15) << "on the edge, to rounding";
}

TEST(SupportMargin, OfFewerThanThreeFeetIsNeverInside) {
  const std::vector<Vec3> line = {{0, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(support_margin(line, Vec3(1, 0, 0)), 0);
  EXPECT_DOUBLE_EQ(support_margin(line, Vec3(1, 0.5, 0)), -0.5);
  EXPECT_DOUBLE_EQ(support_margin(line, Vec3(5, 4, 0)), -5);
  const std::vector<Vec3> collinear = {{0, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0.5, 0.5, 0}, {2, 2, 0}};
  EXPECT_DOUBLE_EQ(support_margin(collinear, Vec3(1, 0, 0)), -std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(support_margin(collinear, Vec3(2, 3, 0)), -1);
  const std::vector<Vec3> twice = {{1, 2, 0}, {1, 2, 0}, {1, 2, 0}};
  EXPECT_DOUBLE_EQ(support_margin(twice, Vec3(4, 6, 0)), -5);
  EXPECT_DOUBLE_EQ(support_margin(std::span(twice).first(1), Vec3(4, 6, 0)), -5);
  EXPECT_TRUE(std::isnan(support_margin({}, Vec3::Zero())));
}

/// The margin equals that of the support function, the least of max_p (p - c).u over all directions u. Outside the set this is
/// minus the distance, and inside it is the distance to the edge.
TEST(SupportMargin, IsThatOfTheSupportFunction) {
  std::mt19937 bits(7);
  const auto uniform = [&] { return static_cast<double>(bits()) / 2147483648.0 - 1; };
  constexpr int kDirections = 20000;
  for (int k = 0; k < 60; ++k) {
    std::vector<Vec3> points;
    for (int i = 0; i < 1 + k % 9; ++i) points.emplace_back(uniform(), uniform(), uniform());
    const Vec3 com(uniform(), uniform(), uniform());
    double least = INFINITY;
    for (int d = 0; d < kDirections; ++d) {
      const double angle = 2 * std::numbers::pi * d / kDirections;
      double most = -INFINITY;
      for (const Vec3& p : points)
        most = std::max(most, std::cos(angle) * (p.x() - com.x()) + std::sin(angle) * (p.y() - com.y()));
      least = std::min(least, most);
    }
    // The nearest sampled direction is within pi / kDirections, and the points are at most 3 m away.
    EXPECT_NEAR(support_margin(points, com), least, 3 * std::numbers::pi / kDirections) << k;
  }
}

}  // namespace
}  // namespace gaitlab
