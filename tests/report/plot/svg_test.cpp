#include "report/plot/svg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "report/plot/plot.h"

namespace gaitlab::report {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> labels(const Ticks& ticks) {
  std::vector<std::string> labels;
  for (const Tick& tick : ticks.marks) labels.push_back(tick.text);
  return labels;
}

TEST(Svg, IsAWholeDocument) {
  Svg svg(100, 50.5);
  svg.line({0, 0}, {10, 20.126}, {.stroke = colour::kBlue});
  EXPECT_EQ(svg.finish(),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50.5\" viewBox=\"0 0 100 50.5\" "
            "font-family=\"sans-serif\">\n"
            "<rect x=\"0\" y=\"0\" width=\"100\" height=\"50.5\" fill=\"#FFFFFF\"/>\n"
            "<path d=\"M0,0L10,20.13\" fill=\"none\" stroke=\"#0072B2\" stroke-width=\"1\"/>\n"
            "</svg>\n");
}

/// The title is the name of the picture for assistive programs (SVG Accessibility API Mappings: the first child `title`).
TEST(Svg, TitleIsTheAccessibleName) {
  for (const std::string& file : {Svg(10, 20, "a <b>").finish(), Svg(Paper{10, 20}, "a <b>").finish()}) {
    const std::size_t root = file.find("<svg ");
    const std::size_t end = file.find(">\n", root);
    EXPECT_NE(file.substr(root, end - root).find(" role=\"img\""), std::string::npos) << file;
    EXPECT_EQ(file.substr(end + 2, 32), "<title>a &lt;b&gt;</title>\n<rect");
  }
  EXPECT_EQ(Svg(10, 20).finish().find("role"), std::string::npos);
}

TEST(Svg, NumbersHaveTwoDecimalsAtMost) {
  Svg svg(1, 1);
  svg.polyline(std::vector<Point>{{-0.001, 1.10}, {1.0 / 3, 1000}}, {.stroke = colour::kInk});
  EXPECT_NE(svg.finish().find("M0,1.1 0.33,1000\""), std::string::npos);
}

TEST(Svg, PolylinesBreakWhereThereIsNoNumber) {
  Svg svg(1, 1);
  svg.polyline(std::vector<Point>{{0, 0}, {1, 1}, {2, kNan}, {3, 3}, {4, 4}}, {.stroke = colour::kInk});
  svg.polyline(std::vector<Point>{{kNan, 0}}, {.stroke = colour::kInk});
  svg.circle({kNan, 0}, 1, {});
  EXPECT_NE(svg.finish().find("\"M0,0 1,1M3,3 4,4\""), std::string::npos);
  EXPECT_EQ(svg.finish().find("nan"), std::string::npos);
}

TEST(Svg, TextIsEscaped) {
  EXPECT_EQ(xml_escaped("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
  EXPECT_EQ(xml_escaped("Grüße \xE2\x82\xAC \xF0\x9F\xA6\xBF"), "Grüße \xE2\x82\xAC \xF0\x9F\xA6\xBF");
  EXPECT_EQ(xml_escaped("a\nb\tc"), "a b c");
  const std::string bad = "\xEF\xBF\xBD";
  EXPECT_EQ(xml_escaped(std::string_view("\0\x01", 2)), bad + bad);
  EXPECT_EQ(xml_escaped("x\xFF\xC3"), "x" + bad + bad);
  EXPECT_EQ(xml_escaped("\xC0\x80"), bad + bad);                      // overlong encoding
  EXPECT_EQ(xml_escaped("\xED\xA0\x80"), bad + bad + bad);            // surrogate
  EXPECT_EQ(xml_escaped("\xEF\xBF\xBE"), bad + bad + bad);            // U+FFFE, which XML forbids
  EXPECT_EQ(xml_escaped("\xF4\x90\x80\x80"), bad + bad + bad + bad);  // larger than the last code point of Unicode
}

TEST(Axes, StepsAreOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(nice_step(1), 1);
  EXPECT_DOUBLE_EQ(nice_step(1.1), 2);
  EXPECT_DOUBLE_EQ(nice_step(2.5), 5);
  EXPECT_DOUBLE_EQ(nice_step(7), 10);
  EXPECT_DOUBLE_EQ(nice_step(0.2), 0.2);
  EXPECT_DOUBLE_EQ(nice_step(0.0031), 0.005);
  EXPECT_DOUBLE_EQ(nice_step(1234), 2000);
}

TEST(Axes, TicksCoverTheRange) {
  EXPECT_EQ(labels(ticks_around(-0.61, 0.51, 6)),
            (std::vector<std::string>{"\u22120.8", "\u22120.6", "\u22120.4", "\u22120.2", "0.0", "0.2", "0.4", "0.6"}));
  // A peak that slightly exceeds the last tick does not add a tick.
  EXPECT_EQ(labels(ticks_around(-0.6001, 0.6001, 6)).size(), 7U);
  EXPECT_EQ(labels(ticks_within(12, 20, 8)).front(), "12");
  EXPECT_EQ(labels(ticks_within(0.13, 0.41, 5)), (std::vector<std::string>{"0.2", "0.3", "0.4"}));
}

TEST(Axes, EmptyRangesAreWidened) {
  EXPECT_EQ(labels(ticks_around(0, 0, 4)), (std::vector<std::string>{"\u22120.010", "\u22120.005", "0.000", "0.005", "0.010"}));
  const Ticks at = ticks_around(0.2, 0.2, 6);
  EXPECT_LT(at.lo, 0.2);
  EXPECT_GT(at.hi, 0.2);
  EXPECT_FALSE(ticks_around(kNan, kNan, 6).marks.empty());
  EXPECT_FALSE(ticks_around(1e300, -1e300, 6).marks.empty());
  EXPECT_FALSE(ticks_around(-1.7e308, 1.7e308, 6).marks.empty());
}

TEST(Axes, LogarithmicTicksAreOneTwoFive) {
  const auto over = [](double from, double to, int count) {
    return labels(ticks_over({log10_of(from), log10_of(to)}, true, count));
  };
  EXPECT_EQ(over(0.1, 5, 8), (std::vector<std::string>{"0.1", "0.2", "0.5", "1", "2", "5"}));
  EXPECT_EQ(over(1, 1e5, 6), (std::vector<std::string>{"1", "10", "100", "1000", "10000", "100000"}));
  EXPECT_EQ(over(1, 1e5, 4), (std::vector<std::string>{"1", "100", "10000"}));
  EXPECT_EQ(over(8e-6, 0.13, 4), (std::vector<std::string>{"0.0001", "0.01"}));  // 4.2 decades: two ticks, not linear ones
  // If fewer than three of the numbers 1, 2 and 5 are in the range, ticks are round numbers as on a linear axis.
  EXPECT_EQ(over(1.1, 1.3, 3), (std::vector<std::string>{"1.1", "1.2", "1.3"}));
  EXPECT_EQ(over(0.19, 0.52, 4), (std::vector<std::string>{"0.2", "0.3", "0.4", "0.5"}));
  EXPECT_EQ(over(3, 3, 5), (std::vector<std::string>{"3"}));
  EXPECT_NEAR(ticks_over({0, 1}, true, 5).marks[1].at, 0.30103, 1e-5);  // log10(2)
}

/// Space at both ends of both axes keeps their zeros at the same height.
TEST(Axes, CurvesDoNotTouchTheFrame) {
  const auto zero = [](const Ticks& ticks) { return -ticks.lo / (ticks.hi - ticks.lo); };
  const Bounds a{-0.6, 0.6};
  const Bounds b{-1.1, 0.4};
  TwinTicks twin = twin_ticks(a.lo, a.hi, b.lo, b.hi);
  ASSERT_NEAR(twin.a.hi, 0.6, 1e-12);  // a multiple of a step
  make_room(twin, a, b);
  EXPECT_GT(twin.a.hi, 0.61);
  EXPECT_LT(twin.a.lo, -0.61);
  EXPECT_NEAR(zero(twin.a), zero(twin.b), 1e-12);  // rounding errors of a few operations on numbers near 1
  EXPECT_EQ(labels(twin.a).size(), 7U);
  TwinTicks loose{ticks_around(-0.45, 0.55, 5), ticks_around(-0.45, 0.55, 5)};
  const double top = loose.a.hi;
  make_room(loose, {-0.45, 0.55}, {-0.45, 0.55});
  EXPECT_EQ(loose.a.hi, top);
}

TEST(Axes, WordsAreInTheirOrder) {
  const std::vector<std::string> words{"hopf", "sine", "matsuoka"};
  const Ticks across = word_ticks(words, 0, 2);
  EXPECT_EQ(labels(across), (std::vector<std::string>{"hopf", "matsuoka"}));
  EXPECT_EQ(across.lo, 0);
  EXPECT_EQ(across.hi, 2);
  EXPECT_EQ(row_ticks(words).lo, 2.5);  // rows are numbered from top to bottom
  EXPECT_EQ(row_ticks(words).hi, -0.5);
}

/// Ticks are drawn at the positions of their values. Without an axis at the left, the axis at the right has the grid.
TEST(Plot, TicksAreWhereTheirValuesAre) {
  Svg svg(200, 100);
  Plot plot(svg, {50, 150, 10, 90}, {.ticks = ticks_within(0, 10, 2), .title = "time (s)"}, {});
  plot.right_axis({ticks_within(-1, 1, 2)});
  EXPECT_EQ(plot.at(5, 0, Side::right).x, 100);
  EXPECT_EQ(plot.at(5, 0, Side::right).y, 50);
  plot.band(-3, 5, colour::kSky);
  plot.draw_axes();
  const std::string text = svg.finish();
  for (const char* part : {">\u22121<", ">time (s)<", "<rect x=\"50\" y=\"10\" width=\"50\" height=\"80\" fill=\"#56B4E9\"",
                           "d=\"M50,50L150,50\" fill=\"none\" stroke=\"#999999\""})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(Axes, TwinZerosMeet) {
  for (const auto& [lo, hi] :
       std::vector<std::pair<double, double>>{{-0.61, 0.51}, {-2, 2}, {0.1, 1.2}, {-0.9, -0.1}, {0, 0}, {-1e-3, 30}}) {
    const auto [a, b] = twin_ticks(-0.6, 0.6, lo, hi);
    EXPECT_NEAR(a.lo / a.step, b.lo / b.step, 1e-9);
    EXPECT_NEAR(a.hi / a.step, b.hi / b.step, 1e-9);
    EXPECT_LE(a.lo, -0.6 + 1e-2 * a.step);
    EXPECT_LE(b.lo, lo + 1e-2 * b.step);
    EXPECT_GE(b.hi, hi - 1e-2 * b.step);
    EXPECT_LE(a.marks.size(), 11U);
  }
  // The range of the first axis does not contain zero, so that the axes have independent ranges.
  const auto [a, b] = twin_ticks(0.78, 0.82, -1, 1);
  EXPECT_GT(a.lo, 0.7);
  EXPECT_LE(b.lo, -1);
}

/// Twin axes are independent if an angle above zero and a torque below zero would each use only half of the height.
TEST(Axes, TwinAxesOfOppositeSignsPart) {
  const auto [a, b] = twin_ticks(0, 0.016, -0.65, 0.02);
  EXPECT_LE(a.hi - a.lo, 1.5 * 0.016);
  EXPECT_LE(b.hi - b.lo, 1.5 * 0.67);
}

TEST(Axes, ThinningKeepsPeaks) {
  std::vector<Point> points;
  points.reserve(100000);
  for (int i = 0; i < 100000; ++i) points.push_back({i * 0.008, i == 54321 ? -7.0 : i == 54399 ? 9.0 : 0.0});
  const std::vector<Point> thin = thinned(points);
  EXPECT_LE(thin.size(), 1602U);
  double lo = 0;
  double hi = 0;
  for (std::size_t i = 0; i < thin.size(); ++i) {
    lo = std::min(lo, thin[i].y);
    hi = std::max(hi, thin[i].y);
    if (i > 0) {
      EXPECT_GE(thin[i].x, thin[i - 1].x);
    }
  }
  EXPECT_EQ(lo, -7);
  EXPECT_EQ(hi, 9);
  const std::vector<Point> few(points.begin(), points.begin() + 3);
  EXPECT_EQ(thinned(few).size(), 3U);
}

TEST(Axes, ThinningKeepsGaps) {
  std::vector<Point> points;
  points.reserve(1000);
  for (int i = 0; i < 1000; ++i) points.push_back({i * 0.01, i == 500 ? kNan : 1.0});
  int gaps = 0;
  for (const Point& point : thinned(points)) gaps += std::isnan(point.y) ? 1 : 0;
  EXPECT_EQ(gaps, 1);
}

}  // namespace
}  // namespace gaitlab::report
