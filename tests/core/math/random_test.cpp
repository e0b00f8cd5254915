// Random draws agree with published values and have the correct moments.
#include "core/math/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gaitlab::math {
namespace {

/// Hashes equal the outputs of splitmix64.c by its authors from the state 0.
TEST(Draws, AreThePublishedHashes) {
  EXPECT_EQ(hash64({0}), 0xe220a8397b1dcdafU);
  EXPECT_EQ(hash64({kGolden}), 0x6e789e6aa1b965f4U);
  EXPECT_EQ(splitmix64(1), 0xe220a8397b1dcdafU) << "the first number of seed 0";
  EXPECT_EQ(splitmix64(2), 0x6e789e6aa1b965f4U) << "the second";
}

TEST(Draws, OfOneWordCoverTheirInterval) {
  EXPECT_EQ(unit(0), 0);
  EXPECT_EQ(unit(~0ULL), 1 - 0x1p-53);
  EXPECT_EQ(symmetric(0), -1);
  EXPECT_EQ(symmetric(~0ULL), 1 - 0x1p-52);
}

TEST(Draws, OrderOfWordsCounts) { EXPECT_NE(hash64({1, 2}), hash64({2, 1})); }

/// Moments of n draws are within four standard errors, which are sqrt(v / n) for the mean and about v sqrt(2 / n) for the
/// variance.
TEST(Draws, HaveTheirMoments) {
  constexpr std::uint64_t kDraws = 100000;
  double u = 0;
  double u2 = 0;
  double z = 0;
  double z2 = 0;
  for (std::uint64_t k = 0; k < kDraws; ++k) {
    const double one = uniform({7, k});
    ASSERT_TRUE(one >= 0 && one < 1);
    u += one;
    u2 += one * one;
    const double other = normal({8, k});
    z += other;
    z2 += other * other;
  }
  const double n = kDraws;
  EXPECT_NEAR(u / n, 0.5, 4 * std::sqrt(1 / 12.0 / n));
  EXPECT_NEAR(u2 / n, 1 / 3.0, 4 * std::sqrt(4 / 45.0 / n));
  EXPECT_NEAR(z / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(z2 / n, 1, 4 * std::sqrt(2 / n));
}

}  // namespace
}  // namespace gaitlab::math
