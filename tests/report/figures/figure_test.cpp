#include "report/figures/run/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/report/sample.h"

namespace gaitlab::report {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// True if all tags are closed in the correct order and all attributes are quoted. The writer cannot make other errors.
bool well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    at = end;
    if (tag.empty() || tag.find('<') != std::string::npos || count(tag, "\"") % 2 != 0) return false;
    if (tag.front() == '?' || tag.back() == '/') continue;
    const std::string name = tag.substr(0, tag.find(' '));
    if (name.front() != '/') {
      open.push_back(name);
    } else {
      if (open.empty() || "/" + open.back() != name) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

TEST(Figure, ShowsCurvesViewsAndUnits) {
  const std::string svg = figure_svg(sample::figure());
  EXPECT_TRUE(well_formed(svg));
  for (const std::string text : {"caterpillar-8", "joint m3/passive", "angle (rad)", "torque (N m)", "time (s)", "set point",
                                 ">16 s<", ">20 s<", "x (m)", "active block", "passive block", "link", "contact"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  EXPECT_EQ(count(svg, "paint-order"), 5U * 24U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_LT(svg.size(), 200000U);
}

TEST(Figure, SameInputSameBytes) { EXPECT_EQ(figure_svg(sample::figure()), figure_svg(sample::figure())); }

TEST(Figure, ShowsTheLastEightSecondsOrAll) {
  FigureInput input = sample::figure();
  input.views.clear();
  EXPECT_NE(figure_svg(input).find(">12</text>"), std::string::npos);
  EXPECT_EQ(figure_svg(input).find(">11</text>"), std::string::npos);
  input = sample::figure(4);
  input.views.clear();
  EXPECT_NE(figure_svg(input).find(">0.0</text>"), std::string::npos);
}

TEST(Figure, DrawsTheTorqueAtRestWhereTheCurveComesNear) {
  FigureInput input = sample::figure();
  double peak = 0;
  for (const double torque : input.joints[0].torque) peak = std::max(peak, std::abs(torque));
  const auto with = [&](double rest) {
    input.joints[0].peak = peak;
    input.joints[0].rest_torque = rest;
    return figure_svg(input);
  };
  EXPECT_NE(with(1.1 * peak).find("torque of the motor at rest"), std::string::npos);
  EXPECT_EQ(with(2 * peak).find("torque of the motor at rest"), std::string::npos);
  EXPECT_EQ(with(0).find("torque of the motor at rest"), std::string::npos);
}

TEST(Figure, LongTracesStaySmall) {
  FigureInput input = sample::figure();
  FigureInput fine = input;
  for (std::vector<double>* series : {&fine.time, &fine.joints[0].angle, &fine.joints[0].setpoint, &fine.joints[0].torque}) {
    std::vector<double> dense;
    for (std::size_t i = 0; i + 1 < series->size(); ++i) {
      for (int k = 0; k < 100; ++k) dense.push_back((*series)[i] + 0.01 * k * ((*series)[i + 1] - (*series)[i]));
    }
    *series = dense;
  }
  EXPECT_LT(figure_svg(fine).size(), 200000U);
}

TEST(Figure, DoesWithoutMotorJointGroundOrViews) {
  FigureInput input = sample::figure();
  input.joints[0].setpoint.clear();
  input.joints[0].torque.clear();
  EXPECT_EQ(figure_svg(input).find("torque"), std::string::npos);
  EXPECT_EQ(figure_svg(input).find("set point"), std::string::npos);
  input.joints[0].angle.clear();
  EXPECT_EQ(figure_svg(input).find("time (s)"), std::string::npos);
  input.ground = false;
  EXPECT_TRUE(well_formed(figure_svg(input)));
  input.views.clear();
  EXPECT_TRUE(well_formed(figure_svg(input)));
  EXPECT_TRUE(well_formed(figure_svg({})));
}

TEST(Figure, SurvivesAFailedRun) {
  FigureInput input = sample::figure();
  input.joints[0].angle.back() = std::numeric_limits<double>::quiet_NaN();
  input.joints[0].torque.back() = -std::numeric_limits<double>::infinity();
  input.joints[0].torque[input.joints[0].torque.size() - 2] = 1e300;
  input.views.back().outlines[0].polygons[0][0].x = std::numeric_limits<double>::quiet_NaN();
  input.views.push_back({21, {}});
  const std::string svg = figure_svg(input);
  EXPECT_TRUE(well_formed(svg));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("\"inf"), std::string::npos);
}

TEST(Figure, TitlesAreText) {
  FigureInput input;
  input.title = "<script>alert(\"&\")</script>";
  const std::string svg = figure_svg(input);
  EXPECT_TRUE(well_formed(svg));
  EXPECT_EQ(svg.find("<script"), std::string::npos);
}

}  // namespace
}  // namespace gaitlab::report
