#include "core/recording/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace gaitlab {
namespace {

constexpr double kSpacing = 0.005;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

using Signal = std::function<double(double)>;

Signal sine(double frequency, double late = 0, double amplitude = 1) {
  return [=](double t) { return amplitude * std::sin(2 * std::numbers::pi * frequency * (t - late)); };
}

// Trace with one column per signal, named x0, x1 ..., in rad.
Trace sampled(const std::vector<Signal>& signals, double duration = 20, double spacing = kSpacing) {
  Trace trace;
  trace.columns = {{"t", "s", "time"}};
  for (std::size_t i = 0; i < signals.size(); ++i) trace.columns.push_back({"x" + std::to_string(i), "rad", "a signal"});
  const auto last = static_cast<int>(std::lround(duration / spacing));
  for (int k = 0; k <= last; ++k) {
    trace.values.push_back(k * spacing);
    for (const Signal& signal : signals) trace.values.push_back(signal(k * spacing));
  }
  return trace;
}

ColumnDifference difference(const Signal& a, const Signal& b, double duration = 20) {
  const TraceDifference found = compare(sampled({a}, duration), sampled({b}, duration));
  EXPECT_EQ(found.findings, std::vector<std::string>{});
  EXPECT_EQ(found.columns.size(), 1U);
  return found.columns.front();
}

Trace table(const std::vector<std::string>& names, SpilledVector<double> values) {
  Trace trace;
  for (const std::string& name : names) trace.columns.push_back({name, {}, {}});
  trace.values = std::move(values);
  return trace;
}

using Sentences = std::vector<std::string>;

TEST(Compare, EqualTraces) {
  const ColumnDifference d = difference(sine(1), sine(1));
  EXPECT_TRUE(d.equal);
  EXPECT_EQ(d.rms, 0);
  EXPECT_EQ(d.relative_maximum, 0);
  EXPECT_FALSE(d.first_divergence);
  EXPECT_EQ(d.time_shift, 0);
  EXPECT_EQ(d.rms_after_shift, 0);
}

TEST(Compare, LateSineHasItsShift) {
  for (const double frequency : {0.25, 1.0, 4.0}) {
    for (const double late : {0.0123, -0.0123, 0.0004, 0.105}) {
      const ColumnDifference d = difference(sine(frequency), sine(frequency, late));
      // The errors of parabola and cubic are (w h)^3 and (w h)^4 of a sample, at most 2e-3 (at 4 Hz).
      const double wrong = 2e-3 * kSpacing;
      EXPECT_NEAR(d.time_shift, late, wrong) << frequency << " Hz";
      const double w = 2 * std::numbers::pi * frequency;
      EXPECT_LT(d.rms_after_shift, w * wrong) << frequency << " Hz, late by " << late;
      // sin(w t) - sin(w (t - s)) has the amplitude 2 sin(w s / 2). The trace has one row more than whole periods, an error of
      // 1/4001.
      EXPECT_NEAR(d.rms, std::numbers::sqrt2 * std::abs(std::sin(w * late / 2)), 5e-4 * d.rms);
    }
  }
}

TEST(Compare, LateRampHasItsShift) {
  const auto walk = [](double late) { return [=](double t) { return 0.1 * (t - late) + 0.001 * std::sin(9 * (t - late)); }; };
  const ColumnDifference d = difference(walk(0), walk(0.2));
  EXPECT_NEAR(d.time_shift, 0.2, 2e-3 * kSpacing);
}

TEST(Compare, LateByAPeriodLessABitIsABitEarly) {
  EXPECT_NEAR(difference(sine(2.5), sine(2.5, 0.38)).time_shift, -0.02, 2e-3 * kSpacing);
}

TEST(Compare, StillFallingAtTheEdgeOfTheReachIsATrendAndNoShift) {
  // For a trace of 2 s, the largest time shift that is searched is 0.1 s.
  const auto ramp = [](double t) { return t; };
  const auto late = [](double t) { return t - 0.3; };
  EXPECT_EQ(difference(ramp, late, 2).time_shift, 0.0);
}

TEST(Compare, LargerIsNotLate) {
  const ColumnDifference d = difference(sine(1), sine(1, 0, 1.1));
  EXPECT_EQ(d.time_shift, 0);
  EXPECT_EQ(d.rms_after_shift, d.rms);
  EXPECT_NEAR(d.range, 2, 1e-12);  // rows coincide with the extremes of the sine
  EXPECT_EQ(d.scale, d.range);
  EXPECT_NEAR(d.maximum, 0.1, 1e-12);
  EXPECT_NEAR(d.relative_maximum, 0.05, 1e-12);
  EXPECT_NEAR(d.relative_rms, 0.05 / std::numbers::sqrt2, 0.05 * 5e-4);
  EXPECT_FALSE(d.equal);
}

TEST(Compare, OtherShapeIsNotLate) {
  const ColumnDifference d = difference(sine(1), [](double t) { return sine(1)(t) + 0.1 * sine(3.7)(t); });
  EXPECT_EQ(d.time_shift, 0);
  EXPECT_EQ(d.rms_after_shift, d.rms);
}

TEST(Compare, FirstDivergenceIsAboveTheThreshold) {
  const auto parting = [](double t) { return sine(1)(t) + (t > 7 ? 1e-3 * (t - 7) : 0); };
  const Trace a = sampled({sine(1)});
  const Trace b = sampled({parting});
  EXPECT_NEAR(*compare(a, b).columns[0].first_divergence, 7.005, 1e-9);
  EXPECT_NEAR(*compare(a, b, {{"*"}, 1e-3}).columns[0].first_divergence, 9.005, 1e-9);  // first row beyond the tolerance
  EXPECT_FALSE(compare(a, b, {{"*"}, 0.1}).columns[0].first_divergence);
}

TEST(Compare, ConstantColumnsAreRelativeToTheirMagnitude) {
  const auto constant = [](double value) { return [=](double) { return value; }; };
  const ColumnDifference near = difference(constant(5), constant(5.5));
  EXPECT_EQ(near.range, 0);
  EXPECT_EQ(near.scale, 5.5);
  EXPECT_NEAR(near.relative_maximum, 0.5 / 5.5, 1e-15);
  EXPECT_EQ(near.first_divergence, 0.0);
  const ColumnDifference zero = difference(constant(0), constant(0));
  EXPECT_EQ(zero.relative_rms, 0);
  EXPECT_EQ(zero.scale, 1e-9);
  const ColumnDifference from_zero = difference(constant(0), constant(-2));
  EXPECT_EQ(from_zero.relative_rms, 1);
  const ColumnDifference signs = difference(constant(0), constant(-0.0));
  EXPECT_FALSE(signs.equal);
  EXPECT_EQ(signs.maximum, 0);
  EXPECT_FALSE(signs.first_divergence);
}

TEST(Compare, NotFiniteIsToldAndLeftOut) {
  const Trace a = table({"t", "x", "y"}, {0, 1, kNoNumber, 1, 2, kInf, 2, 3, 5, 3, 4, 6});
  const Trace b = table({"t", "x", "y"}, {0, 1, kNoNumber, 1, 2, kInf, 2, kNoNumber, 5, 3, 4.5, 6});
  const TraceDifference found = compare(a, b);
  EXPECT_EQ(found.findings,
            (Sentences{"x: 1 value of B not finite, the first at t = 2 s", "y: 2 values of A not finite, the first at t = 0 s",
                       "y: 2 values of B not finite, the first at t = 0 s"}));
  EXPECT_EQ(found.columns[0].maximum, 0.5);
  EXPECT_EQ(found.columns[0].rms, std::sqrt(0.25 / 3));
  EXPECT_EQ(found.columns[0].first_divergence, 2.0);
  EXPECT_TRUE(found.columns[1].equal);
  EXPECT_EQ(found.columns[1].maximum, 0);
}

TEST(Compare, OtherColumnsAndUnits) {
  Trace a = table({"t", "a", "b", "c"}, {0, 1, 2, 3});
  Trace b = table({"t", "c", "d", "b"}, {0, 3, 4, 2});
  a.columns.change([](auto& columns) { columns[2].unit = "V"; });
  b.columns.change([](auto& columns) {
    columns[3].unit = "N m";
    columns[1].unit = "rad";
  });
  const TraceDifference found = compare(a, b);
  EXPECT_EQ(found.findings, (Sentences{"1 column in A only: a", "1 column in B only: d", "b: in V in A, in N m in B"}));
  EXPECT_EQ(found.only_a, Sentences{"a"});
  EXPECT_EQ(found.only_b, Sentences{"d"});
  ASSERT_EQ(found.columns.size(), 2U);
  EXPECT_EQ(found.columns[0].name, "b");
  EXPECT_EQ(found.columns[1].unit, "rad");
  EXPECT_TRUE(found.columns[1].equal);
}

TEST(Compare, ColumnsAreChosenByPattern) {
  const Trace a = table({"t", "joint.0.angle", "joint.1.angle", "base.x"}, {0, 1, 2, 3});
  const Trace b = table({"t", "joint.0.angle"}, {0, 1});
  const TraceDifference found = compare(a, b, {{"joint.?.angle"}});
  EXPECT_EQ(found.findings, Sentences{"1 column in A only: joint.1.angle"});
  EXPECT_EQ(found.columns.size(), 1U);
}

TEST(Compare, ManyMissingColumnsAreShortened) {
  std::vector<std::string> names{"t"};
  for (int i = 0; i < 12; ++i) names.push_back("c" + std::to_string(i));
  const TraceDifference found = compare(table(names, SpilledVector<double>(13, 0)), table({"t"}, {0}));
  EXPECT_EQ(found.findings, Sentences{"12 columns in A only: c0, c1, c2, c3, c4, c5, c6, c7 and 4 more"});
  EXPECT_EQ(found.only_a.size(), 12U);
}

TEST(Compare, RowsArePairedByTime) {
  // Traces of different lengths or periods are compared at common times.
  const TraceDifference shorter = compare(sampled({sine(1)}, 20), sampled({sine(1)}, 10));
  EXPECT_EQ(shorter.findings, Sentences{"A has 4001 rows, B has 2001"});
  EXPECT_EQ(shorter.rows, 2001U);
  EXPECT_TRUE(shorter.columns[0].equal);
  const TraceDifference coarser = compare(sampled({sine(1)}, 1, 0.005), sampled({sine(1, 0.01)}, 1, 0.015));
  EXPECT_EQ(coarser.findings,
            (Sentences{"A has 201 rows, B has 68", "time columns differ: only 67 rows have equal times in A and B"}));
  EXPECT_EQ(coarser.rows, 67U);
  EXPECT_NEAR(coarser.columns[0].time_shift, 0.01, 2e-3 * 0.015);
}

/// Rounding errors are not a difference. In a straight walk, y is about 1e-17 m and must not count as a difference of 100 % of
/// its range.
TEST(Compare, RoundingIsNoDifference) {
  const TraceDifference d =
      compare(table({"t", "base.y"}, {0, 0, 1, 3e-18, 2, -2e-18}), table({"t", "base.y"}, {0, 1e-18, 1, -4e-18, 2, 5e-18}));
  EXPECT_DOUBLE_EQ(d.columns.at(0).scale, 1e-9);
  EXPECT_LT(d.columns.at(0).relative_rms, 1e-8);
}

TEST(Compare, NoCommonTime) {
  const Trace plain = table({"t", "x"}, {0, 1, 1, 2});
  EXPECT_EQ(compare(plain, table({"x", "t"}, {1, 0, 2, 1})).findings,
            Sentences{"B has no first column t: its rows cannot be compared"});
  EXPECT_EQ(compare(table({"t", "x"}, {0, 1, 0, 2}), plain).findings,
            Sentences{"A: t does not increase at row 2: its rows cannot be compared"});
  EXPECT_EQ(compare(plain, table({"t", "x"}, {0, 1, kNoNumber, 2})).findings,
            Sentences{"B: t does not increase at row 2: its rows cannot be compared"});
  const TraceDifference apart = compare(plain, table({"t", "x"}, {0.5, 1, 1.5, 2}));
  EXPECT_EQ(apart.findings, Sentences{"time columns differ: only 0 rows have equal times in A and B"});
  EXPECT_EQ(apart.rows, 0U);
  EXPECT_EQ(compare(Trace{}, Trace{}).findings.size(), 1U);
}

}  // namespace
}  // namespace gaitlab
