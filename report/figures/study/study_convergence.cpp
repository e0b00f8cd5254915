#include "report/figures/study/study_convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"
#include "report/plot/panel.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr PlotArea kObjectiveArea{90, 700, 64, 330};  // px
constexpr PlotArea kShareArea{90, 700, 360, 450};     // px
constexpr double kConvergenceWidth = 760, kConvergenceHeight = 560;
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

}  // namespace

std::string convergence_svg(const ConvergenceFigure& figure) {
  Svg svg(kConvergenceWidth, kConvergenceHeight);
  svg.text({kObjectiveArea.left, 30}, figure.title, {.size = 17, .bold = true});
  std::vector<Curves> all;
  Bounds generations;
  Bounds values;
  for (const std::vector<ConvergencePoint>& search : figure.searches) {
    const Curves& curves = all.emplace_back(curves_of(search, figure.maximize));
    generations.add(curves.generation);
    values.add(curves.best);
    values.add(curves.median);
  }
  const Ticks across =
      generations.empty() ? ticks_around(0, 1, 8) : ticks_around(generations.lo, std::max(generations.hi, 1.0), 8);
  Panel upper(svg, kObjectiveArea, across, values.ticks(7), {});
  upper.side_title(figure.value.title(), Side::left, 62);
  Panel lower(svg, kShareArea, across, ticks_around(0, 1, 2), {});
  lower.side_title("kept", Side::left, 62);
  lower.axis_below("generation");
  for (std::size_t s = 0; s < all.size(); ++s) {
    upper.curve(all[s].generation, all[s].median, kMedian);
    upper.curve(all[s].generation, all[s].best, kOfGeneration);
    upper.curve(all[s].generation, all[s].so_far, kSoFar);
    lower.curve(all[s].generation, all[s].share, kShare);
    const std::vector<ConvergencePoint>& search = figure.searches[s];
    for (std::size_t k = 1; k < search.size(); ++k) {
      if (search[k].restart == search[k - 1].restart) continue;
      upper.moment(search[k].generation, kRestart);
      lower.moment(search[k].generation, kRestart);
    }
  }
  double x = kObjectiveArea.left;
  const auto entry = [&](const char* name, const Style& style) {
    svg.line({x, kConvergenceHeight - 52}, {x + 26, kConvergenceHeight - 52}, style);
    svg.text({x + 32, kConvergenceHeight - 47.5}, name);
    x += 56 + text_width(name, 13);
  };
  entry("best so far", kSoFar);
  entry("best of the generation", kOfGeneration);
  entry("median, kept points", kMedian);
  const auto restarts = [](const std::vector<ConvergencePoint>& search) {
    return !search.empty() && search.back().restart > 0;
  };
  if (std::ranges::any_of(figure.searches, restarts)) entry("start again", kRestart);
  svg.text({20, kConvergenceHeight - 14}, figure.note, {.size = 11, .fill = colour::kGrey});
  return svg.finish();
}

std::string convergence_csv(const ConvergenceFigure& figure) {
  std::string text = "search,generation,restart,points,best,median,kept,spread\n";
  const auto cell = [](double value) { return std::isfinite(value) ? number_text(value) : ""; };
  for (std::size_t s = 0; s < figure.searches.size(); ++s) {
    for (const ConvergencePoint& p : figure.searches[s])
      text += fmt::format("{},{},{},{},{},{},{},{}\n", s, cell(p.generation), cell(p.restart), cell(p.points), cell(p.best),
                          cell(p.median), cell(p.kept), cell(p.spread));
  }
  return text;
}

}  // namespace gaitlab::report
