// Estimates of sensitivity agree with the indices of functions that are known in closed form.
#include "studies/search/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "core/math/functions.h"
#include "studies/plan/designs.h"

namespace gaitlab::studies {
namespace {

using Shares = std::vector<double>;

constexpr double kPi = std::numbers::pi;
const double kMissing = std::nan("");

std::vector<double> answers(std::size_t points, const std::function<Shares(std::uint64_t)>& design,
                            const std::function<double(const Shares&)>& of) {
  std::vector<double> values;
  for (std::size_t k = 0; k < points; ++k) values.push_back(of(design(k)));
  return values;
}

/// Function of Ishigami and Homma (1990) with a = 7, b = 0.1 and angles in [-pi, pi].
double ishigami(const Shares& shares) {
  const auto angle = [&](std::size_t k) { return kPi * (2 * shares[k] - 1); };
  const double s = math::sin(angle(1));
  const double cubed = angle(2) * angle(2);
  return math::sin(angle(0)) * (1 + 0.1 * cubed * cubed) + 7 * s * s;
}

/// The indices S and ST agree with the values of Saltelli et al. The tolerance 0.03 is the required accuracy for 4096 samples.
TEST(Sensitivity, SobolIndicesOfIshigami) {
  constexpr std::size_t kRows = 4096;
  const auto design = [](std::uint64_t point) { return saltelli_shares(3, point); };
  const std::vector<double> values = answers(kRows * 5, design, ishigami);
  const Sensitivity found = sobol_indices(3, values);
  ASSERT_EQ(found.measures[0].name, "total");
  ASSERT_EQ(found.measures[1].name, "first");
  constexpr double kTotal[] = {0.5576, 0.4424, 0.2437};
  constexpr double kFirst[] = {0.3139, 0.4424, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const IndexEstimate& total = found.measures[0].of[k];
    const IndexEstimate& first = found.measures[1].of[k];
    EXPECT_NEAR(total.value, kTotal[k], 0.03) << k;
    EXPECT_NEAR(first.value, kFirst[k], 0.03) << k;
    EXPECT_LE(total.low, total.value);
    EXPECT_GE(total.high, total.value);
    EXPECT_LT(total.high - total.low, 0.1);  // width of the confidence interval for this number of samples
    EXPECT_LE(first.low, kFirst[k] + 0.03);
    EXPECT_GE(first.high, kFirst[k] - 0.03);
  }
  EXPECT_EQ(found.used, kRows);
  const Sensitivity again = sobol_indices(3, values);
  EXPECT_EQ(again.measures[1].of[2].high, found.measures[1].of[2].high);  // the random draws are reproducible
}

/// The g-function of Sobol (Saltelli et al. 2010, equation 32) with a = 0, 1, 4.5, 9: indices 0.72, 0.18, 0.024, 0.0072.
constexpr double kWeights[] = {0, 1, 4.5, 9};
double sobol_g(const Shares& shares) {
  double product = 1;
  for (std::size_t k = 0; k < 4; ++k) product *= (std::abs(4 * shares[k] - 2) + kWeights[k]) / (1 + kWeights[k]);
  return product;
}
double first_of_sobol_g(std::size_t parameter) {
  const auto part = [](double a) { return 1 / (3 * (1 + a) * (1 + a)); };
  double all = 1;
  for (const double a : kWeights) all *= 1 + part(a);
  return part(kWeights[parameter]) / (all - 1);
}

/// First-order index by the estimator of Jansen (1999), which this program used before that of Saltelli et al. (2010).
double jansens_first(std::span<const double> values, std::size_t parameter) {
  const std::size_t rows = values.size() / 6;
  double mean = 0;
  double squares = 0;
  double apart = 0;
  for (std::size_t r = 0; r < rows; ++r) mean += (values[6 * r] + values[6 * r + 1]) / (2 * static_cast<double>(rows));
  for (std::size_t r = 0; r < rows; ++r) {
    for (const std::size_t k : {6 * r, 6 * r + 1}) squares += (values[k] - mean) * (values[k] - mean);
    const double from_b = values[6 * r + 1] - values[6 * r + 2 + parameter];
    apart += from_b * from_b;
  }
  return 1 - apart / squares;
}

/// Over 64 designs of 32 samples, the error of a small first-order index is less than half of that by Jansen's estimator, and
/// its mean is right. The tolerance is three standard errors of a mean of 64.
TEST(Sensitivity, SmallFirstOrdersHaveLittleNoise) {
  constexpr std::size_t kDesigns = 64;
  constexpr std::size_t kPoints = 32UL * 6;
  for (const std::size_t parameter : {2U, 3U}) {
    const double exact = first_of_sobol_g(parameter);
    double own = 0;
    double jansen = 0;
    double bias = 0;
    for (std::size_t d = 0; d < kDesigns; ++d) {
      const auto design = [&](std::uint64_t point) { return saltelli_shares(4, d * kPoints + point); };
      const std::vector<double> values = answers(kPoints, design, sobol_g);
      const double error = sobol_indices(4, values).measures[1].of[parameter].value - exact;
      const double other = jansens_first(values, parameter) - exact;
      own += error * error / kDesigns;
      jansen += other * other / kDesigns;
      bias += error / kDesigns;
    }
    std::printf("first order %.4f: error %.4f, by Jansen's estimator %.4f\n", exact, std::sqrt(own), std::sqrt(jansen));
    EXPECT_LT(std::sqrt(own), std::sqrt(jansen) / 2) << parameter;
    EXPECT_NEAR(bias, 0, 3 * std::sqrt(own / kDesigns)) << parameter;
  }
}

/// The middle of the box is left out (studies/plan/designs.h), because all points of its row would be equal.
TEST(Sensitivity, NoSampleRepeatsOnePoint) {
  for (std::uint64_t row = 0; row < 64; ++row) {
    std::size_t equal = 0;
    for (std::uint64_t k = 1; k < 6; ++k) equal += saltelli_shares(4, 6 * row + k) == saltelli_shares(4, 6 * row) ? 1 : 0;
    EXPECT_LT(equal, 5U) << row;
  }
}

/// The elementary effects of a linear function are its coefficients for any trajectories, up to rounding errors of differences.
TEST(Sensitivity, MorrisOfALinearFunctionIsExact) {
  constexpr double kCoefficients[] = {3, -0.5, 0, 12};
  const auto design = [](std::uint64_t point) { return morris_shares(7, 4, point); };
  const auto linear = [&](const Shares& shares) {
    double sum = 1;
    for (std::size_t k = 0; k < 4; ++k) sum += kCoefficients[k] * shares[k];
    return sum;
  };
  const Sensitivity found = morris(7, 4, answers(20UL * 5, design, linear));
  constexpr double kRounding = 1e-13;
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(found.measures[0].of[k].value, std::abs(kCoefficients[k]), kRounding);
    EXPECT_NEAR(found.measures[0].of[k].low, std::abs(kCoefficients[k]), kRounding);
    EXPECT_NEAR(found.measures[1].of[k].value, kCoefficients[k], kRounding);
    EXPECT_NEAR(found.measures[2].of[k].value, 0, kRounding);
  }
}

/// For the product x y, the effect of x depends on y, which sigma shows. If effects have both signs, mu may be 0, but not mu*.
TEST(Sensitivity, SigmaTellsWhatIsNotLinear) {
  const auto design = [](std::uint64_t point) { return morris_shares(1, 2, point); };
  const auto product = [](const Shares& s) { return (2 * s[0] - 1) * (2 * s[1] - 1); };
  const Sensitivity found = morris(1, 2, answers(400UL * 3, design, product));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_GT(found.measures[2].of[k].value, 1);
    EXPECT_LT(std::abs(found.measures[1].of[k].value), 0.3);
    EXPECT_GT(found.measures[0].of[k].value, 1);
  }
}

TEST(Sensitivity, OneStepOfATrajectoryChangesOneParameter) {
  constexpr std::size_t kParameters = 6;
  for (std::uint64_t t = 0; t < 50; ++t) {
    std::vector<int> changed(kParameters, 0);
    for (std::uint64_t s = 1; s <= kParameters; ++s) {
      const Shares before = morris_shares(3, kParameters, t * (kParameters + 1) + s - 1);
      const Shares now = morris_shares(3, kParameters, t * (kParameters + 1) + s);
      for (std::size_t k = 0; k < kParameters; ++k) {
        EXPECT_TRUE(now[k] >= 0 && now[k] <= 1);
        if (now[k] == before[k]) continue;
        ++changed[k];
        EXPECT_NEAR(std::abs(now[k] - before[k]), 2.0 / 3, 1e-15);
      }
    }
    EXPECT_EQ(changed, std::vector<int>(kParameters, 1));
  }
}

/// A failed run excludes only its trajectory or row.
TEST(Sensitivity, LeavesOutWhatHoldsAFailedRun) {
  const auto design = [](std::uint64_t point) { return saltelli_shares(2, point); };
  std::vector<double> values = answers(64UL * 4, design, [](const Shares& s) { return s[0] + 2 * s[1]; });
  const Sensitivity whole = sobol_indices(2, std::span(values).first(63UL * 4));
  values[63 * 4 + 2] = kMissing;
  const Sensitivity found = sobol_indices(2, values);
  EXPECT_EQ(found.used, 63U);
  EXPECT_EQ(found.blocks, 64U);
  for (const std::size_t k : {0U, 1U}) EXPECT_EQ(found.measures[0].of[k].value, whole.measures[0].of[k].value);
}

/// The indices are NaN if no or one row is left, or if the function is constant.
TEST(Sensitivity, IsNotKnownWhereNothingVaries) {
  const std::vector<double> none(8UL * 4, kMissing);
  EXPECT_TRUE(std::isnan(sobol_indices(2, none).measures[0].of[0].value));
  EXPECT_TRUE(std::isnan(morris(1, 3, none).measures[0].of[0].value));
  const std::vector<double> flat(8UL * 4, 0.3);
  EXPECT_TRUE(std::isnan(sobol_indices(2, flat).measures[0].of[0].value));
  EXPECT_EQ(morris(1, 3, flat).measures[0].of[0].value, 0);
  std::vector<double> one = none;
  for (std::size_t k = 0; k < 4; ++k) one[k] = static_cast<double>(k);
  EXPECT_EQ(morris(1, 3, one).used, 1U);
  EXPECT_TRUE(std::isfinite(morris(1, 3, one).measures[0].of[0].value));
  EXPECT_TRUE(std::isnan(morris(1, 3, one).measures[2].of[0].value));  // unknown with one trajectory
  EXPECT_TRUE(std::isnan(sobol_indices(2, one).measures[0].of[0].value));
  EXPECT_EQ(sobol_indices(2, {}).blocks, 0U);
}

}  // namespace
}  // namespace gaitlab::studies
