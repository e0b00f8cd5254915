#include "report/figures/study/study_convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures/study/study_sheet.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr PlotArea kObjectiveArea{90, 700, 64, 330};  // px
constexpr PlotArea kShareArea{90, 700, 360, 450};     // px
constexpr double kConvergenceHeight = 560;            // px
constexpr Style kSoFar{.stroke = colour::kBlack, .width = 2};
constexpr Style kOfGeneration{.stroke = colour::kBlue, .width = 1.2};
constexpr Style kMedian{.stroke = colour::kSky, .width = 1.4, .dash = "6 4"};
constexpr Style kShare{.stroke = colour::kGreen, .width = 1.4};
constexpr Style kRestart{.stroke = colour::kGrey, .width = 1, .dash = "2 3"};

struct Curves {
  std::vector<double> runs, best, median, share;
};

Curves curves_of(const std::vector<ConvergencePoint>& search) {
  Curves curves;
  for (const ConvergencePoint& p : search) {
    curves.runs.push_back(p.runs);
    curves.best.push_back(p.best);
    curves.median.push_back(p.median);
    curves.share.push_back(p.kept);
  }
  return curves;
}

/// Staircase of the best value so far. It ends at the last run.
Curves staircase(const ConvergenceFigure& figure) {
  Curves stairs;
  const auto add = [&](double runs, double value) {
    stairs.runs.push_back(runs);
    stairs.best.push_back(value);
  };
  for (const Improvement& one : figure.best) {
    if (!stairs.best.empty()) add(one.runs, stairs.best.back());
    add(one.runs, one.value);
  }
  if (!stairs.best.empty()) add(figure.runs, stairs.best.back());
  return stairs;
}

/// The best value after a number of runs. NaN before the first kept point.
double best_so_far(const ConvergenceFigure& figure, double runs) {
  double best = std::nan("");
  for (const Improvement& one : figure.best) {
    if (one.runs <= runs) best = one.value;
  }
  return best;
}

/// Calls `draw` with the number of runs before each restart.
template <class Draw>
void each_restart(const std::vector<ConvergencePoint>& search, const Draw& draw) {
  for (std::size_t k = 1; k < search.size(); ++k) {
    if (search[k].restart != search[k - 1].restart) draw(search[k - 1].runs);
  }
}

void draw_convergence_legend(Canvas& canvas, const ConvergenceFigure& figure) {
  std::vector<LegendEntry> entries{line_entry("best so far", kSoFar, 26),
                                   line_entry("best of the generation", kOfGeneration, 26),
                                   line_entry("median, kept points", kMedian, 26)};
  const auto restarts = [](const std::vector<ConvergencePoint>& search) {
    return !search.empty() && search.back().restart > 0;
  };
  if (std::ranges::any_of(figure.searches, restarts)) entries.push_back(line_entry("start again", kRestart, 26));
  draw_legend(&canvas, entries, kObjectiveArea.left, kSheetWidth + LegendLook().behind, kConvergenceHeight - 47.5);
}

}  // namespace

std::string convergence_svg(const ConvergenceFigure& figure) {
  Svg svg(kSheetWidth, kConvergenceHeight, figure.title);
  draw_sheet_title(svg, figure.title);
  std::vector<Curves> all;
  const Curves stairs = staircase(figure);
  Bounds runs;
  Bounds values;
  runs.add(std::vector<double>{0, std::max(1.0, figure.runs)});
  values.add(stairs.best);
  for (const std::vector<ConvergencePoint>& search : figure.searches) {
    const Curves& curves = all.emplace_back(curves_of(search));
    values.add(curves.best);
    values.add(curves.median);
  }
  const Ticks across = ticks_around(runs, 8);
  const Plot upper(svg, kObjectiveArea, {.ticks = across, .texts = false},
                   {.ticks = ticks_around(values, 7), .title = figure.value.title()});
  const Plot lower(svg, kShareArea, {.ticks = across, .title = "runs"}, {.ticks = ticks_around(0, 1, 2), .title = "kept"});
  upper.draw_axes();
  lower.draw_axes();
  for (std::size_t s = 0; s < all.size(); ++s) {
    upper.curve(all[s].runs, all[s].median, kMedian);
    upper.curve(all[s].runs, all[s].best, kOfGeneration);
    lower.curve(all[s].runs, all[s].share, kShare);
    each_restart(figure.searches[s], [&](double at) {
      upper.moment(at, kRestart);
      lower.moment(at, kRestart);
    });
  }
  upper.curve(stairs.runs, stairs.best, kSoFar);
  draw_convergence_legend(svg, figure);
  draw_sheet_note(svg, figure.note, kConvergenceHeight - 14);
  return svg.finish();
}

std::string convergence_csv(const ConvergenceFigure& figure) {
  std::string text = "search,generation,restart,points,best,median,kept,spread,runs,best_so_far\n";
  for (std::size_t s = 0; s < figure.searches.size(); ++s) {
    for (const ConvergencePoint& p : figure.searches[s]) {
      text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", s, csv_cell(p.generation), csv_cell(p.restart), csv_cell(p.points),
                          csv_cell(p.best), csv_cell(p.median), csv_cell(p.kept), csv_cell(p.spread), csv_cell(p.runs),
                          csv_cell(best_so_far(figure, p.runs)));
    }
  }
  return text;
}

std::string improvements_csv(const ConvergenceFigure& figure) {
  std::string text = "runs,best_so_far\n";
  for (const Improvement& one : figure.best) text += csv_cell(one.runs) + "," + csv_cell(one.value) + "\n";
  return text;
}

}  // namespace gaitlab::report
