#include "report/plot/plot.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gaitlab::report {

namespace {

constexpr double kOutside = 4;     // px, length of a tick
constexpr double kToText = 8;      // px, from the frame to a text at a side
constexpr double kHalfText = 4.5;  // px, from the middle of a text at a side to its baseline
constexpr double kTextBelow = 18;  // px, from the frame to the baseline of a text below the frame

/// Point at which the line through a and b has the height y.
Point crossing(Point a, Point b, double y) { return {a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y), y}; }

/// Parts of a line between two heights, with gaps outside. A point that is less than half a pixel outside is moved to the limit
/// instead.
std::vector<Point> cut(std::vector<Point> points, double top, double bottom) {
  constexpr double kTouch = 0.5;  // px
  for (Point& p : points) {
    if (p.y > top - kTouch && p.y < bottom + kTouch) p.y = std::clamp(p.y, top, bottom);
  }
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

Plot::Plot(Canvas& canvas, const PlotArea& area, Axis below, Axis left, const PlotLook& look)
    : canvas_(canvas),
      area_(area),
      below_(std::move(below)),
      left_(std::move(left)),
      look_(look),
      x_{below_.ticks.lo, below_.ticks.hi, area.left, area.right},
      y_{left_.ticks.lo, left_.ticks.hi, area.bottom, area.top},
      right_y_(y_) {}

void Plot::right_axis(Axis right) {
  right_ = std::move(right);
  right_y_ = {right_->ticks.lo, right_->ticks.hi, area_.bottom, area_.top};
}

void Plot::draw_axes() const {
  draw_ticks(below_, Edge::below);
  draw_ticks(left_, Edge::left);
  if (right_) draw_ticks(*right_, Edge::right);
  if (look_.frame) {
    canvas_.rectangle({area_.left, area_.top}, area_.right - area_.left, area_.bottom - area_.top, kAxisLine);
  } else {
    canvas_.line({area_.left, area_.bottom}, {area_.right, area_.bottom}, kAxisLine);
  }
  draw_title(below_, Edge::below);
  draw_title(left_, Edge::left);
  if (right_) draw_title(*right_, Edge::right);
}

void Plot::draw_ticks(const Axis& axis, Edge edge) const {
  const bool below = edge == Edge::below;
  const double side = edge == Edge::right ? area_.right : area_.left;
  const double out = edge == Edge::right ? 1 : -1;
  const Scale& y = edge == Edge::right ? right_y_ : y_;
  for (const Tick& tick : axis.ticks.marks) {
    const Point foot = below ? Point{x_(tick.at), area_.bottom} : Point{side, y(tick.at)};
    const bool zero = !below && std::abs(tick.at) < 0.5 * axis.ticks.step;
    if (axis.lines == TickLines::grid) {
      const Point across = below ? Point{foot.x, area_.top} : Point{area_.left + area_.right - side, foot.y};
      canvas_.line(across, foot, {.stroke = zero ? colour::kGrey : colour::kPale, .width = look_.grid});
    } else if (axis.lines == TickLines::outside) {
      canvas_.line(foot, below ? Point{foot.x, foot.y + kOutside} : Point{side + out * kOutside, foot.y}, kAxisLine);
    }
    if (!axis.texts) continue;
    const Anchor anchor = below ? Anchor::middle : edge == Edge::right ? Anchor::start : Anchor::end;
    canvas_.text(below ? Point{foot.x, foot.y + kTextBelow} : Point{side + out * kToText, foot.y + kHalfText}, tick.text,
                 {.size = look_.text, .anchor = anchor, .fill = axis.fill});
  }
}

void Plot::draw_title(const Axis& axis, Edge edge) const {
  if (axis.title.empty()) return;
  const double x = edge == Edge::right ? area_.right + axis.away : area_.left - axis.away;
  const Point middle{(area_.left + area_.right) / 2, (area_.top + area_.bottom) / 2};
  canvas_.text(edge == Edge::below ? Point{middle.x, area_.bottom + kTitleBelow} : Point{x, middle.y}, axis.title,
               {.anchor = Anchor::middle, .fill = axis.fill, .upwards = edge != Edge::below});
}

Point Plot::at(double x, double value, Side side) const { return {x_(x), side == Side::left ? y_(value) : right_y_(value)}; }

void Plot::band(double from, double to, std::string_view fill) const {
  const double begin = std::clamp(x_(from), area_.left, area_.right);
  const double end = std::clamp(x_(to), area_.left, area_.right);
  if (end > begin) canvas_.rectangle({begin, area_.top}, end - begin, area_.bottom - area_.top, {.fill = fill});
}

void Plot::curve(std::span<const double> x, std::span<const double> values, const Style& style, Side side) const {
  std::vector<Point> points;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (x[i] >= below_.ticks.lo && x[i] <= below_.ticks.hi) points.push_back(at(x[i], values[i], side));
  }
  canvas_.polyline(thinned(cut(std::move(points), area_.top, area_.bottom), look_.cell), style);
}

void Plot::level(double value, const Style& style, Side side) const {
  canvas_.line({area_.left, at(0, value, side).y}, {area_.right, at(0, value, side).y}, style);
}

void Plot::moment(double x, const Style& style) const { canvas_.line({x_(x), area_.top}, {x_(x), area_.bottom}, style); }

void draw_colours(Canvas& canvas, const PlotArea& area, std::span<const std::string> colours, Axis right,
                  const PlotLook& look) {
  // Each colour extends to the lower end and is covered by the next one. Otherwise thin lines would be visible between them.
  for (std::size_t k = colours.size(); k-- > 0;) {
    const double height = (area.bottom - area.top) * static_cast<double>(k + 1) / static_cast<double>(colours.size());
    canvas.rectangle({area.left, area.bottom - height}, area.right - area.left, height, {.fill = colours[k]});
  }
  right.lines = TickLines::outside;
  Plot bar(canvas, area, {}, {}, look);
  bar.right_axis(std::move(right));
  bar.draw_axes();
}

double widest_text(const Ticks& ticks, double size, double (*width)(std::string_view, double)) {
  double widest = 0;
  for (const Tick& tick : ticks.marks) widest = std::max(widest, width(tick.text, size));
  return widest;
}

std::vector<Point> thinned(const std::vector<Point>& points, double cell) {
  if (points.size() < 4) return points;
  if (static_cast<double>(points.size()) <= 2 * (points.back().x - points.front().x) / cell) return points;
  std::vector<Point> kept;
  for (std::size_t first = 0; first < points.size();) {
    const double pixel = std::floor(points[first].x / cell);
    std::size_t low = first;
    std::size_t high = first;
    std::size_t next = first;
    // A point that is not finite ends its pixel and is kept, which breaks the line there.
    for (; next < points.size() && std::floor(points[next].x / cell) == pixel && std::isfinite(points[next].y); ++next) {
      if (points[next].y < points[low].y) low = next;
      if (points[next].y > points[high].y) high = next;
    }
    kept.push_back(points[std::min(low, high)]);
    if (low != high) kept.push_back(points[std::max(low, high)]);
    first = std::max(next, first + 1);
  }
  return kept;
}

}  // namespace gaitlab::report
