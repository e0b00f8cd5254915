#include "report/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/axes.h"
#include "report/svg.h"

namespace gaitlab {

namespace {

constexpr double kWidth = 1000, kLeft = 110, kRight = 970;  // px
constexpr double kTitleHeight = 44, kHead = 30, kSignals = 150, kGap = 14, kDifference = 80, kFoot = 52;
constexpr double kPanel = kHead + kSignals + kGap + kDifference + kFoot;

constexpr Style kGrid{.stroke = colour::kPale};
constexpr Style kFrame{.stroke = colour::kInk, .width = 1.2};
constexpr Style kReference{.stroke = colour::kBlue, .width = 2};
constexpr Style kNow{.stroke = colour::kVermillion, .width = 1.4, .dash = "7 3"};
constexpr Style kDifferenceLine{.stroke = colour::kBlack, .width = 1.2};
constexpr Style kTolerance{.stroke = colour::kGreen, .width = 1.2, .dash = "3 3"};
constexpr Style kOutside{.stroke = colour::kPurple, .width = 1.5};

struct Bounds {
  double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();
  void add(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      lo = std::min(lo, value);
      hi = std::max(hi, value);
    }
  }
  [[nodiscard]] Ticks ticks(int count) const { return lo > hi ? ticks_around(0, 1, count) : ticks_around(lo, hi, count); }
};

std::vector<double> difference(const OverlayPanel& panel) {
  std::vector<double> d;
  for (std::size_t i = 0; i < panel.time.size(); ++i) d.push_back(panel.now[i] - panel.reference[i]);
  return d;
}

class Drawing {
 public:
  Drawing(Svg& svg, const OverlayPanel& panel, double top)
      : svg_(svg),
        panel_(panel),
        top_(top),
        time_(ticks_within(panel.time.front(), panel.time.back(), 8)),
        x_{time_.lo, time_.hi, kLeft, kRight} {}

  void draw() {
    const double signals = top_ + kHead;
    Bounds both;
    both.add(panel_.reference);
    both.add(panel_.now);
    const Scale y = axes(both.ticks(5), signals, signals + kSignals);
    curve(panel_.reference, y, kReference);
    curve(panel_.now, y, kNow);
    const std::vector<double> d = difference(panel_);
    Bounds apart;
    apart.add(d);
    apart.add({-panel_.tolerance, panel_.tolerance});
    const double below = signals + kSignals + kGap;
    const Scale dy = axes(apart.ticks(3), below, below + kDifference);
    for (const double edge : {-panel_.tolerance, panel_.tolerance})
      svg_.line({kLeft, dy(edge)}, {kRight, dy(edge)}, kTolerance);
    curve(d, dy, kDifferenceLine);
    if (panel_.outside) svg_.line({x_(*panel_.outside), signals}, {x_(*panel_.outside), below + kDifference}, kOutside);
    for (const double t : time_.values())
      svg_.text({x_(t), below + kDifference + 18}, time_.label(t), {.anchor = Anchor::middle});
    svg_.text({(kLeft + kRight) / 2, below + kDifference + 36}, "time (s)", {.anchor = Anchor::middle});
    svg_.text({24, below + kDifference / 2}, "difference", {.size = 11, .anchor = Anchor::middle, .upwards = true});
    legend();
  }

 private:
  Scale axes(const Ticks& ticks, double top, double bottom) {
    const Scale y{ticks.lo, ticks.hi, bottom, top};
    for (const double t : time_.values()) svg_.line({x_(t), top}, {x_(t), bottom}, kGrid);
    for (const double value : ticks.values()) {
      svg_.line({kLeft, y(value)}, {kRight, y(value)}, kGrid);
      svg_.text({kLeft - 8, y(value) + 4.5}, ticks.label(value), {.size = 11, .anchor = Anchor::end});
    }
    svg_.rectangle({kLeft, top}, kRight - kLeft, bottom - top, kFrame);
    return y;
  }

  void curve(const std::vector<double>& values, const Scale& y, const Style& style) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < values.size(); ++i) points.push_back({x_(panel_.time[i]), y(values[i])});
    svg_.polyline(thinned(points), style);
  }

  void legend() {
    const std::string unit = panel_.unit.empty() ? "" : " (" + panel_.unit + ")";
    svg_.text({kLeft, top_ + 18}, panel_.name + unit, {.bold = true});
    double x = kRight;
    const auto entry = [&](const std::string& name, const Style& style) {
      x -= text_width(name, 13);
      svg_.text({x, top_ + 18}, name);
      svg_.line({x - 38, top_ + 13.5}, {x - 8, top_ + 13.5}, style);
      x -= 56;
    };
    if (panel_.outside) entry(fmt::format("outside from {:.6g} s", *panel_.outside), kOutside);
    entry("3 bands", kTolerance);
    entry("now", kNow);
    entry("golden", kReference);
  }

  Svg& svg_;
  const OverlayPanel& panel_;
  double top_;
  Ticks time_;
  Scale x_;
};

}  // namespace

std::string overlay_svg(const std::string& title, const std::vector<OverlayPanel>& panels) {
  const auto drawn = [](const OverlayPanel& panel) { return !panel.time.empty(); };
  const auto count = std::count_if(panels.begin(), panels.end(), drawn);
  Svg svg(kWidth, kTitleHeight + kPanel * static_cast<double>(count));
  svg.text({kWidth / 2, 28}, title, {.size = 18, .anchor = Anchor::middle, .bold = true});
  double top = kTitleHeight;
  for (const OverlayPanel& panel : panels) {
    if (!drawn(panel)) continue;
    Drawing(svg, panel, top).draw();
    top += kPanel;
  }
  return svg.finish();
}

}  // namespace gaitlab
