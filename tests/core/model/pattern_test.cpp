#include "core/model/pattern.h"

#include <gtest/gtest.h>

namespace gaitlab {
namespace {

TEST(Pattern, StarsAndQuestionMarks) {
  EXPECT_TRUE(glob("", ""));
  EXPECT_TRUE(glob("*", ""));
  EXPECT_TRUE(glob("*", "anything"));
  EXPECT_TRUE(glob("joint.*", "joint.0.angle"));
  EXPECT_TRUE(glob("joint.*.angle", "joint.12.angle"));
  EXPECT_TRUE(glob("*.angle", "joint.angle.angle"));
  EXPECT_TRUE(glob("j?int.**.a*", "joint.1.angle"));
  EXPECT_TRUE(glob("*a*b*c", "xxaxxbxxbxxc"));
  EXPECT_FALSE(glob("", "x"));
  EXPECT_FALSE(glob("?", ""));
  EXPECT_FALSE(glob("joint.*", "base.x"));
  EXPECT_FALSE(glob("joint.?.angle", "joint.12.angle"));
  EXPECT_FALSE(glob("*.angle", "joint.0.angles"));
  EXPECT_FALSE(glob("*a*b*c", "xxaxxbxxcx"));
}

TEST(Pattern, ManyStarsStayCheap) { EXPECT_FALSE(glob("*a*a*a*a*a*a*a*a*a*b", std::string(5000, 'a'))); }

TEST(Pattern, IsWhatHoldsAStarOrAQuestionMark) {
  for (const char* pattern : {"*", "m?/active", "*/active", "m3/*"}) EXPECT_TRUE(is_pattern(pattern)) << pattern;
  for (const char* name : {"", "m3/active", "default"}) EXPECT_FALSE(is_pattern(name)) << name;
}

}  // namespace
}  // namespace gaitlab
