// Tests of figures of studies with any number of parameters: drawn elements, special cases, limits, reproducible bytes.
#include "report/figures/study/many_figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>

#include "report/figures/study/bar_figure.h"
#include "report/figures/study/box_figure.h"

namespace gaitlab::test {
namespace {

using namespace report;

std::size_t number_of_parts(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

ManyFigure three(std::size_t points) {
  ManyFigure figure;
  figure.title = "a <study>: speed";
  figure.note = "gaitlab";
  figure.axes = {{{"cpg.frequency", "", true}}, {{"cpg.phase_lag", "", false}}, {{"cpg.type", "", false}, {"hopf", "sine"}}};
  figure.value = {"speed", "m/s"};
  for (std::size_t k = 0; k < points; ++k) {
    const auto x = static_cast<double>(k);
    ManyPoint point{{0.1 + 0.01 * x, 1 - x, static_cast<double>(k % 2)}, 0.1 * x - 0.2, PointState::kept};
    if (k % 4 == 1) point.state = PointState::infeasible;
    if (k % 4 == 2) {
      point.state = PointState::failed;
      point.value = std::nan("");
    }
    figure.points.push_back(point);
  }
  figure.best = points == 0 ? 0 : (points - 1) / 4 * 4;
  return figure;
}

TEST(ManyFigure, EveryPointIsALine) {
  const ManyFigure figure = three(9);
  const std::string svg = parallel_svg(figure);
  EXPECT_EQ(svg, parallel_svg(figure));
  EXPECT_EQ(number_of_parts(svg, "stroke-linejoin"), 9U + 2);  // the best point has a black line on a white line
  for (const char* part : {"a &lt;study&gt;", ">cpg.frequency<", ">hopf<", ">best<", ">not kept or failed<", "speed (m/s)"})
    EXPECT_EQ(number_of_parts(svg, part) > 0, true) << part;
  EXPECT_EQ(many_csv(figure).substr(0, 78), "cpg.frequency,cpg.phase_lag,cpg.type,speed,state,best\n0.1,1,hopf,-0.2,kept,0\n0");
}

TEST(ManyFigure, PointsFarFromTheKeptOnesAreArrows) {
  ManyFigure figure = three(9);
  EXPECT_FALSE(scatter_svg(figure).find(">beyond the axis<") != std::string::npos);
  figure.points[1].value = 1e3;  // infeasible
  for (const std::string& svg : {parallel_svg(figure), scatter_svg(figure)}) EXPECT_EQ(number_of_parts(svg, ">1000<"), 0U);
  EXPECT_EQ(number_of_parts(scatter_svg(figure), "Z\" fill=\"#FFFFFF\" stroke=\"#B0B0B0\""), 3U + 1);  // panels, legend
  figure.objective = false;
  for (const std::string& svg : {parallel_svg(figure), scatter_svg(figure)}) EXPECT_EQ(number_of_parts(svg, ">best<"), 0U);
}

/// No panel of a scatter figure is alone in the last row.
TEST(ManyFigure, PanelsAreInEvenRows) {
  for (std::size_t panels = 2; panels <= 12; ++panels) {
    ManyFigure figure = three(5);
    figure.axes.assign(panels, {{"a", "", false}});
    for (ManyPoint& point : figure.points) point.at.assign(panels, point.value);
    const std::string svg = scatter_svg(figure);
    std::map<double, std::size_t> rows;  // panels by the top of their frame
    static const std::regex kFrame("<rect x=\"[0-9.]+\" y=\"([0-9.]+)\" [^>]*fill=\"none\" stroke=\"#333333\"");
    for (std::sregex_iterator it(svg.begin(), svg.end(), kFrame), end; it != end; ++it) ++rows[std::stod((*it)[1])];
    EXPECT_GE(rows.rbegin()->second, 2U) << panels;
    EXPECT_LE(rows.begin()->second, 4U) << panels;
  }
}

/// Figures of special cases contain no NaN: no points, one point, only failed points, equal values.
TEST(ManyFigure, ItsCornersAreDrawn) {
  for (const std::size_t points : {0U, 1U, 9U}) {
    ManyFigure figure = three(points);
    const auto fine = [&](const char* what) {
      for (const std::string& svg : {parallel_svg(figure), scatter_svg(figure)}) {
        EXPECT_EQ(number_of_parts(svg, "nan"), 0U) << what << points;
        EXPECT_EQ(number_of_parts(svg, "inf\""), 0U) << what << points;
      }
    };
    fine("as they are");
    for (ManyPoint& p : figure.points) p.value = 3;
    fine("one value");
    figure.best = points;
    for (ManyPoint& p : figure.points) {
      p.state = PointState::failed;
      p.value = std::nan("");
    }
    fine("all failed");
  }
}

TEST(ManyFigure, HasAtMostTwentyThousandMarks) {
  const ManyFigure figure = three(30000);
  for (const std::string& svg : {parallel_svg(figure), scatter_svg(figure)}) {
    const std::size_t marks = number_of_parts(svg, "<path") + number_of_parts(svg, "<circle") + number_of_parts(svg, "<rect");
    EXPECT_LE(marks, 20000U);
    EXPECT_GT(marks, 100U);
  }
}

TEST(BarFigure, DrawsNoBarOfWhatIsNotKnown) {
  BarFigure figure{"what changes speed", "gaitlab", "share", {"total", "first"}, {}};
  EXPECT_EQ(number_of_parts(bar_svg(figure), "nan"), 0U);
  figure.rows = {{"a.key", {{0.5, 0.4, 0.6}, {-0.02, -0.1, 0.1}}},
                 {"another", {{std::nan(""), std::nan(""), std::nan("")}, {0.1, std::nan(""), std::nan("")}}}};
  figure.rows[1].remark = "too few samples";
  const std::string svg = bar_svg(figure);
  EXPECT_EQ(number_of_parts(svg, ">too few samples<"), 1U);
  EXPECT_EQ(number_of_parts(svg, "nan"), 0U);
  EXPECT_EQ(svg, bar_svg(figure));
}

/// Quartiles are those of type 7 of Hyndman and Fan, as numpy.percentile computes them.
TEST(BoxFigure, QuartilesAreLinearBetweenValues) {
  const std::vector<double> values{1, 2, 4, 8};
  EXPECT_EQ(quartile(values, 0), 1);
  EXPECT_EQ(quartile(values, 0.25), 1.75);
  EXPECT_EQ(quartile(values, 0.5), 3);
  EXPECT_EQ(quartile(values, 0.75), 5);
  EXPECT_EQ(quartile(values, 1), 8);
  EXPECT_EQ(quartile({3}, 0.25), 3);
  BoxFigure figure{"replicates", "gaitlab", "speed (m/s)", "run", {{"run 3", values, true}, {"run 7", {std::nan("")}, false}}};
  EXPECT_EQ(number_of_parts(box_svg(figure), "nan"), 0U);
  EXPECT_EQ(number_of_parts(box_svg(figure), ">failed<"), 1U);
  figure.groups.clear();
  EXPECT_EQ(number_of_parts(box_svg(figure), "nan"), 0U);
}

}  // namespace
}  // namespace gaitlab::test
