// Tests of the points of a study by their numbers.
#include "studies/plan/points.h"

#include <gtest/gtest.h>

#include <set>

#include "studies/journal/results.h"
#include "studies/study/number.h"

namespace gaitlab::studies {
namespace {

using Values = std::vector<std::string>;

Parameter range(const std::string& key, double low, double high, std::int64_t count = 0, bool log = false) {
  Parameter p;
  p.key = key;
  p.low = low;
  p.high = high;
  p.count = count;
  p.log = log;
  return p;
}

TEST(Points, OfAGridAreItsProductAndTheLastIsTheFastest) {
  Study study;
  study.parameters = {range("a", 0.5, 2.1, 17), range("b", 0.01, 100, 5, true)};
  Parameter word;
  word.key = "c";
  word.values = {"hopf", "sine"};
  study.parameters.push_back(word);
  const Points points(study);
  EXPECT_EQ(points.points(), 17U * 5 * 2);
  EXPECT_EQ(points.values(0), (Values{"0.5", "0.01", "hopf"}));
  EXPECT_EQ(points.values(1), (Values{"0.5", "0.01", "sine"}));
  EXPECT_EQ(points.values(2), (Values{"0.5", "0.1", "hopf"}));
  EXPECT_EQ(points.values(10), (Values{"0.6", "0.01", "hopf"}));  // 0.6 as in the file, not 0.6000000000000001
  EXPECT_EQ(points.values(169), (Values{"2.1", "100", "sine"}));
}

TEST(Points, WithoutAParameterAreOne) {
  Study study;
  study.replicates.count = 3;
  const Points points(study);
  EXPECT_EQ(points.runs(), 3U);
  EXPECT_TRUE(points.values(0).empty());
  EXPECT_NE(points.seed(0), points.seed(1));
}

TEST(Points, ThatAreDrawnLieWithinAndDoNotDependOnTheirNumber) {
  for (const Method method : {Method::random, Method::sobol}) {
    Study study;
    study.method = method;
    study.parameters = {range("a", -1, 1), range("b", 0.01, 100, 0, true)};
    study.runs = 1000;
    const Points points(study);
    std::set<Values> all;
    int small = 0;
    for (std::uint64_t k = 0; k < 1000; ++k) {
      const Values values = points.values(k);
      const double a = number_of(values[0]);
      const double b = number_of(values[1]);
      EXPECT_TRUE(a >= -1 && a <= 1 && b >= 0.01 && b <= 100) << values[0] << " " << values[1];
      all.insert(values);
      small += b < 1 ? 1 : 0;
    }
    EXPECT_EQ(all.size(), 1000U);
    // The values are uniform in the logarithm, so that half are below 1. The tolerance is four standard deviations of this
    // count.
    EXPECT_NEAR(small, 500, 4 * 16);
    Study larger = study;
    larger.runs = 100000;
    EXPECT_EQ(Points(larger).values(999), points.values(999));
  }
}

/// Each of the 2^k equal parts of an axis contains one of the first 2^k points of a Sobol sequence. Because point 0 is omitted,
/// one part may be empty and one part may contain two points.
TEST(Points, OfSobolAreEven) {
  Study study;
  study.method = Method::sobol;
  study.parameters = {range("a", 0, 1), range("b", 0, 1), range("c", 0, 1)};
  study.runs = 64;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::set<int> parts;
    for (std::uint64_t k = 0; k < 64; ++k) parts.insert(static_cast<int>(64 * number_of(Points(study).values(k)[axis])));
    EXPECT_GE(parts.size(), 63U) << axis;
  }
}

TEST(Points, VariationsAreTheSameForEveryPointAndKeepTheirLimits) {
  Study study;
  study.replicates.count = 500;
  Variation normal;
  normal.key = "n";
  normal.law = Variation::Law::normal;
  normal.a = 0.8;
  normal.b = 0.5;
  normal.low = 0.3;
  normal.high = 1.2;
  Variation times;
  times.key = "t";
  times.a = 0.95;
  times.b = 1.05;
  times.times = true;
  study.replicates.vary = {normal, times};
  const Points points(study);
  for (std::uint64_t r = 0; r < 500; ++r) {
    const Values drawn = points.drawn(r, {{"t", 200.0}});
    EXPECT_TRUE(number_of(drawn[0]) >= 0.3 && number_of(drawn[0]) <= 1.2) << drawn[0];
    EXPECT_TRUE(number_of(drawn[1]) >= 190 && number_of(drawn[1]) <= 210) << drawn[1];
    EXPECT_EQ(points.drawn(r, {{"t", 200.0}}), drawn);
  }
}

TEST(Combined, AreTheOrdinaryStatistics) {
  const std::vector<double> bad{3, 1, 2, 10};
  EXPECT_EQ(combined(bad, "worst", 0), 10);
  EXPECT_EQ(combined(bad, "mean", 0), 4);
  EXPECT_EQ(combined(bad, "median", 0), 2.5);
  EXPECT_EQ(combined(bad, "quantile", 0.75), 3);
  EXPECT_EQ(combined(bad, "quantile", 1), 10);
  EXPECT_EQ(combined(bad, "quantile", 0), 1);
  EXPECT_EQ(combined({5}, "median", 0), 5);
  EXPECT_EQ(combined({3, std::nan(""), 1}, "share", 0.9), 2) << "the mean of the known values";
}

// Two of ten replicates break a limit or fail. share(0.8) keeps the point, share(0.9) does not.
TEST(Combined, ShareOfTheReplicates) {
  JournalHead head;
  head.replicates = 10;
  head.combine = "share";
  head.objectives = {{"speed", true}};
  std::vector<Brief> runs(10);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    runs[k].run = k;
    runs[k].outcome = "done";
    runs[k].verdict = k == 3 ? Word::infeasible : Word::feasible;
    runs[k].score.emplace();
    runs[k].score->objectives[0] = static_cast<double>(k);
    runs[k].score->violation = k == 3 ? 0.5 : 0;
  }
  runs[7].outcome = "diverged";
  runs[7].verdict = Word::failed;
  head.quantile = 0.8;
  const PointResult kept = point_result(head, runs);
  EXPECT_TRUE(kept.kept());
  EXPECT_EQ(kept.feasible_share(), 0.8);
  EXPECT_NEAR(kept.score.objectives[0], 38.0 / 9, 1e-15) << "the mean of 0 to 9 without 7";
  head.quantile = 0.9;
  EXPECT_FALSE(point_result(head, runs).kept());
  EXPECT_EQ(point_result(head, runs).failed, 0U) << "one failed run of ten is tolerated";
  EXPECT_EQ(point_result(head, runs).score.violation, 0.5);
  head.quantile = 1;
  EXPECT_EQ(point_result(head, runs).failed, 1U);
}

/// The quantile of a share of whole hundredths is computed in whole numbers. It is the least value that this share of the
/// values does not exceed.
TEST(Combined, QuantilesCountInWholeNumbers) {
  for (std::size_t count = 1; count <= 200; ++count) {
    std::vector<double> values;
    for (std::size_t k = 1; k <= count; ++k) values.push_back(static_cast<double>(k));
    for (std::size_t hundredths = 0; hundredths <= 100; ++hundredths) {
      const std::size_t least = std::max<std::size_t>(1, (hundredths * count + 99) / 100);
      EXPECT_EQ(combined(values, "quantile", static_cast<double>(hundredths) / 100), static_cast<double>(least))
          << hundredths << " % of " << count;
    }
  }
}

TEST(Better, OrdersFeasibleBeforeInfeasibleBeforeFailed) {
  const PointResult good{0, 1, 0, {{0.1}, 0}};
  const PointResult fast{1, 1, 0, {{0.2}, 0}};
  const PointResult broken{2, 1, 0, {{0.9}, 0.5}};
  const PointResult worse{3, 1, 0, {{9}, 0.6}};
  const PointResult lived{4, 1, 1, {}, 3};
  const PointResult died{5, 1, 1, {}, 1};
  const std::vector<PointResult> all{died, worse, good, lived, broken, fast};
  EXPECT_EQ(ranked(all, true), (std::vector<std::size_t>{5, 2, 4, 1, 3, 0}));
  EXPECT_EQ(ranked(all, false), (std::vector<std::size_t>{2, 5, 4, 1, 3, 0}));
}

}  // namespace
}  // namespace gaitlab::studies
