#include "report/figures/run/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/figures/run/coincide.h"
#include "report/figures/run/run_sheet.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr double kRunsLeft = 90, kRunsRight = 970;                   // px
constexpr double kRunsHead = 30, kRunsHeight = 190, kRunsFoot = 52;  // px

struct CurveStyle {
  std::string_view colour;
  std::string dash;
  [[nodiscard]] Style style() const { return {.stroke = colour, .width = 1.6, .dash = dash}; }
};

/// Styles of the runs: seven colours, then the same colours with dashes. The first of n coinciding curves is solid. Each
/// further curve is drawn over it and leaves 1/n of every 28 px to the previous curve.
std::vector<CurveStyle> styles(const CurvesInput& input) {
  constexpr std::array kColours{colour::kBlue, colour::kVermillion, colour::kGreen, colour::kPurple,
                                colour::kSky,  colour::kOrange,     colour::kBlack};
  constexpr std::array kDashes{"", "7 3", "2 3"};
  constexpr double kDash = 28;  // px
  std::vector<CurveStyle> all;
  for (std::size_t run = 0; run < input.names.size(); ++run)
    all.push_back({kColours[run % kColours.size()], kDashes[run / kColours.size() % kDashes.size()]});
  for (const std::vector<std::size_t>& group : input.coincide) {
    for (std::size_t k = 0; k < group.size(); ++k) {
      const double left = kDash * static_cast<double>(k) / static_cast<double>(group.size());
      all[group[k]].dash = k == 0 ? "" : fmt::format("{:.1f} {:.1f}", kDash - left, left);
    }
  }
  return all;
}

double end_of(const CurvesInput& input) {
  double end = 0;
  for (const std::vector<double>& time : input.time) end = time.empty() ? end : std::max(end, time.back());
  return end;
}

/// Draws the legend and returns the y below it. Without a canvas nothing is drawn.
double runs_legend(Canvas* canvas, const CurvesInput& input, const std::vector<CurveStyle>& styles) {
  std::vector<LegendEntry> entries;
  for (std::size_t run = 0; run < input.names.size(); ++run)
    entries.push_back(line_entry(input.names[run], styles[run].style(), 38));
  double y = draw_legend(canvas, entries, kRunsLeft, kRunsRight, kTitleHeight + 10);
  for (const std::vector<std::size_t>& group : input.coincide) {
    y += kLegendLine;
    if (canvas != nullptr) canvas->text({kRunsLeft, y}, "coincide: " + run_names(group, input.names));
  }
  return y + kLegendLine / 2;
}

Bounds shown_bounds(const CurvesInput& input, const CurvesPanel& shown) {
  Bounds bounds;
  for (std::size_t run = 0; run < shown.values.size(); ++run) {
    for (std::size_t k = 0; k < shown.values[run].size(); ++k) {
      if (input.time[run][k] >= shown.from) bounds.add(shown.values[run][k]);
    }
  }
  return bounds;
}

}  // namespace

std::string curves_svg(const CurvesInput& input) {
  const std::vector<CurveStyle> style = styles(input);
  double top = runs_legend(nullptr, input, style);
  constexpr double kPanel = kRunsHead + kRunsHeight + kRunsFoot;
  Svg svg(kWidth, top + kPanel * static_cast<double>(input.panels.size()), input.title);
  draw_run_title(svg, input.title);
  runs_legend(&svg, input, style);
  for (const CurvesPanel& shown : input.panels) {
    svg.text({kRunsLeft, top + 20}, shown.title, {.bold = true});
    const PlotArea area{kRunsLeft, kRunsRight, top + kRunsHead, top + kRunsHead + kRunsHeight};
    const Plot plot(svg, area, {.ticks = ticks_within(shown.from, end_of(input), 8), .title = "time (s)"},
                    {ticks_around(shown_bounds(input, shown), 5)});
    plot.draw_axes();
    for (std::size_t run = 0; run < shown.values.size(); ++run)
      plot.curve(input.time[run], shown.values[run], style[run].style());
    top += kPanel;
  }
  return svg.finish();
}

}  // namespace gaitlab::report
