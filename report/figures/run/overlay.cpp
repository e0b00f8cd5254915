#include "report/figures/run/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures/run/run_sheet.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr double kOverlayLeft = 110, kOverlayRight = 970;                              // px
constexpr double kHead = 30, kSignals = 150, kGap = 14, kDifference = 80, kFoot = 52;  // px
constexpr double kTitleAway = 56;                                                      // px
constexpr double kOverlayHeight = kHead + kSignals + kGap + kDifference + kFoot;

constexpr double kLeast = -2;    // logarithm to base 10 of the least multiple of the tolerance that is shown
constexpr double kMost = 1e9;    // largest multiple
constexpr double kLowTop = 0.5;  // least upper end of that axis, so that the tolerance is visible

constexpr Style kReference{.stroke = colour::kBlue, .width = 2};
constexpr Style kNow{.stroke = colour::kVermillion, .width = 1.4, .dash = "7 3"};
constexpr Style kDifferenceLine{.stroke = colour::kBlack, .width = 1.2};
constexpr Style kTolerance{.stroke = colour::kGreen, .width = 1.2, .dash = "3 3"};
constexpr Style kOutside{.stroke = colour::kPurple, .width = 1.5};

/// Logarithm to base 10 of the magnitude of the difference as a multiple of the tolerance, at least kLeast.
std::vector<double> difference(const OverlayPanel& panel) {
  std::vector<double> d;
  for (std::size_t i = 0; i < panel.time.size(); ++i) {
    const double apart = std::abs(panel.now[i] - panel.reference[i]);
    const double ratio = std::min(panel.tolerance > 0 ? apart / panel.tolerance : kMost, kMost);
    d.push_back(std::isnan(ratio) ? ratio : apart > 0 ? std::max(kLeast, log10_of(ratio)) : kLeast);
  }
  return d;
}

void draw_head(Canvas& canvas, const OverlayPanel& panel, double top) {
  const std::string unit = panel.unit.empty() ? "" : " (" + panel.unit + ")";
  std::vector<LegendEntry> entries{line_entry("golden", kReference), line_entry("now", kNow),
                                   line_entry("3 bands", kTolerance)};
  if (panel.outside) entries.push_back(line_entry(fmt::format("outside from {:.6g} s", *panel.outside), kOutside));
  const double room = draw_legend_row(canvas, entries, kOverlayRight, top + 18) - 20 - kOverlayLeft;
  const std::string name = panel.name + unit + panel.others;
  canvas.text({kOverlayLeft, top + 18}, name, {.size = fitting_size(name, 13, 9, room), .bold = true});
}

void draw_overlay(Canvas& canvas, const OverlayPanel& panel, double top) {
  const Ticks time = ticks_within(panel.time.front(), panel.time.back(), 8);
  const double signals = top + kHead;
  Bounds both;
  both.add(panel.reference);
  both.add(panel.now);
  const Plot upper(canvas, {kOverlayLeft, kOverlayRight, signals, signals + kSignals}, {.ticks = time, .texts = false},
                   {.ticks = ticks_around(both, 5), .title = panel.unit, .away = kTitleAway});
  upper.draw_axes();
  upper.curve(panel.time, panel.reference, kReference);
  upper.curve(panel.time, panel.now, kNow);
  const std::vector<double> d = difference(panel);
  Bounds apart{kLeast, kLowTop};
  apart.add(d);
  const double below = signals + kSignals + kGap;
  const Plot lower(canvas, {kOverlayLeft, kOverlayRight, below, below + kDifference}, {.ticks = time, .title = "time (s)"},
                   {.ticks = ticks_over(apart, true, 3), .title = "\u00D7 3 bands", .away = kTitleAway});
  lower.draw_axes();
  lower.level(0, kTolerance);
  lower.curve(panel.time, d, kDifferenceLine);
  if (panel.outside) {
    upper.moment(*panel.outside, kOutside);
    lower.moment(*panel.outside, kOutside);
  }
  draw_head(canvas, panel, top);
}

}  // namespace

std::string overlay_svg(const std::string& title, const std::vector<OverlayPanel>& panels) {
  const auto drawn = [](const OverlayPanel& panel) { return !panel.time.empty(); };
  const auto count = std::count_if(panels.begin(), panels.end(), drawn);
  Svg svg(kWidth, kTitleHeight + kOverlayHeight * static_cast<double>(count), title);
  draw_run_title(svg, title);
  double top = kTitleHeight;
  for (const OverlayPanel& panel : panels) {
    if (!drawn(panel)) continue;
    draw_overlay(svg, panel, top);
    top += kOverlayHeight;
  }
  return svg.finish();
}

}  // namespace gaitlab::report
