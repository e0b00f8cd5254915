#include "core/math/functions.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

namespace gaitlab::math {
namespace {

TEST(Sines, HaveTheBitsOfSin) {
  for (std::size_t count = 0; count < 300; ++count) {
    std::vector<double> angles(count);
    for (std::size_t k = 0; k < count; ++k)
      angles[k] = (static_cast<double>(k) - 7.3) * static_cast<double>(count * count + 1) / 40;
    std::vector<double> all = angles;
    sines(all);
    for (std::size_t k = 0; k < count; ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(all[k]), std::bit_cast<std::uint64_t>(sin(angles[k]))) << angles[k];
  }
}

}  // namespace
}  // namespace gaitlab::math
