#include "core/names.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gaitlab {

namespace {

enum class Wing { left, right2, middle };
enum class Short { one, two, three };
enum class Turned { one, two };
enum class Unnamed { one };

}  // namespace

template <>
struct EnumNames<Wing> {
  struct Row {
    Wing value;
    const char* text;
    int feet;
  };
  static constexpr Row kTable[] = {{Wing::left, "left", 1}, {Wing::right2, "right", 2}, {Wing::middle, "in the middle", 3}};
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
  EXPECT_STREQ(name_of(Wing::right2), "right");
  EXPECT_EQ(named<Wing>("in the middle"), Wing::middle);
  EXPECT_EQ(named<Wing>("middle"), std::nullopt);
  EXPECT_EQ(named<Wing>(""), std::nullopt);
  EXPECT_EQ(std::vector<std::string>(enum_names<Wing>().begin(), enum_names<Wing>().end()),
            (std::vector<std::string>{"left", "right", "in the middle"}));
}

TEST(EnumNames, ATableHasRoomForFurtherColumns) { EXPECT_EQ(enum_row(Wing::middle).feet, 3); }

TEST(EnumNames, ATableThatLacksAValueOrHasAnotherOrderIsNotWhole) {
  EXPECT_TRUE(all_named<Wing>());
  EXPECT_FALSE(all_named<Short>());
  EXPECT_FALSE(all_named<Turned>());
  EXPECT_FALSE(NamedEnum<Unnamed>);
}

TEST(EnumNames, CompilersTellEnumeratorsFromOtherValues) {
  EXPECT_TRUE(is_enumerator<Wing::right2>());  // name with a digit at the end
  EXPECT_TRUE(is_enumerator<static_cast<Wing>(2)>());
  EXPECT_FALSE(is_enumerator<static_cast<Wing>(3)>());
  EXPECT_FALSE(is_enumerator<static_cast<Wing>(10)>());
}

}  // namespace
}  // namespace gaitlab
