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
  std::vector<double> generation, so_far, best, median, share;
};

Curves curves_of(const std::vector<ConvergencePoint>& search, bool maximize) {
  Curves curves;
  double so_far = std::nan("");
  for (const ConvergencePoint& p : search) {
    const bool better = maximize ? p.best > so_far : p.best < so_far;
    if (std::isnan(so_far) || better) so_far = p.best;
    curves.generation.push_back(p.generation);
    curves.so_far.push_back(so_far);
    curves.best.push_back(p.best);
    curves.median.push_back(p.median);
    curves.share.push_back(p.kept);
  }
  return curves;
}

/// Calls `draw` with the generation of each restart.
template <class Draw>
void each_restart(const std::vector<ConvergencePoint>& search, const Draw& draw) {
  for (std::size_t k = 1; k < search.size(); ++k) {
    if (search[k].restart != search[k - 1].restart) draw(search[k].generation);
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
  Bounds generations;
  Bounds values;
  for (const std::vector<ConvergencePoint>& search : figure.searches) {
    const Curves& curves = all.emplace_back(curves_of(search, figure.maximize));
    generations.add(curves.generation);
    values.add(curves.best);
    values.add(curves.median);
  }
  if (!generations.empty()) generations.add(1);
  const Ticks across = ticks_around(generations, 8);
  const Plot upper(svg, kObjectiveArea, {.ticks = across, .texts = false},
                   {.ticks = ticks_around(values, 7), .title = figure.value.title()});
  const Plot lower(svg, kShareArea, {.ticks = across, .title = "generation"},
                   {.ticks = ticks_around(0, 1, 2), .title = "kept"});
  upper.draw_axes();
  lower.draw_axes();
  for (std::size_t s = 0; s < all.size(); ++s) {
    upper.curve(all[s].generation, all[s].median, kMedian);
    upper.curve(all[s].generation, all[s].best, kOfGeneration);
    upper.curve(all[s].generation, all[s].so_far, kSoFar);
    lower.curve(all[s].generation, all[s].share, kShare);
    each_restart(figure.searches[s], [&](double generation) {
      upper.moment(generation, kRestart);
      lower.moment(generation, kRestart);
    });
  }
  draw_convergence_legend(svg, figure);
  draw_sheet_note(svg, figure.note, kConvergenceHeight - 14);
  return svg.finish();
}

std::string convergence_csv(const ConvergenceFigure& figure) {
  std::string text = "search,generation,restart,points,best,median,kept,spread\n";
  for (std::size_t s = 0; s < figure.searches.size(); ++s) {
    for (const ConvergencePoint& p : figure.searches[s]) {
      text += fmt::format("{},{},{},{},{},{},{},{}\n", s, csv_cell(p.generation), csv_cell(p.restart), csv_cell(p.points),
                          csv_cell(p.best), csv_cell(p.median), csv_cell(p.kept), csv_cell(p.spread));
    }
  }
  return text;
}

}  // namespace gaitlab::report
