// Tests of the list of lines in which two texts differ.
#include "core/settings/changed_lines.h"

#include <gtest/gtest.h>

namespace gaitlab::test {
namespace {

using Sentences = std::vector<std::string>;

TEST(ChangedLines, NamesEveryChangedLine) {
  EXPECT_EQ(changed_lines("a\nb\nc\n", "a\nb\nc\n"), Sentences{});
  EXPECT_EQ(changed_lines("", ""), Sentences{});
  EXPECT_EQ(changed_lines("Kp: 100\nKd: 1\nKi: 0\n", "Kp: 97\nKd: 1\nKi: 2\n"),
            (Sentences{"line 1: \"Kp: 97\", was \"Kp: 100\"", "line 3: \"Ki: 2\", was \"Ki: 0\""}));
}

TEST(ChangedLines, LinesThatOneTextLacks) {
  EXPECT_EQ(changed_lines("a\nb\nc\nd\n", "a\nnew\nb\nd\n"),
            (Sentences{"line 2: \"new\", was nothing", "line 4: nothing, was \"c\""}));
  EXPECT_EQ(changed_lines("a\n", "a\nb"), Sentences{"line 2: \"b\", was nothing"});
  EXPECT_EQ(changed_lines("a\nb\n", ""), (Sentences{"line 1: nothing, was \"a\"", "line 1: nothing, was \"b\""}));
  EXPECT_EQ(changed_lines("x\nx\n", "x\n"), Sentences{"line 2: nothing, was \"x\""});
  EXPECT_EQ(changed_lines("a\nb\n", "a\none\ntwo\n"),
            (Sentences{"line 2: \"one\", was \"b\"", "line 3: \"two\", was nothing"}));
}

TEST(ChangedLines, CountsThoseThatAreTooMany) {
  EXPECT_EQ(changed_lines("a\nb\nc\n", "1\n2\n3\n", 2),
            (Sentences{"line 1: \"1\", was \"a\"", "line 2: \"2\", was \"b\"", "... and 1 more line"}));
}

// In long texts, lines are compared by their line numbers, because matching 3000 x 3000 lines would take too long.
TEST(ChangedLines, ManyLinesAreComparedInTheirPlaces) {
  std::string then;
  std::string now;
  for (int i = 0; i < 3000; ++i) {
    then += std::to_string(i) + "\n";
    now += (i == 0 || i == 1500 || i == 2999 ? "x" : "") + std::to_string(i) + "\n";
  }
  EXPECT_EQ(changed_lines(then, now), (Sentences{"line 1: \"x0\", was \"0\"", "line 1501: \"x1500\", was \"1500\"",
                                                 "line 3000: \"x2999\", was \"2999\""}));
}

TEST(ChangedLines, LongLinesAreShownFromTheChangeOn) {
  const std::string start(100, '-');
  EXPECT_EQ(changed_lines(start + "old\n", start + "new\n"),
            Sentences{"line 1: ...\"--------------------new\", was ...\"--------------------old\""});
}

// Control characters of a golden, whose origin may be unknown, are escaped before they reach the terminal.
TEST(ChangedLines, ControlCharactersAreWrittenOut) {
  EXPECT_EQ(changed_lines("a\x1b[2J\n", "a\n"), Sentences{"line 1: \"a\", was \"a\\x1b[2J\""});
}

}  // namespace
}  // namespace gaitlab::test
