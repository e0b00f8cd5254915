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

TEST(Pattern, RangesOfWholeNumbers) {
  EXPECT_TRUE(glob("m[3-6]/hinge", "m3/hinge"));
  EXPECT_TRUE(glob("m[3-6]/hinge", "m6/hinge"));
  EXPECT_TRUE(glob("m[8-12]/*", "m10/hinge"));
  EXPECT_TRUE(glob("*[3-4]/h", "m14/h"));
  EXPECT_TRUE(glob("m[0-0]/h[1-2]", "m0/h2"));
  EXPECT_FALSE(glob("m[3-6]/hinge", "m7/hinge"));
  EXPECT_FALSE(glob("m[3-6]/hinge", "m36/hinge"));
  EXPECT_FALSE(glob("m[3-6]/hinge", "m/hinge"));
  EXPECT_FALSE(glob("m[6-3]/hinge", "m4/hinge"));
  EXPECT_FALSE(glob("m[1-99999999999999999999]/hinge", "m4/hinge")) << "too large for a number";
  // Other brackets are part of a name, as in the quantities of studies.
  EXPECT_TRUE(glob("torque.peak[m3/*]", "torque.peak[m3/active]"));
  EXPECT_TRUE(glob("a[3-", "a[3-"));
  EXPECT_FALSE(glob("a[3-4]", "a[3-4]"));
}

TEST(Pattern, IsWhatHoldsAStarAQuestionMarkOrARange) {
  for (const char* pattern : {"*", "m?/active", "*/active", "m3/*", "m[3-6]/active"})
    EXPECT_TRUE(is_pattern(pattern)) << pattern;
  for (const char* name : {"", "m3/active", "default", "torque.peak[m3/active]", "m[3]", "m[3-", "m[-3]"})
    EXPECT_FALSE(is_pattern(name)) << name;
}

}  // namespace
}  // namespace gaitlab
