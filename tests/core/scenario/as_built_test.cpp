// Draws of the robot as built.
#include "core/scenario/as_built.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/scenario/fixture.h"
#include "tests/validation.h"

namespace gaitlab {
namespace {

using test::validate;
using AsBuiltTest = fakes::ScenarioTest;

TEST_F(AsBuiltTest, DrawsAreNormalAndCutAtThree) {
  const Scenario s = read(fakes::kTwo);
  double sum = 0;
  double squares = 0;
  double most = 0;
  int outside = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 16000; ++seed) {
    AsBuilt built = AsBuilt::unknown();
    Tolerances tolerances;
    tolerances.deviation[4] = 0.1;
    EXPECT_EQ(draw(built, tolerances, *s.robot, seed), 2U);
    for (std::size_t j = 0; j < 2; ++j) {
      const double n = (built.numbers[6][j] - 1) / 0.1;
      sum += n;
      squares += n * n;
      most = std::max(most, std::abs(n));
      outside += std::abs(n) > 1 ? 1 : 0;
      ++count;
    }
  }
  const std::string source = "normal distribution cut at 3 deviations";
  validate({"closed.tolerances_mean", "mean of 32 000 draws of a tolerance", source, "deviations"}, sum / count, 0, 0.017,
           "three standard errors of the mean, 3/sqrt(32000)");
  validate({"closed.tolerances_variance", "variance of 32 000 draws of a tolerance", source, "deviations^2"}, squares / count,
           0.9989, 0.024, "three standard errors of the variance, 3 sqrt(2/32000)");
  validate({"closed.tolerances_share", "share of draws beyond one deviation", source, ""}, outside / static_cast<double>(count),
           0.3173, 0.0078, "three standard errors of the share");
  EXPECT_NEAR(most, 3, 1e-12);
}

}  // namespace
}  // namespace gaitlab
