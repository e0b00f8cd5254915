// Tests of the means over starts: closed forms, and the comparison with a golden of means.
#include "golden/starts.h"

#include <gtest/gtest.h>

#include "tests/golden/golden_sample.h"

namespace gaitlab::test {
namespace {

/// Runs of walk() with the distances 1 to 16 m.
std::vector<GoldenRun> sixteen_walks() {
  std::vector<GoldenRun> runs;
  for (int k = 1; k <= kStarts; ++k) runs.push_back({walk(), {{"distance", "m", static_cast<double>(k)}}});
  return runs;
}

TEST(Starts, MeanAndDeviationAreThoseOfTheSum) {
  const std::vector<GoldenRun> runs = sixteen_walks();
  const GoldenRun mean = mean_of(runs);
  ASSERT_EQ(mean.numbers.size(), 1U);
  EXPECT_DOUBLE_EQ(mean.numbers[0].value, 8.5);
  EXPECT_DOUBLE_EQ(mean.numbers[0].deviation.value(), std::sqrt(16 * 17 / 12.0));  // sample variance n(n + 1)/12 of 1, 2 ... n
  ASSERT_EQ(mean.trace.columns.size(), 1U);
  EXPECT_EQ(mean.trace.columns[0].name, "t");
  EXPECT_EQ(mean.trace.rows(), walk().rows());
  EXPECT_EQ(mean.trace.at(3, 0), walk().at(3, 0));
}

TEST(Starts, OneRunStaysAsItIs) {
  const std::vector<GoldenRun> runs{sixteen_walks().front()};
  const GoldenRun one = mean_of(runs);
  EXPECT_EQ(one.trace.values, runs.front().trace.values);
  EXPECT_FALSE(one.numbers[0].deviation);
  EXPECT_EQ(one.starts, 1);
}

TEST(Starts, BandsAreStandardErrorsOfTwoMeans) {
  const GoldenRun mean = mean_of(sixteen_walks());
  const Bands bands = calibrate(mean, {}, mean);
  EXPECT_DOUBLE_EQ(bands.numbers[0].ensemble, 6 * std::sqrt(16 * 17 / 12.0) * std::sqrt(2.0 / 16) / 8.5);
  EXPECT_EQ(bands.numbers[0].halving, 0);
  EXPECT_EQ(bands.columns.size(), 1U);
}

// If the golden leaves out a number, such as the cost of transport of a robot that stays in place, it also leaves out its
// deviation.
TEST(Starts, ADeviationBelongsToItsNumber) {
  GoldenRun mean = mean_of(sixteen_walks());
  mean.numbers.insert(mean.numbers.begin(), {{"cost_of_transport.electrical", "J/(N m)", 1, {}, 1000}});
  const double with = calibrate(mean, {}, mean).numbers[1].ensemble;
  mean.numbers.erase(mean.numbers.begin());
  EXPECT_EQ(calibrate(mean, {}, mean).numbers[0].ensemble, with);
}

TEST(Starts, MeansAndRunsAreNotCompared) {
  const Golden golden = sample_golden(walk());
  GoldenRun run = run_of(golden);
  run.starts = kStarts;
  const GoldenDifference difference = compare(golden, run);
  EXPECT_FALSE(difference.passed());
  ASSERT_EQ(difference.findings.size(), 1U);
  EXPECT_EQ(difference.findings[0],
            "a sensor has a resolution, so that this run has means over starts, but the golden is of one run");
  Golden means = golden;
  run.starts = 8;
  means.starts = kStarts;
  EXPECT_EQ(compare(means, run).findings.at(0), "means over 8 starts, in the golden over 16");
  means.starts = kStarts;
  EXPECT_EQ(compare(means, run_of(golden)).findings.at(0),
            "no sensor has a resolution, so that this is one run, but the golden has means over starts");
}

}  // namespace
}  // namespace gaitlab::test
