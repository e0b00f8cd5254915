// Jobs and rows that are converted to bytes and back are unchanged.
#include "studies/run/parcel.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace gaitlab::studies {
namespace {

Row hostile_row() {
  Row row;
  row.run = 3'999'999'999;
  row.point = "00ff";
  row.scenario = "rubble";
  row.replicate = 7;
  row.seed = -(std::int64_t{1} << 53);
  row.outcome = "plugin";
  row.message = std::string("no\0luck\xff\"\n", 10);
  row.simulated = 0.1 + 0.2;
  row.values = {"0.1", "hopf", ""};
  row.quantities = {
      1.0 / 3, -0.0, std::nan(""), std::numeric_limits<double>::infinity(), std::numeric_limits<double>::denorm_min(),
      1e300,   0.5F, 16777217};
  row.verdict = Word::feasible;
  row.cause = {"voltage", "m5/passive"};
  row.score = Score{{0.1, std::nan(""), -1e-9}, 0.25};
  return row;
}

void expect_same(const Row& a, const Row& b) {
  EXPECT_EQ(a.run, b.run);
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.scenario, b.scenario);
  EXPECT_EQ(a.replicate, b.replicate);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.message, b.message);
  EXPECT_EQ(a.simulated, b.simulated);
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.cause.text(), b.cause.text());
  const auto same = [](double x, double y) {
    EXPECT_TRUE(std::isnan(x) ? std::isnan(y) : std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y))
        << x << " " << y;
  };
  ASSERT_EQ(a.quantities.size(), b.quantities.size());
  for (std::size_t k = 0; k < a.quantities.size(); ++k) same(a.quantities[k], b.quantities[k]);
  ASSERT_EQ(a.score.has_value(), b.score.has_value());
  if (!a.score) return;
  for (std::size_t k = 0; k < kMostObjectives; ++k) same(a.score->objectives[k], b.score->objectives[k]);
  same(a.score->violation, b.score->violation);
}

TEST(Parcel, GivesBackWhatWasPutIn) {
  const std::vector<Row> rows{hostile_row(), Row{}};
  const std::vector<Row> back = rows_of(packed(rows));
  ASSERT_EQ(back.size(), 2U);
  expect_same(back[0], rows[0]);
  expect_same(back[1], rows[1]);
  const std::vector<Job> jobs{{hostile_row(), {"cpg.type=hopf", "seed=3"}, 2, true, true}, {Row{}, {}}};
  const std::vector<Job> again = jobs_of(packed(jobs));
  ASSERT_EQ(again.size(), 2U);
  expect_same(again[0].row, jobs[0].row);
  EXPECT_EQ(again[0].sets, jobs[0].sets);
  EXPECT_EQ(again[0].scenario, 2U);
  EXPECT_TRUE(again[0].estimate);
  EXPECT_TRUE(again[0].whole);
  EXPECT_FALSE(again[1].whole);
  EXPECT_TRUE(again[1].sets.empty());
  EXPECT_FALSE(again[1].estimate);
  EXPECT_TRUE(rows_of(packed(std::span<const Row>())).empty());
}

}  // namespace
}  // namespace gaitlab::studies
