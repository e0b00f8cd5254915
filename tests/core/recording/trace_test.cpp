#include "core/recording/trace.h"

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

TEST(Trace, HashIsTheSameForTheSameTraceOnly) {
  const Trace trace = two_columns();
  EXPECT_EQ(hash(trace), hash(two_columns()));
  EXPECT_EQ(hash(trace).size(), 16U);
  EXPECT_EQ(hash(Trace{}), "cbf29ce484222325");  // FNV-1a's value for no bytes

  Trace value = two_columns();
  value.values[3] = -2.5000000000000004;
  EXPECT_NE(hash(value), hash(trace));
  Trace sign = two_columns();
  sign.values[0] = -0.0;
  EXPECT_NE(hash(sign), hash(trace));
  Trace name = two_columns();
  name.columns[1].name = "joint.1.angle";
  EXPECT_NE(hash(name), hash(trace));
}

TEST(Trace, HashKeepsNamesApart) {
  const Trace a{{{"ab", "", ""}, {"c", "", ""}}, {}};
  const Trace b{{{"a", "", ""}, {"bc", "", ""}}, {}};
  EXPECT_NE(hash(a), hash(b));
}

TEST(Trace, HashIsPinned) {
  // FNV-1a of "a" is published; a NUL follows every name.
  const Trace trace{{{"a", "", ""}}, {}};
  EXPECT_EQ(hash(trace), "089be207b544f1e4");
}

}  // namespace
}  // namespace gaitlab
