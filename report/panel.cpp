#include "report/panel.h"

#include <algorithm>
#include <cmath>

namespace gaitlab::report {

void Bounds::add(double value) {
  if (!std::isfinite(value)) return;
  lo = std::min(lo, value);
  hi = std::max(hi, value);
}

void Bounds::add(std::span<const double> values) {
  for (const double value : values) add(value);
}

Ticks Bounds::ticks(int count) const { return empty() ? ticks_around(0, 1, count) : ticks_around(lo, hi, count); }

Panel::Panel(Svg& svg, const PlotArea& area, const Ticks& time, const Ticks& values)
    : svg_(svg),
      area_(area),
      time_(time),
      x_{time.lo, time.hi, area.left, area.right},
      y_{values.lo, values.hi, area.bottom, area.top} {
  for (const double t : time.values()) svg_.line({x_(t), area.top}, {x_(t), area.bottom}, kGridLine);
  for (const double value : values.values()) {
    svg_.line({area.left, y_(value)}, {area.right, y_(value)}, kGridLine);
    svg_.text({area.left - 8, y_(value) + 4.5}, values.label(value), {.size = 11, .anchor = Anchor::end});
  }
  svg_.rectangle({area.left, area.top}, area.right - area.left, area.bottom - area.top, kAxisLine);
}

void Panel::curve(std::span<const double> time, std::span<const double> values, const Style& style) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (time[i] >= time_.lo && time[i] <= time_.hi) points.push_back({x_(time[i]), y_(values[i])});
  }
  svg_.polyline(thinned(points), style);
}

void Panel::level(double value, const Style& style) { svg_.line({area_.left, y_(value)}, {area_.right, y_(value)}, style); }

void Panel::moment(double time, const Style& style) { svg_.line({x_(time), area_.top}, {x_(time), area_.bottom}, style); }

void Panel::time_axis() {
  for (const double t : time_.values()) svg_.text({x_(t), area_.bottom + 18}, time_.label(t), {.anchor = Anchor::middle});
  svg_.text({(area_.left + area_.right) / 2, area_.bottom + 36}, "time (s)", {.anchor = Anchor::middle});
}

}  // namespace gaitlab::report
