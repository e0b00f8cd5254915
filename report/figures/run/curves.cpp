#include "report/figures/run/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/figures/run/coincide.h"
#include "report/plot/legend.h"
#include "report/plot/panel.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr double kLeft = 90, kRight = 970;  // px
constexpr double kHead = 30, kHeight = 190, kFoot = 52;

struct CurveStyle {
  std::string_view colour;
  std::string dash;
  [[nodiscard]] Style style() const { return {.stroke = colour, .width = 1.6, .dash = dash}; }
};

/// Seven colours, then again with dashes. Of n curves on each other, the first is whole and each further one, drawn over it,
/// leaves 1/n of every 28 px to the one before.
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

/// Draws the legend, or only measures it: the y below it.
double legend(Svg* svg, const CurvesInput& input, const std::vector<CurveStyle>& styles) {
  std::vector<LegendEntry> entries;
  for (std::size_t run = 0; run < input.names.size(); ++run) entries.push_back({input.names[run], styles[run].style()});
  double y = draw_legend(svg, entries, kLeft, kRight, kTitleHeight + 10);
  for (const std::vector<std::size_t>& group : input.coincide) {
    y += kLegendLine;
    if (svg != nullptr) svg->text({kLeft, y}, "coincide: " + run_names(group, input.names));
  }
  return y + kLegendLine / 2;
}

}  // namespace

std::string curves_svg(const CurvesInput& input) {
  const std::vector<CurveStyle> style = styles(input);
  double top = legend(nullptr, input, style);
  Svg svg(kWidth, top + (kHead + kHeight + kFoot) * static_cast<double>(input.panels.size()));
  svg.text({kWidth / 2, 28}, input.title, {.size = 18, .anchor = Anchor::middle, .bold = true});
  legend(&svg, input, style);
  const double end = end_of(input);
  for (const CurvesPanel& shown : input.panels) {
    svg.text({kLeft, top + 20}, shown.title, {.bold = true});
    Bounds bounds;
    for (std::size_t run = 0; run < shown.values.size(); ++run) {
      for (std::size_t k = 0; k < shown.values[run].size(); ++k) {
        if (input.time[run][k] >= shown.from) bounds.add(shown.values[run][k]);
      }
    }
    Panel panel(svg, {kLeft, kRight, top + kHead, top + kHead + kHeight}, ticks_within(shown.from, end, 8), bounds.ticks(5));
    for (std::size_t run = 0; run < shown.values.size(); ++run) {
      panel.curve(input.time[run], shown.values[run], style[run].style());
    }
    panel.time_axis();
    top += kHead + kHeight + kFoot;
  }
  return svg.finish();
}

}  // namespace gaitlab::report
