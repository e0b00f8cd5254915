// Tests of the share of a remedy's work and of the remaining time, with times that the test sets.
#include "report/remedy/remedy_work.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gaitlab::test {
namespace {

using report::RemedyRuns;
using report::RemedyWork;

RemedyWork::Time at(double seconds) {
  return RemedyWork::Time() + std::chrono::duration_cast<RemedyWork::Time::duration>(std::chrono::duration<double>(seconds));
}

TEST(RemedyWork, LongerRunsAndConfirmingRunsCountMore) {
  RemedyWork work(8);
  work.begin(RemedyRuns::search, {20, 10}, at(0));
  EXPECT_DOUBLE_EQ(work.ended(5), 0.05);  // 5 of 20 + 8 * 10 s
  EXPECT_DOUBLE_EQ(work.ended(15), 0.2);
  work.end(at(1));
  work.begin(RemedyRuns::confirming, {0, 10}, at(1));
  EXPECT_DOUBLE_EQ(work.ended(5), 0.6);
}

TEST(RemedyWork, TakesTheMeasuredCostOfConfirmingRuns) {
  RemedyWork work(8);
  work.begin(RemedyRuns::search, {10, 10}, at(0));
  work.ended(10);
  work.end(at(10));
  work.begin(RemedyRuns::confirming, {0, 10}, at(10));
  work.ended(5);
  work.end(at(20));  // each simulated second took 2 s
  work.begin(RemedyRuns::confirming, {0, 5}, at(20));
  EXPECT_DOUBLE_EQ(work.ended(2.5), 0.8333333333333334);  // (10 + 2 * 7.5) / (10 + 2 * 10)
}

/// The first runs of these searches are short, and the confirming runs take five times as long.
TEST(RemedyWork, TheTimeLeftDoesNotRiseWhereTheWorkIsAsExpected) {
  RemedyWork work(5);
  double now = 0, least = 1e9;
  const auto phase = [&](RemedyRuns kind, const std::vector<double>& runs, RemedyWork::Simulated after) {
    for (const double run : runs) after[static_cast<std::size_t>(kind)] += run;
    work.begin(kind, after, at(now));
    for (const double run : runs) {
      now += run * (kind == RemedyRuns::search ? 1 : 5);
      const double share = work.ended(run);
      const double left = now * (1 - share) / share;
      EXPECT_LE(left, least + 1e-9);  // tolerance for rounding errors
      least = left;
    }
    work.end(at(now));
  };
  phase(RemedyRuns::search, {1, 2, 2, 10}, {30, 40});
  phase(RemedyRuns::search, {10, 10, 10}, {0, 40});
  phase(RemedyRuns::confirming, {10, 10}, {0, 20});
  phase(RemedyRuns::confirming, {10, 10}, {0, 0});
  EXPECT_NEAR(least, 0, 1e-9);
}

}  // namespace
}  // namespace gaitlab::test
