#include "core/recording/trace.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gaitlab {
namespace {

Trace two_columns() { return {{{"t", "s", ""}, {"joint.0.angle", "rad", ""}}, {0.0, 1.5, 0.1, -2.5}}; }

TEST(Trace, FindsAColumnByItsWholeName) {
  const Trace trace = two_columns();
  EXPECT_EQ(trace.find("t"), 0U);
  EXPECT_EQ(trace.find("joint.0.angle"), 1U);
  EXPECT_EQ(trace.find("joint.0"), trace.columns.size());
}

// A trace finds every column, and the first of two columns with equal names. Few names are compared one by one; many names are
// in a hash table.
TEST(Trace, FindsEachOfManyColumnsAndTheFirstOfTwoOfOneName) {
  Trace trace;
  EXPECT_EQ(trace.find(""), 0U);
  for (std::size_t added = 0; added < 1000; ++added) {
    trace.columns.push_back({fmt::format("joint.{}.angle", added), "rad", ""});
    for (const std::size_t old : {std::size_t{0}, added / 2, added})
      ASSERT_EQ(trace.find(fmt::format("joint.{}.angle", old)), old) << added;
    ASSERT_EQ(trace.find(fmt::format("joint.{}.angle", added + 1)), added + 1);
  }
  trace.columns.push_back({"joint.500.angle", "rad", ""});
  EXPECT_EQ(trace.find("joint.500.angle"), 500U);
  trace.columns.change([](auto& columns) { columns.erase(columns.begin() + 500); });
  EXPECT_EQ(trace.find("joint.500.angle"), 999U);
  EXPECT_EQ(trace.find("joint.501.angle"), 500U);
  const ColumnList made = trace.columns.list();
  for (std::size_t i = 0; i < made.size(); ++i) ASSERT_EQ(made.find(made[i].name), i);
}

TEST(Trace, HashIsTheSameForTheSameTraceOnly) {
  const Trace trace = two_columns();
  EXPECT_EQ(hash(trace), hash(two_columns()));
  EXPECT_EQ(hash(trace).size(), 18U);

  Trace value = two_columns();
  value.values[3] = -2.5000000000000004;
  EXPECT_NE(hash(value), hash(trace));
  Trace sign = two_columns();
  sign.values[0] = -0.0;
  EXPECT_NE(hash(sign), hash(trace));
  Trace name = two_columns();
  name.columns.change([](auto& columns) { columns[1].name = "joint.1.angle"; });
  EXPECT_NE(hash(name), hash(trace));
}

TEST(Trace, HashKeepsNamesApart) {
  const Trace a{{{"ab", "", ""}, {"c", "", ""}}, {}};
  const Trace b{{{"a", "", ""}, {"bc", "", ""}}, {}};
  EXPECT_NE(hash(a), hash(b));
}

// The hashes equal the hashes of an independent program in Python (for a whole file: tests/gates/h5py.sh).
TEST(Trace, HashIsPinned) {
  EXPECT_EQ(hash(Trace{}), "1-68853b6a3912cca3");
  EXPECT_EQ(hash(Trace{{{"a", "", ""}}, {}}), "1-a4ba087e50356aa8");
  EXPECT_EQ(hash(two_columns()), "1-25dabfc01d9ae99a");
}

}  // namespace
}  // namespace gaitlab
