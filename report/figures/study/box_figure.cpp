#include "report/figures/study/box_figure.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "report/figures/study/study_sheet.h"
#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kMostGroups = 12, kMostDots = 500;
constexpr double kBoxSheetHigh = 520;           // px
constexpr PlotArea kBoxPlot{96, 720, 64, 400};  // px
constexpr Style kBoxLine{.stroke = colour::kInk, .width = 1.3};

void draw_box(Canvas& canvas, const Plot& plot, double x, double half, const BoxGroup& group) {
  std::vector<double> known;
  std::ranges::copy_if(group.values, std::back_inserter(known), [](double v) { return std::isfinite(v); });
  if (known.empty()) return canvas.text({x, kBoxPlot.bottom - 10}, "failed", {.size = 11, .anchor = Anchor::middle});
  const std::vector<double> in_order = known;
  std::ranges::sort(known);
  const auto y = [&](double value) { return plot.at(0, value).y; };
  const double low = y(quartile(known, 0.25));
  const double high = y(quartile(known, 0.75));
  const double middle = y(quartile(known, 0.5));
  canvas.line({x, y(known.front())}, {x, low}, kBoxLine);
  canvas.line({x, high}, {x, y(known.back())}, kBoxLine);
  for (const double end : {known.front(), known.back()}) canvas.line({x - half / 3, y(end)}, {x + half / 3, y(end)}, kBoxLine);
  canvas.rectangle({x - half, high}, 2 * half, low - high,
                   {.stroke = colour::kInk, .fill = group.kept ? "#C6DDF0" : colour::kWhite, .width = 1.3});
  canvas.line({x - half, middle}, {x + half, middle}, {.stroke = colour::kBlue, .width = 2.4});
  if (in_order.size() > kMostDots) return;
  // Dots are side by side in the order of the replicates.
  for (std::size_t k = 0; k < in_order.size(); ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(in_order.size());
    canvas.circle({x + half * (1.4 * share - 0.7), y(in_order[k])}, 2.6,
                  {.stroke = colour::kWhite, .fill = colour::kInk, .width = 0.6});
  }
}

}  // namespace

double quartile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double part = at - static_cast<double>(below);
  const double between = sorted[above] - sorted[below];
  return std::isfinite(between) ? sorted[below] + part * between : (1 - part) * sorted[below] + part * sorted[above];
}

std::string box_svg(const BoxFigure& figure) {
  const auto groups = std::span(figure.groups).first(std::min(figure.groups.size(), kMostGroups));
  Bounds range;
  std::vector<std::string> names;
  for (const BoxGroup& group : groups) {
    range.add(group.values);
    names.push_back(group.name);
  }
  Svg svg(kSheetWidth, kBoxSheetHigh, figure.title);
  draw_sheet_title(svg, figure.title);
  const Ticks across = groups.empty() ? Ticks{} : word_ticks(names);
  const Plot plot(svg, kBoxPlot, {.ticks = across, .title = figure.below, .lines = TickLines::none},
                  {.ticks = ticks_around(range, 7), .title = shortened(figure.axis)});
  plot.draw_axes();
  const double wide = (kBoxPlot.right - kBoxPlot.left) / static_cast<double>(std::max<std::size_t>(groups.size(), 1));
  for (std::size_t k = 0; k < groups.size(); ++k)
    draw_box(svg, plot, plot.at(static_cast<double>(k), 0).x, std::min(36.0, wide / 3), groups[k]);
  svg.text({kBoxPlot.left, kBoxPlot.bottom + 66}, "box: quartiles and median; dots: replicates; white: not kept", {.size = 12});
  draw_sheet_note(svg, figure.note, kBoxSheetHigh - 14);
  return svg.finish();
}

}  // namespace gaitlab::report
