#include "core/names.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gaitlab {

namespace {

enum class Leg { left, right2, middle };
enum class Short { one, two, three };
enum class Turned { one, two };
enum class Unnamed { one };

}  // namespace

template <>
struct EnumNames<Leg> {
  struct Row {
    Leg value;
    const char* text;
    int feet;
  };
  static constexpr Row kTable[] = {{Leg::left, "left", 1}, {Leg::right2, "right", 2}, {Leg::middle, "in the middle", 3}};
};
template <>
struct EnumNames<Short> {
  static constexpr EnumName<Short> kTable[] = {{Short::one, "one"}, {Short::two, "two"}};
};
template <>
struct EnumNames<Turned> {
  static constexpr EnumName<Turned> kTable[] = {{Turned::two, "two"}, {Turned::one, "one"}};
};

namespace {

TEST(EnumNames, ValueToNameAndBack) {
  EXPECT_STREQ(name_of(Leg::right2), "right");
  EXPECT_EQ(named<Leg>("in the middle"), Leg::middle);
  EXPECT_EQ(named<Leg>("middle"), std::nullopt);
  EXPECT_EQ(named<Leg>(""), std::nullopt);
  EXPECT_EQ(std::vector<std::string>(enum_names<Leg>().begin(), enum_names<Leg>().end()),
            (std::vector<std::string>{"left", "right", "in the middle"}));
}

TEST(EnumNames, ATableHasRoomForFurtherColumns) { EXPECT_EQ(enum_row(Leg::middle).feet, 3); }

TEST(EnumNames, ATableThatLacksAValueOrHasAnotherOrderIsNotWhole) {
  EXPECT_TRUE(all_named<Leg>());
  EXPECT_FALSE(all_named<Short>());
  EXPECT_FALSE(all_named<Turned>());
  EXPECT_FALSE(NamedEnum<Unnamed>);
}

TEST(EnumNames, CompilersTellEnumeratorsFromOtherValues) {
  EXPECT_TRUE(is_enumerator<Leg::right2>());  // name with a digit at the end
  EXPECT_TRUE(is_enumerator<static_cast<Leg>(2)>());
  EXPECT_FALSE(is_enumerator<static_cast<Leg>(3)>());
  EXPECT_FALSE(is_enumerator<static_cast<Leg>(10)>());
}

}  // namespace
}  // namespace gaitlab
