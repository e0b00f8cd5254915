#include "report/figures/run/log_figure.h"

#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

// px
constexpr double kLogWidth = 440, kLeft = 56, kRight = 430, kTop = 10;
constexpr double kCurves = 150, kDifferences = 76, kGap = 12;  // heights of the panels, and the distance between them
constexpr double kFoot = 46;                                   // time axis with its title
constexpr double kAway = 42;                                   // from the frame to a title at its side
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

Axis axis_of(std::initializer_list<std::span<const double>> curves, const std::string& title, int ticks) {
  Bounds bounds;
  for (const auto& one : curves) bounds.add(one);
  return {.ticks = ticks_around(bounds, ticks), .title = title, .away = kAway};
}

}  // namespace

std::string log_figure(const std::string& title, std::span<const double> t, std::span<const LogStretch> off,
                       std::span<const LogCurves> curves) {
  const double height = kCurves + kGap + kDifferences + kFoot + kTop;
  Svg svg(kLogWidth, height * static_cast<double>(curves.size()), title);
  const Ticks times = ticks_within(0, t.back(), 6);
  double top = kTop;
  for (const LogCurves& of : curves) {
    LogPanel panel{{kLeft, kRight, top, top + kCurves}, {.ticks = times, .texts = false}, {}, off};
    panel.left = axis_of({of.log, of.run, of.other}, of.title, 4);
    const Plot above = panel.begin(svg);
    above.curve(t, of.log, kLogLine);
    above.curve(t, of.other, kOtherLine);
    above.curve(t, of.run, kRunLine);

    const std::vector<double> run = differences(of.run, of.log, of.scale);
    const std::vector<double> other = differences(of.other, of.log, of.scale);
    panel.area.top = panel.area.bottom + kGap;
    panel.area.bottom = panel.area.top + kDifferences;
    panel.below = {.ticks = times, .title = "t, s"};
    panel.left = axis_of({run, other}, of.of_difference, 3);
    const Plot under = panel.begin(svg);
    under.curve(t, other, kOtherLine);
    under.curve(t, run, kRunLine);
    top += height;
  }
  return svg.finish();
}

}  // namespace gaitlab::report
