// Tests of the name that a message suggests.
#include <gtest/gtest.h>

#include "core/errors.h"

namespace gaitlab {
namespace {

TEST(NearestNames, OfEquallySimilarNamesTheOneWithTheSameBeginning) {
  EXPECT_EQ(nearest("sped", {"seed", "speed"}), "speed");
  EXPECT_EQ(nearest("sped", {"speed", "seed"}), "speed");
  EXPECT_EQ(nearest("m0/activ", {"m1/active", "m0/active"}), "m0/active");
  EXPECT_EQ(nearest("ab", {"ax", "ay"}), "ax") << "the first of equals";
}

TEST(NearestNames, AbbreviationsAndTextsThatAreTooLong) {
  EXPECT_EQ(nearest("freq", {"frequency", "amplitude"}), "frequency");
  EXPECT_EQ(nearest("servomotor", {"dc_motor", "servo", "torque"}), "servo");
  EXPECT_EQ(nearest("servomotor", {"servo", "servomo"}), "servomo");
  EXPECT_EQ(nearest("pidfoo", {"pid"}), "") << "a short name is the beginning of many words";
  EXPECT_EQ(nearest("", {"a", "speed"}), "a");
  EXPECT_EQ(nearest("zzzzzz", {"speed"}), "");
}

}  // namespace
}  // namespace gaitlab
