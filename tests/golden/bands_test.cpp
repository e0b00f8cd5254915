// Tests of the bands of goldens, and of the scales of their columns.
#include "golden/bands.h"

#include <gtest/gtest.h>

#include <span>
#include <stdexcept>

#include "tests/golden/golden_sample.h"

namespace gaitlab::test {
namespace {

TEST(GoldenBands, ScalesHaveFloors) {
  const std::vector<double> scale = scales(walk());
  EXPECT_NEAR(scale[1], 2.6, 0.01);
  EXPECT_EQ(scale[2], 1e-3 * scale[1]);  // the range of this column is only 2e-7
  EXPECT_NEAR(scale[3], 1.2, 0.01);
  EXPECT_EQ(scale[4], 1e-6);  // constant, and no other column is in m
  EXPECT_EQ(scales({{"a", "m", -2}, {"b", "m", 1e-9}, {"c", "N m", 0}}), (std::vector<double>{2, 2e-3, 1e-6}));
}

TEST(GoldenBands, TheLargestPartIsTheBand) {
  const Trace trace = walk();
  const GoldenRun base{trace, {{"distance", "m", 2}}};
  const auto shifted = [&](std::size_t column, double by, double distance) {
    GoldenRun run{trace, {{"distance", "m", distance}}};
    for (std::size_t k = 0; k < trace.rows(); ++k) run.trace.values[k * trace.columns.size() + column] += by;
    return run;
  };
  const std::vector<GoldenRun> ensemble{shifted(1, -3e-4, 1.998), shifted(1, 1e-4, 2.001)};
  const Bands bands = calibrate(base, ensemble, shifted(3, 5e-4, 2.01));
  const std::vector<double> scale = scales(trace);
  // The tolerance 1e-12 is for the rounding error of 1.3 + 1e-4.
  EXPECT_NEAR(bands.columns[1].ensemble, 10 * 3e-4 / scale[1], 1e-12);
  EXPECT_EQ(bands.columns[1].halving, 0);
  EXPECT_NEAR(bands.columns[3].halving, 3 * 5e-4 / scale[3], 1e-12);
  EXPECT_EQ(bands.columns[3].ensemble, 0);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(bands.columns[i].floor, 1e-6);
  EXPECT_EQ(bands.columns[1].width(), bands.columns[1].ensemble);
  EXPECT_NEAR(bands.numbers[0].ensemble, 10 * 0.001, 1e-12);
  EXPECT_NEAR(bands.numbers[0].halving, 3 * 0.005, 1e-12);
  EXPECT_EQ(bands.numbers[0].floor, 1e-6);
}

/// A column whose range is below a millionth of its natural scale is constant, and so is a column whose band is wide only
/// because its range is small.
TEST(GoldenBands, AConstantColumnHasABandOfItsNaturalScale) {
  Trace trace = walk();
  trace.columns = {{"t", "s", {}}, {"a", "N m", {}}, {"b", "A", {}}, {"c", "rad", {}}, {"base.z", "m", {}}};
  GoldenRun base{trace, {}};
  base.natural = {0, 0.4, 0.4, 1, 0.5};  // the ranges are 2.6, 2e-7, 1.2 and 0
  GoldenRun other = base;
  const auto shift = [&](std::size_t column, double by) {
    for (std::size_t k = 0; k < trace.rows(); ++k) other.trace.values[k * trace.columns.size() + column] += by;
  };
  shift(2, 1e-8);
  shift(3, 1e-3);
  shift(4, 1e-5);
  const std::vector<Band> bands = calibrate(base, std::span(&other, 1), base).columns;
  EXPECT_EQ(bands[1].constant, 0);
  EXPECT_EQ(bands[1].floor, 1e-6);
  EXPECT_EQ(bands[2].constant, 0.4);
  EXPECT_EQ(bands[2].width(), 1e-5);
  EXPECT_NEAR(bands[2].ensemble, 10 * 1e-8 / 0.4, 1e-12);
  EXPECT_EQ(bands[3].constant, 0) << "10 mrad are more than 1e-5 of the scale";
  EXPECT_EQ(bands[4].constant, 0.5);
  EXPECT_NEAR(bands[4].width(), 10 * 1e-5 / 0.5, 1e-12) << "a constant column that another start moves";
  EXPECT_EQ(scales(trace, bands), (std::vector<double>{scales(trace)[0], scales(trace)[1], 0.4, scales(trace)[3], 0.5}));

  base.natural = {0, 0.4, 0.05, 1, 0.5};  // b varies by 4e-6 of its scale, and its band would be half its range
  const std::vector<Band> wide = calibrate(base, std::span(&other, 1), base).columns;
  EXPECT_EQ(wide[2].constant, 0.05);
  EXPECT_EQ(wide[2].width(), 1e-5);
}

TEST(GoldenBands, NumbersAreFoundByName) {
  const Trace trace = walk();
  const GoldenRun base{trace, {{"distance", "m", 2}}};
  const GoldenRun longer{trace, {{"cost", "", 9}, {"distance", "m", 2.002}}};
  const Bands bands = calibrate(base, std::span(&longer, 1), longer);
  EXPECT_NEAR(bands.numbers[0].ensemble, 10 * 0.001, 1e-12);
  EXPECT_NEAR(bands.numbers[0].halving, 3 * 0.001, 1e-12);
  EXPECT_THROW(calibrate(longer, std::span(&base, 1), base), std::invalid_argument);
}

}  // namespace
}  // namespace gaitlab::test
