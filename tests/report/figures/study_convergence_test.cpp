// Tests of the figure of a search: its data are over the number of runs.
#include "report/figures/study/study_convergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gaitlab::report {
namespace {

/// Three generations: 4 runs without a kept point, 4 runs, and 8 runs after a restart.
ConvergenceFigure three_generations() {
  ConvergenceFigure figure;
  figure.title = "walker: the search";
  figure.value = {"speed", "m/s"};
  const double none = std::nan("");
  figure.searches = {{{0, 0, 4, none, none, 0, 0.3, 4}, {1, 0, 4, 0.2, 0.1, 0.5, 0.2, 8}, {2, 1, 8, 0.3, 0.15, 0.25, 0.3, 16}}};
  figure.best = {{6, 0.1}, {7, 0.2}, {12, 0.3}};
  figure.runs = 16;
  return figure;
}

TEST(StudyConvergence, DataAreOverTheRuns) {
  EXPECT_EQ(convergence_csv(three_generations()),
            "search,generation,restart,points,best,median,kept,spread,runs,best_so_far\n"
            "0,0,0,4,,,0,0.3,4,\n"
            "0,1,0,4,0.2,0.1,0.5,0.2,8,0.2\n"
            "0,2,1,8,0.3,0.15,0.25,0.3,16,0.3\n");
  EXPECT_EQ(improvements_csv(three_generations()), "runs,best_so_far\n6,0.1\n7,0.2\n12,0.3\n");
}

/// The best value so far is a staircase with a step at each improvement, up to the last run.
TEST(StudyConvergence, BestSoFarIsAStaircase) {
  const std::string svg = convergence_svg(three_generations());
  EXPECT_NE(svg.find("M318.75,330 356.88,330 356.88,197 547.5,197 547.5,64 700,64"), std::string::npos) << svg;
  EXPECT_NE(svg.find(">runs</text>"), std::string::npos) << svg;
  EXPECT_EQ(svg.find(">generation</text>"), std::string::npos);
  ConvergenceFigure empty = three_generations();
  empty.best.clear();
  empty.searches.clear();
  empty.runs = 0;
  EXPECT_NE(convergence_svg(empty).find("</svg>"), std::string::npos) << "a study without runs has a figure as well";
}

}  // namespace
}  // namespace gaitlab::report
