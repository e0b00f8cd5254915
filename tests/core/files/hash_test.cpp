// Hashes equal the test vectors of the authors of FNV.
#include "core/files/hash.h"

#include <gtest/gtest.h>

namespace gaitlab {
namespace {

TEST(Hash, Of64BitIsFnv1a) {
  EXPECT_EQ(hash(""), "cbf29ce484222325");
  EXPECT_EQ(hash("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(hash("foobar"), "85944171f73967e8");
}

TEST(Hash, Of128BitIsFnv1a) {
  EXPECT_EQ(hash128(""), "6c62272e07bb014262b821756295c58d");
  EXPECT_EQ(hash128("a"), "d228cb696f1a8caf78912b704e4a8964");
  EXPECT_EQ(hash128("foobar"), "343e1662793c64bf6f0d3597ba446f18");
}

}  // namespace
}  // namespace gaitlab
