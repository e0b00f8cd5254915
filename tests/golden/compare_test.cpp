// Tests of the comparison of a run with its golden: only columns and numbers outside their bands fail.
#include "golden/compare.h"

#include <gtest/gtest.h>

#include <random>

#include "golden/report.h"
#include "tests/golden/golden_sample.h"

namespace gaitlab::test {
namespace {

TEST(GoldenCompare, TheSameRunPassesWithNothingLeft) {
  const Golden golden = sample_golden(walk());
  Golden read = golden;
  read.run = unpack(pack(golden.run.trace), "x");  // rounded as in the file
  read.rounding = mean_squares(golden.run.trace, read.run.trace);
  EXPECT_LE(std::sqrt(read.rounding[1]), 0.5 * read.run.precision[1]);
  EXPECT_GT(read.rounding[1], 0);
  const GoldenDifference d = compare(read, run_of(golden));
  EXPECT_TRUE(d.passed());
  EXPECT_EQ(d.findings, Sentences{});
  for (const ColumnCheck& column : d.columns) {
    EXPECT_EQ(column.rms, 0) << column.name;
    EXPECT_LT(column.maximum, 1e-15) << column.name;  // the comparison subtracts half of the quantisation step
    EXPECT_FALSE(column.outside);
  }
  EXPECT_EQ(d.numbers[0].change, 0);
}

// A difference of a fifth of the quantisation step is measured, although quantisation alone causes an RMS of about a third of a
// step.
TEST(GoldenCompare, MeasuresBelowThePrecision) {
  std::mt19937_64 random(4);
  Trace noise = walk(1001);
  for (std::size_t k = 0; k < 1001; ++k) noise.values[k * 5 + 3] = static_cast<double>(random() >> 11U) * 0x1p-53;
  const Golden golden = sample_golden(noise);
  Golden read = golden;
  read.run = unpack(pack(noise), "x");
  read.rounding = mean_squares(noise, read.run.trace);
  GoldenRun run = run_of(golden);
  const double by = 0.2 * read.run.precision[3];
  for (std::size_t k = 0; k < 1001; ++k) run.trace.values[k * 5 + 3] += random() % 2 == 0 ? by : -by;
  // The rounding errors e = precision / sqrt(12) of 1001 rows change by^2 by 2 by e / sqrt(1001), which is 9 %. The tolerance
  // is three times half of this.
  EXPECT_NEAR(compare(read, run).columns[2].rms * scales(read.run.trace)[3], by, 0.14 * by);
}

TEST(GoldenCompare, WhatStraysFailsAlone) {
  const Golden golden = sample_golden(walk());
  GoldenRun run = run_of(golden);
  const std::size_t width = golden.run.trace.columns.size();
  for (std::size_t k = 50; k < 101; ++k) run.trace.values[k * width + 1] += 2.6 * 1.5e-3;  // 5 bands from 1 s on
  run.numbers[0].value = 0.5004;                                                           // differs by 0.8 bands
  const GoldenDifference d = compare(golden, run);
  EXPECT_FALSE(d.passed());
  EXPECT_EQ(d.findings, Sentences{});
  EXPECT_FALSE(d.columns[0].passed());
  EXPECT_TRUE(d.columns[1].passed());
  EXPECT_TRUE(d.columns[2].passed());
  EXPECT_TRUE(d.columns[3].passed());
  // 51 of 101 rows differ. The tolerance is for the range of a sine with 50 samples per period, which is 0.2 % less than 2.6,
  // and for the relative quantisation step of 1.5e-5.
  EXPECT_NEAR(d.columns[0].rms, 1.5e-3 * std::sqrt(51.0 / 101), 3e-5);
  EXPECT_NEAR(d.columns[0].maximum, 1.5e-3, 3e-5);
  EXPECT_EQ(*d.columns[0].outside, 1.0);
  EXPECT_EQ(d.worst_column()->name, "joint.0.torque");
  EXPECT_TRUE(d.numbers[0].passed());
  EXPECT_NEAR(d.worst_number()->ratio(), 0.8, 1e-12);
  run = run_of(golden);
  run.numbers[0].value = 0.501;
  EXPECT_FALSE(compare(golden, run).passed());
}

TEST(GoldenCompare, NamesJointsAndNotTheirNumbers) {
  const Golden golden = sample_golden(walk());
  GoldenRun run = run_of(golden);
  run.joints = {"m0/active", "m0/passive"};
  GoldenDifference d = compare(golden, run);
  EXPECT_EQ(d.columns[0].name, "joint.0.torque");
  EXPECT_EQ(d.columns[0].label, "m0/active torque");
  EXPECT_EQ(d.columns[3].label, "base.z");
  EXPECT_EQ(d.numbers[1].label, "m0/active torque peak");
  run.trace.values[3 * 5 + 2] = kNan;
  EXPECT_EQ(compare(golden, run).findings, Sentences{"m0/passive torque is not finite at t = 0.06 s"});
  run.trace.columns.change([](auto& columns) { columns[2].name = "joint.7.torque"; });
  d = compare(golden, run);
  EXPECT_EQ(d.findings,
            (Sentences{"1 column only in the golden: m0/passive torque", "1 column only in this run: joint.7.torque"}));
}

// Quantisation errors are not counted as a difference, although they are much larger than three such narrow bands.
TEST(GoldenCompare, RoundingIsNotOutside) {
  Golden golden = sample_golden(walk());
  const Trace exact = golden.run.trace;
  golden.run = unpack(pack(exact), "x");
  golden.rounding = mean_squares(exact, golden.run.trace);
  golden.bands.assign(golden.bands.size(), Band{0, 0, 1e-6});
  GoldenRun run{exact, golden.numbers};
  EXPECT_FALSE(compare(golden, run).columns[0].outside);
  for (std::size_t k = 60; k < 101; ++k) run.trace.values[k * 5 + 1] += 2 * golden.run.precision[1];
  EXPECT_EQ(compare(golden, run).columns[0].outside, 1.2);
}

TEST(GoldenCompare, LateIsToldApartFromAnotherShape) {
  const Golden golden = sample_golden(walk());
  GoldenRun run = run_of(golden);
  for (std::size_t k = 0; k < 101; ++k)
    run.trace.values[k * 5 + 1] = 1.3 * std::sin(2 * std::numbers::pi * (static_cast<double>(k) * kSpacing - 0.013));
  const ColumnCheck torque = compare(golden, run).columns[0];
  EXPECT_FALSE(torque.passed());
  EXPECT_NEAR(torque.time_shift, 0.013, 1e-4);  // error of time_shift is (w h)^3 rows, 0.002 * 0.02 s
  EXPECT_LT(torque.rms_after_shift, 0.01 * torque.rms);
}

TEST(GoldenCompare, FormComesFirst) {
  const Golden golden = sample_golden(walk());
  GoldenRun run = run_of(golden);
  run.trace.values[3 * 5 + 2] = kNan;
  GoldenDifference d = compare(golden, run);
  EXPECT_EQ(d.findings, Sentences{"joint.1.torque is not finite at t = 0.06 s"});
  EXPECT_EQ(d.columns.size(), 3U);
  EXPECT_FALSE(d.passed());

  run = run_of(golden);
  run.trace = walk(61);
  d = compare(golden, run);
  EXPECT_EQ(d.findings, Sentences{"61 rows, in the golden 101"});
  EXPECT_EQ(d.columns.size(), 4U);
  EXPECT_TRUE(d.columns[0].passed());
  EXPECT_FALSE(d.passed());

  run = run_of(golden);
  run.trace.columns.change([](auto& columns) { columns[2].name = "joint.7.torque"; });
  EXPECT_EQ(compare(golden, run).findings, (Sentences{"1 column only in the golden: joint.1.torque",
                                                      "1 column only in this run: "
                                                      "joint.7.torque"}));
  run = run_of(golden);
  for (std::size_t k = 0; k < 101; ++k) run.trace.values[k * 5] *= 0.5;
  d = compare(golden, run);
  EXPECT_EQ(d.findings, Sentences{"a row every 0.01 s, in the golden every 0.02 s"});
  EXPECT_TRUE(d.columns.empty());
  EXPECT_EQ(d.worst_column(), nullptr);

  run = run_of(golden);
  run.numbers[1].value = kNan;
  d = compare(golden, run);
  EXPECT_EQ(d.findings, Sentences{"m0/active torque peak is not finite"});
  EXPECT_FALSE(d.numbers[1].passed());
  EXPECT_EQ(d.worst_number()->name, "m0/active.torque.peak");
  run.numbers.pop_back();
  EXPECT_EQ(compare(golden, run).findings, Sentences{"m0/active torque peak is only in the golden"});
  EXPECT_FALSE(compare(golden, {}).passed());
}

}  // namespace
}  // namespace gaitlab::test
