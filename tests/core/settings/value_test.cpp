#include "core/settings/value.h"

#include <gtest/gtest.h>

#include <clocale>
#include <limits>

#include "core/settings/wording.h"

namespace gaitlab {
namespace {

Node plain(const std::string& text) {
  Node node{Node::Kind::scalar};
  node.text = text;
  return node;
}

std::string wrong(const std::string& text) { return read_number(plain(text), "s").wrong; }

TEST(Value, Numbers) {
  EXPECT_EQ(read_number(plain("0.015"), "").value, 0.015);
  EXPECT_EQ(read_number(plain("-1.2"), "").value, -1.2);
  EXPECT_EQ(read_number(plain("+1"), "").value, 1);
  EXPECT_EQ(read_number(plain(".5"), "").value, 0.5);
  EXPECT_EQ(read_number(plain("1."), "").value, 1);
  EXPECT_EQ(read_number(plain("2.5E-5"), "").value, 2.5e-5);
  EXPECT_EQ(read_number(plain("0e0"), "").value, 0);
  EXPECT_EQ(read_number(plain("0.000"), "").value, 0);
  EXPECT_EQ(read_number(plain("5e-324"), "").value, std::numeric_limits<double>::denorm_min());
}

TEST(Value, WhatYamlCppWouldHaveTakenForANumber) {
  EXPECT_EQ(wrong("010"), "is 010; expected a number in s without a leading zero");
  EXPECT_EQ(wrong("-00.5"), "is -00.5; expected a number in s without a leading zero");
  EXPECT_EQ(wrong("0x1F"), "is 0x1F; expected a decimal number in s");
  EXPECT_EQ(wrong("0o17"), "is 0o17; expected a decimal number in s");
  EXPECT_EQ(wrong("1_000"), "is 1_000; expected a number in s without '_'");
  EXPECT_EQ(wrong(".nan"), "is .nan; expected a finite number in s");
  EXPECT_EQ(wrong("-.INF"), "is -.INF; expected a finite number in s");
  EXPECT_EQ(wrong("nan"), "is nan; expected a finite number in s");
  EXPECT_EQ(wrong("inf"), "is inf; expected a finite number in s");
  EXPECT_EQ(wrong("1e400"), "is 1e400; expected a number that fits a double (0, or 5e-324 to 1.8e+308)");
  EXPECT_EQ(wrong("1e-400"), "is 1e-400; expected a number that fits a double (0, or 5e-324 to 1.8e+308)");
  Node quoted = plain("5");
  quoted.quoted = true;
  EXPECT_EQ(read_number(quoted, "s").wrong, "is \"5\" in quotes; expected a number in s, without quotes");
}

TEST(Value, WhatIsNoNumber) {
  EXPECT_EQ(wrong("fast"), "is 'fast'; expected a number in s");
  EXPECT_EQ(wrong("1e"), "is '1e'; expected a number in s");
  EXPECT_EQ(wrong("--1"), "is '--1'; expected a number in s");
  EXPECT_EQ(wrong("1 s"), "is '1 s'; expected a number in s");
  EXPECT_EQ(wrong("."), "is '.'; expected a number in s");
  EXPECT_EQ(wrong("1,5"), "is '1,5'; expected a number in s; use a decimal point: 1.5");
  EXPECT_EQ(read_number({Node::Kind::list}, "").wrong, "is a list; expected a number");
  EXPECT_EQ(read_number({Node::Kind::map}, "m").wrong, "is a map; expected a number in m");
  EXPECT_EQ(read_number({Node::Kind::null}, "m").wrong, "is empty; expected a number in m");
}

TEST(Value, Integers) {
  EXPECT_EQ(read_integer(plain("12")).value, 12);
  EXPECT_EQ(read_integer(plain("-9223372036854775807")).value, -9223372036854775807);
  EXPECT_EQ(read_integer(plain("1.0")).wrong, "is 1.0; expected a whole number");
  EXPECT_EQ(read_integer(plain("1e3")).wrong, "is 1e3; expected a whole number");
  EXPECT_EQ(read_integer(plain("010")).wrong, "is 010; expected a whole number without a leading zero");
  EXPECT_EQ(read_integer(plain("99999999999999999999")).wrong,
            "is 99999999999999999999; expected a whole number that fits 64 bits");
}

TEST(Value, Flags) {
  EXPECT_TRUE(read_flag(plain("true")).value);
  EXPECT_TRUE(read_flag(plain("false")).ok());
  for (const char* text : {"yes", "True", "on", "1"}) EXPECT_FALSE(read_flag(plain(text)).ok()) << text;
  EXPECT_EQ(read_flag(plain("yes")).wrong, "is 'yes'; expected true or false");
}

TEST(Value, NumbersAreWrittenShortestAndReadBack) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(2.5e-5), "2.5e-05");
  EXPECT_EQ(number_text(1e5), "100000");
  EXPECT_EQ(number_text(-0.0), "-0");
  for (const double x : {1.0 / 3, 1e300, 5e-324, 123456789.123}) EXPECT_EQ(read_number(plain(number_text(x)), "").value, x);
}

TEST(Value, TheLocaleDoesNotMatter) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"}) std::setlocale(LC_ALL, name);  // if installed
  EXPECT_EQ(number_text(1234.5), "1234.5");
  EXPECT_EQ(read_number(plain("1234.5"), "").value, 1234.5);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Value, RangesInWords) {
  const double any = std::numeric_limits<double>::infinity();
  EXPECT_EQ(range_text({"Hz", 0, 20, ""}), "0 to 20 Hz");
  EXPECT_EQ(range_text({"s", 0, any, ""}), "at least 0 s");
  EXPECT_EQ(range_text({"s", -any, 1, ""}), "at most 1 s");
  EXPECT_EQ(range_text({"s", std::numeric_limits<double>::denorm_min(), any, ""}), "more than 0 s");
  EXPECT_EQ(range_text({"s", std::numeric_limits<double>::denorm_min(), 2, ""}), "more than 0 and up to 2 s");
  EXPECT_EQ(range_text({"", -any, any, ""}), "");
}

TEST(Value, MessagesShowNoControlCharactersAndStayShort) {
  EXPECT_EQ(in_quotes("a\x1b[31m"), "'a\\x1b[31m'");
  EXPECT_EQ(clipped(std::string(500, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(clipped(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(clipped("\xc2\x9b!"), "\\xc2\\x9b!");
  // The first and last separator of lines and bidirectional mark of each group is escaped, but not the characters before and
  // after the group.
  for (const char* mark : {"\u061c", "\u200e", "\u200f", "\u2028", "\u2029", "\u202a", "\u202e", "\u2066", "\u2069"}) {
    EXPECT_TRUE(clipped(mark).starts_with("\\x")) << clipped(mark);
    EXPECT_EQ(clipped(mark), one_line(mark));
  }
  for (const char* letter :
       {"\u061b", "\u061d", "\u200d", "\u2010", "\u2027", "\u202f", "\u2065", "\u206a", "\u00e9", "\u05d0"})
    EXPECT_EQ(clipped(letter), letter);
  EXPECT_EQ(clipped("a\xe2\x80"), "a\xe2\x80");  // text that is cut within a mark
}

}  // namespace
}  // namespace gaitlab
