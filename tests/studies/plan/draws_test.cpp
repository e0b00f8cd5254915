// Draws of a study by counter: independent of one another, and of everything but their own words.
#include "studies/plan/draws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/math/random.h"
#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

/// Streams whose first word differs are uncorrelated, even if all other words are equal. Points, seeds and variations have the
/// first words 1 to 3 (studies/plan/points.cpp).
TEST(Draws, OfDifferentPurposesAreUncorrelated) {
  const std::vector<std::uint64_t> purposes{1, 2, 3, studies::kSearchDraw, studies::kEstimateDraw};
  EXPECT_EQ(std::set(purposes.begin(), purposes.end()).size(), purposes.size());
  constexpr std::uint64_t kCount = 10000;
  for (const std::uint64_t a : purposes) {
    for (const std::uint64_t b : purposes) {
      if (a == b) continue;
      double product = 0;
      for (std::uint64_t k = 0; k < kCount; ++k) product += (math::uniform({a, 1, k}) - 0.5) * (math::uniform({b, 1, k}) - 0.5);
      // The tolerance is four standard deviations of the mean of products of two uniform draws, each with the variance 1/12.
      EXPECT_LT(std::abs(product / kCount), 4.0 / 12 / std::sqrt(kCount)) << a << " " << b;
    }
  }
}

/// For each of the first 2000 points, true if its torque error is estimated (one in 16).
std::vector<bool> estimated(const std::string& range, const std::string& more) {
  const SmallStudy study("parameters: {cpg.frequency: {low: 0.5, high: 1.5" + range + "}}\nestimate_every: 16\nguards: none\n" +
                         more);
  std::vector<bool> all;
  for (std::uint64_t run = 0; run < 2000; ++run) all.push_back(study.plan->estimates(study.plan->row(run).point));
  return all;
}

TEST(Draws, EstimateOnePointInTheNumberThatTheStudyStates) {
  const std::vector<bool> grid = estimated(", count: 2000", "");
  // The tolerance is four standard deviations of a count among 2000 with a probability of 1/16.
  EXPECT_NEAR(static_cast<double>(std::ranges::count(grid, true)), 2000.0 / 16, 4 * std::sqrt(2000.0 / 16 * 15 / 16));
  EXPECT_NE(estimated(", count: 2000", "seed: 2\n"), grid) << "the same points, another seed";
  const std::string random = "method: {type: random}\nbudget: {runs: ";
  EXPECT_EQ(estimated("", random + "2000}\n"), estimated("", random + "3000}\n")) << "of a larger study";
}

}  // namespace
}  // namespace gaitlab::test
