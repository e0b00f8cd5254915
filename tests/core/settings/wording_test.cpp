// Tests of wrapped texts: paragraphs, equations, cells.
#include "core/settings/wording.h"

#include <gtest/gtest.h>

namespace gaitlab::test {
namespace {

TEST(Wrapped, JoinsTheRestOfALineWithTheNextOfItsParagraph) {
  EXPECT_EQ(wrapped("one two three\nfour\nfive", 0, 9), "one two\nthree\nfour five\n");
  EXPECT_EQ(wrapped("one two three\n\nfour", 2, 9), "  one two\n  three\n\n  four\n");
}

TEST(Wrapped, IndentsTheRestOfAnEquation) {
  EXPECT_EQ(wrapped("    a = b + c + d\n    e = f", 0, 15), "    a = b + c +\n            d\n    e = f\n");
}

TEST(Wrapped, PutsTheRestOfACellBelowIt) {
  const std::string cells = "name    what the name means and does, in more words\n        and further words\nother   short";
  EXPECT_EQ(wrapped(cells, 0, 40),
            "name    what the name means and does, in\n        more words and further words\nother   short\n");
}

TEST(Wrapped, PutsACellBelowTheLineWhereItWouldBeNarrow) {
  const std::string cells = "    phi' = 2 pi f      the default of all models\n                       and of others";
  EXPECT_EQ(wrapped(cells, 0, 40), "    phi' = 2 pi f\n            the default of all models\n            and of others\n");
  EXPECT_EQ(wrapped("    min(a, b)  if(condition, then, else)", 0, 30),
            "    min(a, b)\n            if(condition,\n            then, else)\n");
}

TEST(Wrapped, KeepsAWordThatIsTooLong) {
  EXPECT_EQ(wrapped("    abcdefghij  klmnopqrst", 0, 8), "    abcdefghij\n            klmnopqrst\n");
}

}  // namespace
}  // namespace gaitlab::test
