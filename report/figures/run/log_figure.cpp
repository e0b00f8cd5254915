#include "report/figures/run/log_figure.h"

#include <algorithm>
#include <cmath>

#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

// px
constexpr double kLogWidth = 446, kLeft = 64, kRight = 438, kTop = 10;
constexpr double kCurves = 150, kDifferences = 76, kGap = 12;  // heights of the panels, and the distance between them
constexpr double kFoot = 46;                                   // time axis with its title
constexpr double kAway = 50;                                   // from the frame to a title at its side
constexpr double kRoom = 0.05;                                 // share of the range above and below the curves
constexpr PlotLook kSmall{.text = 12};

constexpr Style kLogLine{.stroke = log_colour::kLog, .width = 3.5}, kRunLine{.stroke = log_colour::kRun, .width = 1.6},
    kOtherLine{.stroke = log_colour::kOther, .width = 0.8};

struct LogPanel {
  PlotArea area;
  Axis below, left;
  std::span<const LogStretch> off;

  [[nodiscard]] Plot begin(Canvas& canvas) const {
    Plot plot(canvas, area, below, left, kSmall);
    for (const LogStretch& one : off) plot.band(one.from, one.to, log_colour::kOff);
    plot.draw_axes();
    return plot;
  }
};

std::vector<double> differences(std::span<const double> run, std::span<const double> log, double scale) {
  std::vector<double> made;
  for (std::size_t k = 0; k < run.size(); ++k) made.push_back((run[k] - log[k]) / scale);
  return made;
}

/// Axis for the curves, as far as they are within `most`: a run may leave a log for a moment, and must not flatten it.
Axis axis_of(std::initializer_list<std::span<const double>> curves, const Bounds& most, const std::string& title, int ticks) {
  Bounds bounds;
  for (const auto& one : curves) {
    for (const double value : one) bounds.add(std::clamp(value, most.lo, most.hi));
  }
  return {.ticks = ticks_over(bounds, false, ticks, kRoom), .title = title, .away = kAway};
}

/// The range of the log, wider by its span or by `least`.
Bounds around_log(std::span<const double> log, double least) {
  Bounds bounds;
  bounds.add(log);
  const double wider = std::max(bounds.hi - bounds.lo, least);
  return {bounds.lo - wider, bounds.hi + wider};
}

/// Twice the magnitude that a hundredth of the differences exceeds.
Bounds usual_differences(std::span<const double> one, std::span<const double> other) {
  std::vector<double> magnitudes;
  for (const auto& curve : {one, other}) {
    for (const double value : curve) magnitudes.push_back(std::abs(value));
  }
  const auto at = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() * 99 / 100);
  std::ranges::nth_element(magnitudes, at);
  return {-2 * *at, 2 * *at};
}

}  // namespace

std::string log_figure(const std::string& title, std::span<const double> t, std::span<const LogStretch> off,
                       std::span<const LogCurves> curves) {
  const double height = kCurves + kGap + kDifferences + kFoot + kTop;
  Svg svg(kLogWidth, height * static_cast<double>(curves.size()), title);
  const Ticks times = ticks_within(0, t.back(), 6);
  double top = kTop;
  for (const LogCurves& of : curves) {
    const std::vector<double> run = differences(of.run, of.log, of.scale);
    const std::vector<double> other = differences(of.other, of.log, of.scale);
    const Bounds usual = usual_differences(run, other);

    LogPanel panel{{kLeft, kRight, top, top + kCurves}, {.ticks = times, .texts = false}, {}, off};
    panel.left = axis_of({of.log, of.run, of.other}, around_log(of.log, usual.hi * of.scale), of.title, 6);
    const Plot above = panel.begin(svg);
    above.curve(t, of.log, kLogLine);
    above.curve(t, of.other, kOtherLine);
    above.curve(t, of.run, kRunLine);

    panel.area.top = panel.area.bottom + kGap;
    panel.area.bottom = panel.area.top + kDifferences;
    panel.below = {.ticks = times, .title = "t, s"};
    panel.left = axis_of({run, other}, usual, of.of_difference, 5);
    const Plot under = panel.begin(svg);
    under.curve(t, other, kOtherLine);
    under.curve(t, run, kRunLine);
    top += height;
  }
  return svg.finish();
}

}  // namespace gaitlab::report
