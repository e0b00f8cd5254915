#include "report/plot/panel.h"

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

std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "\u2212");
  return text;
}

void draw_axis_below(Canvas& canvas, const PlotArea& area, const Ticks& ticks, std::string_view title, bool minus) {
  const Scale x{ticks.lo, ticks.hi, area.left, area.right};
  for (const double value : ticks.values()) {
    const std::string label = minus ? with_minus(ticks.label(value)) : ticks.label(value);
    canvas.text({x(value), area.bottom + 18}, label, {.anchor = Anchor::middle});
  }
  canvas.text({(area.left + area.right) / 2, area.bottom + 36}, title, {.anchor = Anchor::middle});
}

namespace {

/// Where [a, b] crosses a height.
Point crossing(Point a, Point b, double y) { return {a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y), y}; }

/// The line between two heights; where it leaves them there is a gap.
std::vector<Point> cut(const std::vector<Point>& points, double top, double bottom) {
  constexpr Point kGap{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  const auto within = [&](Point p) { return p.y >= top && p.y <= bottom; };
  std::vector<Point> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point p = points[i];
    if (i > 0 && finite(p) && finite(points[i - 1]) && !(within(p) && within(points[i - 1]))) {
      const Point before = points[i - 1];
      const double first = std::clamp(before.y, top, bottom);
      const double last = std::clamp(p.y, top, bottom);
      if (first != last) {
        if (!within(before)) kept.push_back(crossing(before, p, first));
        if (!within(p)) kept.push_back(crossing(before, p, last));
      }
    }
    kept.push_back(within(p) ? p : kGap);
  }
  return kept;
}

}  // namespace

Panel::Panel(Canvas& canvas, const PlotArea& area, const Ticks& time, const Ticks& values, const PanelLook& look)
    : canvas_(canvas),
      area_(area),
      time_(time),
      x_{time.lo, time.hi, area.left, area.right},
      y_{values.lo, values.hi, area.bottom, area.top},
      right_(y_),
      look_(look) {
  for (const double t : time.values()) canvas_.line({x_(t), area.top}, {x_(t), area.bottom}, look.grid);
  for (const double value : values.values()) {
    const bool zero = std::abs(value) < 0.5 * values.step;
    canvas_.line({area.left, y_(value)}, {area.right, y_(value)}, zero ? look.zero : look.grid);
    canvas_.text({area.left - 8, y_(value) + 4.5}, label(values, value), {.size = look.tick_size, .anchor = Anchor::end});
  }
  canvas_.rectangle({area.left, area.top}, area.right - area.left, area.bottom - area.top, kAxisLine);
}

std::string Panel::label(const Ticks& ticks, double value) const {
  return look_.minus ? with_minus(ticks.label(value)) : ticks.label(value);
}

void Panel::right_axis(const Ticks& values) {
  right_ = {values.lo, values.hi, area_.bottom, area_.top};
  for (const double value : values.values()) {
    canvas_.line({area_.right, right_(value)}, {area_.right + 4, right_(value)}, kAxisLine);
    canvas_.text({area_.right + 8, right_(value) + 4.5}, label(values, value), {.size = look_.tick_size});
  }
}

Point Panel::at(double x, double value, Side side) const { return {x_(x), side == Side::left ? y_(value) : right_(value)}; }

void Panel::curve(std::span<const double> time, std::span<const double> values, const Style& style, Side side) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (time[i] >= time_.lo && time[i] <= time_.hi) points.push_back(at(time[i], values[i], side));
  }
  if (look_.cut) points = cut(points, area_.top, area_.bottom);
  canvas_.polyline(thinned(points, look_.cell), style);
}

void Panel::level(double value, const Style& style) { canvas_.line({area_.left, y_(value)}, {area_.right, y_(value)}, style); }

void Panel::moment(double time, const Style& style) { canvas_.line({x_(time), area_.top}, {x_(time), area_.bottom}, style); }

void Panel::axis_below(std::string_view title) { draw_axis_below(canvas_, area_, time_, title, look_.minus); }

void Panel::side_title(std::string_view title, Side side, double away) {
  const double x = side == Side::left ? area_.left - away : area_.right + away;
  canvas_.text({x, (area_.top + area_.bottom) / 2}, title, {.anchor = Anchor::middle, .upwards = true});
}

}  // namespace gaitlab::report
