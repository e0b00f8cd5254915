#include "report/figures/run/overlay.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/plot/panel.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr double kLeft = 110, kRight = 970;  // px
constexpr double kHead = 30, kSignals = 150, kGap = 14, kDifference = 80, kFoot = 52;
constexpr double kPanel = kHead + kSignals + kGap + kDifference + kFoot;

constexpr Style kReference{.stroke = colour::kBlue, .width = 2};
constexpr Style kNow{.stroke = colour::kVermillion, .width = 1.4, .dash = "7 3"};
constexpr Style kDifferenceLine{.stroke = colour::kBlack, .width = 1.2};
constexpr Style kTolerance{.stroke = colour::kGreen, .width = 1.2, .dash = "3 3"};
constexpr Style kOutside{.stroke = colour::kPurple, .width = 1.5};

std::vector<double> difference(const OverlayPanel& panel) {
  std::vector<double> d;
  for (std::size_t i = 0; i < panel.time.size(); ++i) d.push_back(panel.now[i] - panel.reference[i]);
  return d;
}

void legend(Svg& svg, const OverlayPanel& panel, double top) {
  const std::string unit = panel.unit.empty() ? "" : " (" + panel.unit + ")";
  svg.text({kLeft, top + 18}, panel.name + unit, {.bold = true});
  double x = kRight;
  const auto entry = [&](const std::string& name, const Style& style) {
    x -= text_width(name, 13);
    svg.text({x, top + 18}, name);
    svg.line({x - 38, top + 13.5}, {x - 8, top + 13.5}, style);
    x -= 56;
  };
  if (panel.outside) entry(fmt::format("outside from {:.6g} s", *panel.outside), kOutside);
  entry("3 bands", kTolerance);
  entry("now", kNow);
  entry("golden", kReference);
}

void draw(Svg& svg, const OverlayPanel& panel, double top) {
  const Ticks time = ticks_within(panel.time.front(), panel.time.back(), 8);
  const double signals = top + kHead;
  Bounds both;
  both.add(panel.reference);
  both.add(panel.now);
  Panel upper(svg, {kLeft, kRight, signals, signals + kSignals}, time, both.ticks(5));
  upper.curve(panel.time, panel.reference, kReference);
  upper.curve(panel.time, panel.now, kNow);
  const std::vector<double> d = difference(panel);
  Bounds apart;
  apart.add(d);
  apart.add(panel.tolerance);
  apart.add(-panel.tolerance);
  const double below = signals + kSignals + kGap;
  Panel lower(svg, {kLeft, kRight, below, below + kDifference}, time, apart.ticks(3));
  for (const double edge : {-panel.tolerance, panel.tolerance}) lower.level(edge, kTolerance);
  lower.curve(panel.time, d, kDifferenceLine);
  if (panel.outside) {
    upper.moment(*panel.outside, kOutside);
    lower.moment(*panel.outside, kOutside);
  }
  lower.time_axis();
  svg.text({24, below + kDifference / 2}, "difference", {.size = 11, .anchor = Anchor::middle, .upwards = true});
  legend(svg, panel, top);
}

}  // namespace

std::string overlay_svg(const std::string& title, const std::vector<OverlayPanel>& panels) {
  const auto drawn = [](const OverlayPanel& panel) { return !panel.time.empty(); };
  const auto count = std::count_if(panels.begin(), panels.end(), drawn);
  Svg svg(kWidth, kTitleHeight + kPanel * static_cast<double>(count));
  svg.text({kWidth / 2, 28}, title, {.size = 18, .anchor = Anchor::middle, .bold = true});
  double top = kTitleHeight;
  for (const OverlayPanel& panel : panels) {
    if (!drawn(panel)) continue;
    draw(svg, panel, top);
    top += kPanel;
  }
  return svg.finish();
}

}  // namespace gaitlab::report
