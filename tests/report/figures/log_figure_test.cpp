// Tests of the figure of a log: a run that leaves the log for a moment does not flatten it.
#include "report/figures/run/log_figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "report/plot/ticks.h"

namespace gaitlab::test {
namespace {

using namespace report;

/// Heights of the curves of a colour in the sheet, px: of the panel above, and of the one below.
std::vector<Bounds> curve_bounds(const std::string& svg, std::string_view stroke) {
  std::vector<Bounds> found;
  const std::regex path("<path d=\"M([^\"]*)\" fill=\"none\" stroke=\"" + std::string(stroke) + "\"[^>]*linejoin");
  for (std::sregex_iterator one(svg.begin(), svg.end(), path), end; one != end; ++one) {
    const std::string points = (*one)[1];
    Bounds& bounds = found.emplace_back();
    const std::regex pair("([-0-9.]+),([-0-9.]+)");
    for (std::sregex_iterator at(points.begin(), points.end(), pair); at != end; ++at) bounds.add(std::stod((*at)[2]));
  }
  return found;
}

TEST(LogFigure, AMomentFarOffIsCut) {
  std::vector<double> t, log, run;
  for (int k = 0; k <= 300; ++k) {
    t.push_back(0.01 * k);
    log.push_back(std::sin(3 * t.back()));
    run.push_back(log.back() + 0.1 * std::sin(20 * t.back()));
  }
  std::vector<double> other = run;
  other[150] = 1000;
  const std::vector<LogStretch> off{{2, 3}};
  const LogCurves curves{"angle, rad", "mrad", 1e-3, log, run, other};
  const std::string svg = log_figure("a <log>", t, off, {&curves, 1});
  EXPECT_NE(svg.find("<title>a &lt;log&gt;</title>"), std::string::npos);

  const std::vector<Bounds> of_log = curve_bounds(svg, log_colour::kLog);
  const std::vector<Bounds> of_run = curve_bounds(svg, log_colour::kRun);
  const std::vector<Bounds> of_other = curve_bounds(svg, log_colour::kOther);
  ASSERT_EQ(of_log.size(), 1U);
  ASSERT_EQ(of_run.size(), 2U);
  ASSERT_EQ(of_other.size(), 2U);
  // The range above is at most three spans of the log, and that of the differences at most twice their magnitude to each side.
  EXPECT_GT(of_log[0].hi - of_log[0].lo, 150 / 3.5);
  EXPECT_GT(of_run[1].hi - of_run[1].lo, 76 / 2.5);
  for (const Bounds& one : of_other) {  // they end at the frames
    EXPECT_GE(one.lo, 10);
    EXPECT_LE(one.hi, 10 + 150 + 12 + 76);
  }
}

}  // namespace
}  // namespace gaitlab::test
