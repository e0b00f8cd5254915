// Tests of the rows of long runs that figures and pages get.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/recording/recording.h"

namespace gaitlab {
namespace {

/// Rows of t, t^2 (trace) and -t (rest): 24 bytes each.
Recording of_rows(std::size_t rows) {
  Recording r;
  r.trace.columns = {{"t", "s", ""}, {"square", "", ""}};
  r.rest.columns = {{"minus", "", ""}};
  for (std::size_t k = 0; k < rows; ++k) {
    const auto t = static_cast<double>(k);
    r.trace.values.insert(r.trace.values.end(), {t, t * t});
    r.rest.values.push_back(-t);
  }
  return r;
}

std::vector<double> times(const Recording& r) { return r.series("t").values(); }

TEST(ThinRows, KeepsRowsThatAreFew) {
  Recording r = of_rows(10);
  EXPECT_FALSE(thin_rows(r, 240).has_value());
  EXPECT_EQ(r.rows(), 10U);
  EXPECT_TRUE(r.hash_of_all.empty());
}

TEST(ThinRows, KeepsEveryKthAndTheLast) {
  // Of 240 bytes, every second row fits into 239 bytes, and every third row into 100.
  for (const auto& [most, kept] : {std::pair<std::size_t, std::vector<double>>{239, {0, 2, 4, 6, 8, 9}}, {100, {0, 3, 6, 9}}}) {
    Recording r = of_rows(10);
    const std::string hash_before = r.trace_hash();
    std::optional<AllRows> all = thin_rows(r, most);
    ASSERT_TRUE(all.has_value());
    EXPECT_EQ(times(r), kept);
    for (std::size_t k = 0; k < r.rows(); ++k) {
      EXPECT_EQ(r.trace.at(k, 1), kept[k] * kept[k]);
      EXPECT_EQ(r.rest.at(k, 0), -kept[k]);
    }
    EXPECT_EQ(r.trace_hash(), hash_before);
    all->swap(r);
    EXPECT_EQ(r.rows(), 10U);
    EXPECT_EQ(hash(r.trace), hash_before);
  }
}

/// Two rows become one. If a dock is pushed with 50 N and then pulled with 30 N, the merged row has the pull of 30 N.
TEST(HalvedLoads, KeepTheWorst) {
  Trace loads;
  loads.columns = {
      {"t", "s", ""}, {"dock.1.tension", "N", ""}, {"dock.1.shear", "N", ""}, {"stability", "m", ""}, {"path", "m", ""}};
  loads.values = {0, 0, 0, 0, 0, 1, 30, -5, 0.02, 1, 2, -50, 3, NAN, 2};
  halve_rows(loads);
  ASSERT_EQ(loads.rows(), 2U);
  const std::span<const double> row = loads.row(1);
  EXPECT_EQ(std::vector<double>(row.begin(), row.end()), (std::vector<double>{2, 30, -5, 0.02, 2}));
  loads.values = {0, 0, 0, 0, 0, 1, -50, 3, 0.05, 1, 2, 30, -5, 0.02, 2};
  halve_rows(loads);
  EXPECT_EQ(loads.at(1, 1), 30);
  EXPECT_EQ(loads.at(1, 3), 0.02);
}

}  // namespace
}  // namespace gaitlab
