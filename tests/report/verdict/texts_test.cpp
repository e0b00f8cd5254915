// Tests of shares and lengths in messages, and of the manual of the verdict.
#include <gtest/gtest.h>

#include <cmath>

#include "report/verdict/check_manual.h"
#include "report/verdict/numbers/number_texts.h"

namespace gaitlab::test {
namespace {

using namespace report;

TEST(NumberTexts, SharesHaveNoPowersOfTen) {
  EXPECT_EQ(texts::percent(0), "0 %");
  EXPECT_EQ(texts::percent(0.1234), "12.3 %");
  EXPECT_EQ(texts::percent(0.99999), "100 %");
  EXPECT_EQ(texts::percent(5.6789), "568 %");
  EXPECT_EQ(texts::percent(9.999), "1000 %");
  EXPECT_EQ(texts::percent(14.9), "more than 1000 %");
  EXPECT_EQ(texts::percent(-0.05), "-5 %");
  EXPECT_EQ(texts::percent(-14.9), "less than -1000 %");
  EXPECT_EQ(texts::percent(1e-6), "0.0001 %");
  EXPECT_EQ(texts::percent(1e-9), "less than 0.0001 %");
  EXPECT_EQ(texts::percent(-1e-9), "0 %");
  EXPECT_EQ(texts::percent(HUGE_VAL), "more than 1000 %");
  EXPECT_EQ(texts::percent(std::nan("")), "nan %");
  EXPECT_EQ(texts::rough_percent(0.0123), "1.2 %");
  EXPECT_EQ(texts::rough_percent(1.0345), "103 %");
  EXPECT_EQ(texts::rough_percent(1060), "more than 1000 %");
  EXPECT_EQ(texts::rough_percent(1e-9), "less than 0.0001 %");
}

TEST(NumberTexts, SharesOfATimeConsistOfSteps) {
  EXPECT_EQ(texts::share_of_time(0.1234), "12.3 %");
  EXPECT_EQ(texts::share_of_time(1.01e-4), "0.0101 %");
  EXPECT_EQ(texts::share_of_time(0.99e-4), "less than 0.01 %");
  EXPECT_EQ(texts::share_of_time(0), "0 %");
}

TEST(NumberTexts, LengthsAreInTheUnitOfTheirSize) {
  EXPECT_EQ(texts::length(0), "0 mm");
  EXPECT_EQ(texts::length(0.005234), "5.23 mm");
  EXPECT_EQ(texts::length(-0.25), "-250 mm");
  EXPECT_EQ(texts::length(0.9999), "1 m");
  EXPECT_EQ(texts::length(706.1), "706 m");
  EXPECT_EQ(texts::length(12345), "12.3 km");
  EXPECT_EQ(texts::length(7e7), "more than 1000 km");
}

TEST(VerdictManual, HasNoTwoBlankLinesAndStaysInItsColumns) {
  const auto check = [](const std::string& text, std::size_t columns) {
    EXPECT_EQ(text.find("\n\n\n"), std::string::npos) << text;
    for (std::size_t at = 0; at < text.size() && text[at] != '|';) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      EXPECT_LE(end - at, columns) << text.substr(at, end - at);
      at = end + 1;
    }
  };
  check(explain_verdict(), 80);
  check(verdict_page(), 120);
  for (const CheckKind& kind : check_kinds()) check(explain_check(kind), 80);
  const std::string speed =
      "speed: Speed within reach\n"
      "  value    largest speed, over all steps: in the window, compared with the speed\n"
      "           at which the actuator has no torque left; in the whole run, with the\n"
      "           rated speed, rad/s\n"
      "  over     the judged window\n"
      "  fails    above the speed limit\n";
  const auto kind = std::ranges::find_if(check_kinds(), [](const CheckKind& one) { return std::string(one.id) == "speed"; });
  EXPECT_EQ(explain_check(*kind).substr(0, speed.size()), speed);
}

}  // namespace
}  // namespace gaitlab::test
