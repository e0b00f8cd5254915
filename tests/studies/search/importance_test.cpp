// The share explained by a parameter agrees with first-order indices that are known in closed form.
#include "studies/search/importance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/math/functions.h"
#include "core/math/random.h"
#include "studies/plan/designs.h"

namespace gaitlab::studies {
namespace {

/// Columns of the coordinates, and the values of Ishigami's function (a = 7, b = 0.1), at points of a Sobol sequence.
struct IshigamiSample {
  std::vector<std::vector<double>> x{3};
  std::vector<double> y;
  explicit IshigamiSample(std::size_t points) {
    for (std::size_t k = 0; k < points; ++k) {
      const std::vector<double> shares = sobol_point(3, k);
      for (std::size_t p = 0; p < 3; ++p) x[p].push_back(std::numbers::pi * (2 * shares[p] - 1));
      const double s = math::sin(x[1].back());
      const double squared = x[2].back() * x[2].back();
      y.push_back(math::sin(x[0].back()) * (1 + 0.1 * squared * squared) + 7 * s * s);
    }
  }
};

/// First-order indices of Saltelli et al. Twenty classes lose about a hundredth of a sine within a class.
TEST(Importance, AgreesWithFirstOrderIndices) {
  const IshigamiSample sample(4096);
  constexpr double kFirst[] = {0.3139, 0.4424, 0};
  for (std::size_t p = 0; p < 3; ++p) EXPECT_NEAR(explained(sample.x[p], sample.y), kFirst[p], 0.02) << p;
}

/// The mean share of a parameter without influence is 0, although classes of a finite sample differ by chance. Without the
/// correction it would be 19/399.
TEST(Importance, ChanceIsTakenOff) {
  constexpr std::size_t kStudies = 200;
  constexpr std::size_t kPoints = 400;
  double mean = 0;
  for (std::uint64_t study = 0; study < kStudies; ++study) {
    std::vector<double> x;
    std::vector<double> y;
    for (std::uint64_t k = 0; k < kPoints; ++k) {
      x.push_back(math::uniform({1, study, k}));
      y.push_back(math::uniform({2, study, k}));
    }
    mean += explained(x, y) / kStudies;
  }
  // The tolerance is three standard errors; the standard deviation of a share is sqrt(2 * 19) / 380.
  EXPECT_NEAR(mean, 0, 3 * std::sqrt(2.0 * 19 / kStudies) / 380);
}

/// Points of equal value are in one class, so that listed values and words need no other rule.
TEST(Importance, ValuesOfAListAreClasses) {
  std::vector<double> x;
  std::vector<double> y;
  for (int k = 0; k < 90; ++k) {
    x.push_back(k % 3);
    y.push_back(k % 3 == 1 ? 5 : 2);
  }
  EXPECT_DOUBLE_EQ(explained(x, y), 1);
  for (int k = 0; k < 90; ++k) y[static_cast<std::size_t>(k)] = k < 45 ? 0 : 1;
  EXPECT_NEAR(explained(x, y), 0, 0.03);
}

TEST(Importance, IsNotKnownOfFewPointsOrEqualValues) {
  const IshigamiSample few(59);
  EXPECT_TRUE(std::isnan(explained(few.x[0], few.y)));
  const IshigamiSample enough(60);
  EXPECT_TRUE(std::isfinite(explained(enough.x[0], enough.y)));
  EXPECT_TRUE(std::isnan(explained(enough.x[0], std::vector<double>(60, 2.5))));
  EXPECT_TRUE(std::isnan(explained(std::vector<double>(60, 2.5), enough.y)));
}

}  // namespace
}  // namespace gaitlab::studies
