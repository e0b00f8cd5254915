// Tests of the detection of curves that coincide in a figure.
#include "report/figures/run/coincide.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gaitlab::test {
namespace {

using namespace report;
using Groups = std::vector<std::vector<std::size_t>>;

/// Groups of coinciding curves with eleven rows one second apart. The figure shows the last five rows.
Groups groups(const std::vector<std::vector<double>>& values, double from = 6) {
  std::vector<double> time;
  for (int k = 0; k <= 10; ++k) time.push_back(k);
  RunCurves panel{from};
  panel.values = values;
  return coinciding(std::vector<std::vector<double>>(values.size(), time), {panel});
}

std::vector<double> wave(double size, double above = 0, double start = 0) {
  std::vector<double> values;
  for (int k = 0; k <= 10; ++k) values.push_back((k < 6 ? start : 0) + (k % 2 == 0 ? size : -size) + above);
  return values;
}

TEST(Coincide, WithinHalfAPercentOfTheRangeOfThePair) {
  EXPECT_EQ(groups({wave(1), wave(1, 0.0099)}), (Groups{{0, 1}}));
  EXPECT_EQ(groups({wave(1), wave(1, 0.0101)}), Groups{});
  EXPECT_EQ(groups({wave(10), wave(10, 0.099), wave(1)}), (Groups{{0, 1}}));
  // The tolerance for small curves does not increase with a large curve in the same panel.
  EXPECT_EQ(groups({wave(0.1), wave(0.1, 0.01), wave(100)}), Groups{});
}

TEST(Coincide, OnlyWhatIsShownCounts) {
  EXPECT_EQ(groups({wave(1), wave(1, 0, 5)}), (Groups{{0, 1}}));
  EXPECT_EQ(groups({wave(1), wave(1, 0, 5)}, 0), Groups{});
}

/// Any two curves of a group coincide. Curves 0 and 2 are not in one group, although curve 1 coincides with both.
TEST(Coincide, AnyTwoOfAGroupDo) {
  EXPECT_EQ(groups({wave(1), wave(1, 0.0075), wave(1, 0.015), wave(1, 0.008)}), (Groups{{0, 1, 3}}));
  EXPECT_EQ(groups({wave(1), wave(2), wave(2), wave(1)}), (Groups{{0, 3}, {1, 2}}));
}

TEST(Coincide, FlatCurvesThatDifferByRounding) {
  EXPECT_EQ(groups({wave(0), wave(0, 1e-17)}), (Groups{{0, 1}}));
  EXPECT_EQ(groups({wave(0), wave(0, 1e-5)}), Groups{});
}

TEST(Coincide, WhatHasNoValuesCoincidesWithNothing) {
  EXPECT_EQ(groups({wave(NAN), wave(NAN)}), Groups{});
  EXPECT_EQ(groups({{}, {}}), Groups{});
  RunCurves panel;
  panel.values = {{1, 2}, {1, 2, 3}};
  EXPECT_EQ(coinciding({{0, 1}, {0, 1, 2}}, {panel}), Groups{});
  EXPECT_EQ(coinciding({{0, 1}, {0, 1}}, {}), Groups{});
}

/// Curves coincide only if they coincide in all panels.
TEST(Coincide, InAllPanels) {
  RunCurves same;
  same.values = {{1, 2}, {1, 2}};
  RunCurves other;
  other.values = {{1, 2}, {1, 3}};
  EXPECT_EQ(coinciding({{0, 1}, {0, 1}}, {same}), (Groups{{0, 1}}));
  EXPECT_EQ(coinciding({{0, 1}, {0, 1}}, {same, other}), Groups{});
}

}  // namespace
}  // namespace gaitlab::test
