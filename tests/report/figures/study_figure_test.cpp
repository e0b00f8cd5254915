// Tests of figures of studies: marks and legends are correct, and the bytes are reproducible.
#include "report/figures/study/study_figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "report/figures/study/study_sheet.h"
#include "report/verdict/numbers/quantities.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

StudyFigure small_map() {
  StudyFigure figure;
  figure.title = "a <map>";
  figure.x = {"cpg.amplitude", "", false};
  figure.y = {"cpg.phase_lag", "", false};
  figure.value = {"speed", "m/s"};
  figure.map = figure.grid = true;
  for (int k = 0; k < 6; ++k) {
    StudyPoint point{0.2 + 0.1 * (k % 3), k < 3 ? 1.0 : 2.0, 0.1 * k, 0.1 * k, 0.1 * k, PointState::kept};
    if (k == 1) point.state = PointState::infeasible;
    if (k == 2) {
      point.state = PointState::failed;
      point.value = std::nan("");
    }
    figure.points.push_back(point);
  }
  figure.best = 5;
  return figure;
}

TEST(StudyFigure, AMapMarksWhatIsNotKeptAndTheBest) {
  const StudyFigure figure = small_map();
  const std::string svg = study_svg(figure);
  EXPECT_EQ(svg, study_svg(figure));
  EXPECT_TRUE(contains(svg, "a &lt;map&gt;"));
  EXPECT_TRUE(contains(svg, ">infeasible<"));
  EXPECT_TRUE(contains(svg, ">failed<"));
  EXPECT_TRUE(contains(svg, ">best<"));
  EXPECT_EQ(occurrences(svg, "nan"), 0U);
  EXPECT_EQ(study_csv(figure).substr(0, 107),
            "cpg.amplitude,cpg.phase_lag,speed,least,largest,state,best\n0.2,1,0,0,0,kept,0\n0.30000000000000004,1,0.1,0.1");
}

/// Kept points decide the range of a line's axis: a point beyond it is an arrow, and no tick is near its value.
TEST(StudyFigure, KeptPointsDecideTheAxis) {
  EXPECT_EQ(shown_range({1, 2}, {0.9, 50}).hi, 2.25);
  EXPECT_EQ(shown_range({1, 2}, {0.9, 50}).lo, 0.9);
  EXPECT_EQ(shown_range({1, 1}, {0.9, 50}).hi, 50);
  StudyFigure figure = small_map();
  figure.map = figure.grid = false;
  EXPECT_FALSE(contains(study_svg(figure), ">beyond the axis<"));
  figure.points[1].value = figure.points[1].high = 40;
  const std::string svg = study_svg(figure);
  EXPECT_TRUE(contains(svg, ">beyond the axis<"));
  EXPECT_FALSE(contains(svg, ">40<"));
  EXPECT_EQ(occurrences(svg, "Z\" fill=\"#FFFFFF\" stroke=\"#0072B2\""), 2U);  // the point, and the legend
  figure.points[1].state = PointState::kept;
  EXPECT_TRUE(contains(study_svg(figure), ">40<"));
}

/// A colour bar that ends below values of the map has an arrow and states the largest value.
TEST(StudyFigure, AClippedMapSaysSo) {
  StudyFigure figure = small_map();
  EXPECT_EQ(occurrences(study_svg(figure), ">to "), 0U);
  figure.points[1].value = 574.2;
  EXPECT_EQ(occurrences(study_svg(figure), ">to 574<"), 1U);
  figure.points[1].value = -0.1234;
  EXPECT_EQ(occurrences(study_svg(figure), ">to \u22120.123<"), 1U);
}

TEST(StudyFigure, TheBestIsMarkedForTheObjectiveOnly) {
  StudyFigure figure = small_map();
  figure.objective = false;
  EXPECT_FALSE(contains(study_svg(figure), ">best<"));
  EXPECT_TRUE(contains(study_csv(figure), ",kept,1\n"));
}

/// The legend distinguishes points that violate a guard from points with the verdict `infeasible`.
TEST(StudyFigure, ItsLegendTellsGuardsFromVerdicts) {
  StudyFigure figure = small_map();
  figure.points[1].state = PointState::broken;
  for (const bool grid : {true, false}) {
    figure.grid = grid;
    EXPECT_TRUE(contains(study_svg(figure), ">guard broken<"));
    EXPECT_FALSE(contains(study_svg(figure), ">infeasible<"));
  }
  EXPECT_TRUE(contains(study_csv(figure), ",guard broken,0\n"));
  figure.points[0].state = PointState::infeasible;
  EXPECT_TRUE(contains(study_svg(figure), ">infeasible or guard broken<"));
}

/// Figures of special cases contain no NaN: a single point, equal values, unknown values, no kept point.
TEST(StudyFigure, ItsCornersAreDrawn) {
  for (const bool two : {false, true}) {
    for (const std::size_t points : {0U, 1U, 6U}) {
      StudyFigure figure = small_map();
      figure.map = two;
      figure.points.resize(points);
      figure.best = points;
      for (StudyPoint& point : figure.points) {
        point.value = point.low = point.high = std::nan("");
        point.state = PointState::failed;
      }
      EXPECT_EQ(occurrences(study_svg(figure), "nan"), 0U) << two << points;
      for (StudyPoint& point : figure.points) {
        point.value = point.low = point.high = 3;
        point.state = PointState::infeasible;
      }
      EXPECT_EQ(occurrences(study_svg(figure), "nan"), 0U) << two << points;
    }
  }
}

TEST(StudyFigure, HasAtMostTwentyThousandMarks) {
  StudyFigure figure = small_map();
  figure.grid = false;
  figure.points.assign(70000, figure.points[0]);
  figure.best = 69999;
  EXPECT_LE(occurrences(study_svg(figure), "<circle"), 20010U);
}

TEST(Quantities, AreTheNumbersOfTheSummary) {
  const Scenario scenario = shipped("caterpillar.yaml", {"physics.engine=articulated", "duration=0.5"});
  const Recording record = run(scenario);
  const Summary summary = summarise(scenario, record, 1);
  const RunData data{scenario, record, summary};
  std::set<std::string> names;
  for (const SummaryQuantity& quantity : quantities()) {
    EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
    EXPECT_FALSE(std::isinf(quantity.value(data))) << quantity.name;
    if (quantity.name == "speed") {
      EXPECT_EQ(quantity.value(data), summary.speed);
    }
    if (quantity.name == "limit_cycle.found") {
      EXPECT_EQ(quantity.value(data), summary.limit_cycle.found ? 1 : 0);
    }
    // The value is the electrical energy of the whole robot, and not the largest energy of a joint.
    if (quantity.name == "energy.electrical") {
      EXPECT_EQ(quantity.value(data), record.ledger.electrical);
    }
    if (quantity.name != "torque.peak") continue;
    double most = 0;
    for (std::size_t j = 0; j < record.joints.size(); ++j) {
      const double one = joint_quantity("torque.peak", *scenario.robot, j)->value(data);
      EXPECT_EQ(one, record.joints[j].torque_peak);
      most = std::max(most, one);
    }
    EXPECT_EQ(quantity.value(data), most);
  }
  EXPECT_TRUE(names.contains("torque.peak") && names.contains("fell") && !names.contains("trace_hash") &&
              !names.contains("wall_time"));
  EXPECT_FALSE(joint_quantity("speed", *scenario.robot, 0).has_value());
}

}  // namespace
}  // namespace gaitlab::test
