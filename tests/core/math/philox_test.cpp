// Philox4x32-10 against the known answers of its authors and of the C++26 standard; moments of the normal numbers.
#include "core/math/philox.h"

#include <gtest/gtest.h>

#include "tests/validation.h"

namespace gaitlab::math {
namespace {

TEST(Philox, GivesTheKnownAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (PhiloxBlock{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(philox({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (PhiloxBlock{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxBlock{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// The 10000th number of std::philox4x32 with its default seed, 20111115, which the C++26 standard states: the last word of
// block 2499.
TEST(Philox, GivesTheNumberOfTheStandard) {
  test::validate({"published.philox", "10 000th number of Philox4x32-10, seed 20111115", "C++26 standard, std::philox4x32", ""},
                 philox({2499, 0, 0, 0}, {20111115, 0})[3], 1955073260, 0, "a whole number");
}

TEST(Fnv1a32, GivesTheKnownAnswers) {
  EXPECT_EQ(fnv1a32(""), 0x811c9dc5U);
  EXPECT_EQ(fnv1a32("a"), 0xe40c292cU);
  EXPECT_EQ(fnv1a32("foobar"), 0xbf9cf968U);
  EXPECT_EQ(fnv1a32("encoder.m0/active"), 0x314556edU);
}

TEST(PhiloxStream, KeyIsTheSeedAndCounterTickNameDraw) {
  EXPECT_EQ(philox({0, 0, 0x314556ed, 0}, {1, 0}), (PhiloxBlock{0xc4e7aa3b, 0xadca4e0f, 0xec98c46c, 0xb615625a}));
  const PhiloxStream stream(1, "encoder.m0/active");
  // 1 ulp of each of log, cos and sqrt: core/math and the reference in Python need not round alike.
  test::validate(
      {"published.philox_normal", "first normal number of seed 1, encoder.m0/active", "the same computed in Python", ""},
      stream.normal(0, 0), 0.6438930316106422, 4e-16, "1 ulp of each of log, cos and sqrt");
  EXPECT_EQ(stream.uniform(0, 0), (static_cast<double>((0xc4e7aa3bULL << 21U) ^ (0xadca4e0fULL >> 11U)) + 0.5) * 0x1p-53);
  // Upper halves of seed and tick matter.
  EXPECT_NE(stream.uniform(1ULL << 32U, 0), stream.uniform(0, 0));
  EXPECT_NE(PhiloxStream(1 + (1ULL << 32U), "encoder.m0/active").uniform(0, 0), stream.uniform(0, 0));
  EXPECT_NE(stream.uniform(0, 1), stream.uniform(0, 0));
}

// Mean, deviation and correlation of 20000 draws as a reference implementation in Python gives them. The standard deviations of
// these three moments are 0.0071, 0.005 and 0.0071.
TEST(PhiloxStream, MomentsOf20000Draws) {
  const PhiloxStream stream(1, "encoder.m0/active");
  constexpr std::uint64_t kDraws = 20000;
  double sum = 0;
  double squares = 0;
  double products = 0;
  double before = 0;
  for (std::uint64_t k = 0; k < kDraws; ++k) {
    const double n = stream.normal(k, 0);
    sum += n;
    squares += n * n;
    products += n * before;
    before = n;
  }
  const double mean = sum / kDraws;
  EXPECT_NEAR(mean, 0.0106, 5e-5);
  EXPECT_NEAR(std::sqrt(squares / kDraws - mean * mean), 0.9996, 5e-5);
  EXPECT_NEAR(products / kDraws - mean * mean, 0.0022, 1e-4);
}

}  // namespace
}  // namespace gaitlab::math
