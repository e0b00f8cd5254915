#include "core/simulation/support.h"

#include <gtest/gtest.h>

namespace gaitlab {
namespace {

std::vector<std::size_t> names(const std::vector<SupportElement>& support) {
  std::vector<std::size_t> list;
  for (const SupportElement& s : support) list.push_back(s.element);
  return list;
}

TEST(Support, GrowsUntilItHoldsTheCentreOfMass) {
  const std::vector<SupportElement> legs = {
      {0, 0.0, {1, 1, 0}}, {1, 0.0, {1, -1, 0}}, {2, 0.02, {-1, 0, 0}}, {3, 0.5, {-2, 0, 0}}};
  EXPECT_EQ(names(support_elements(legs, Vec3(0, 0, 1))), (std::vector<std::size_t>{0, 1, 2}));
  // It would topple whatever it stood on: the lowest carry it for now.
  EXPECT_EQ(names(support_elements(legs, Vec3(5, 0, 1))), (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(support_elements({}, Vec3::Zero()).empty());
}

}  // namespace
}  // namespace gaitlab
