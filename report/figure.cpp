#include "report/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "report/panel.h"

namespace gaitlab::report {

namespace {

constexpr double kLeft = 80, kRight = 920;                             // px, of all panels
constexpr double kLeftOfNames = 120;                                   // px, where legs have their names at the left
constexpr double kChartTop = 36, kChartHeight = 260, kChartFoot = 58;  // below the legend; px
constexpr double kViewMost = 150;                                      // px, the tallest robot
constexpr double kViewGap = 40;  // px, between one view's ground and the next one's headroom
constexpr double kWindow = 8;    // s

double left_edge(const FigureInput& input) { return input.footfalls.empty() ? kLeft : kLeftOfNames; }

// First of the samples that are shown; `time` is not empty.
std::size_t first_shown(const std::vector<double>& time) {
  std::size_t first = 0;
  while (time[first] < time.back() - kWindow - 1e-9) ++first;
  return first;
}

Ticks shown_time(const std::vector<double>& time) { return ticks_within(time[first_shown(time)], time.back(), 8); }

constexpr Style kZeroLine{.stroke = colour::kGrey};
constexpr Style kAngle{.stroke = colour::kBlue, .width = 2};
constexpr Style kSetpoint{.stroke = colour::kBlack, .width = 1.1, .dash = "2 3"};
constexpr Style kTorque{.stroke = colour::kVermillion, .width = 1.6, .dash = "8 3"};

// ---- upper panel: one joint over time

struct Curve {
  std::string name;
  const std::vector<double>* values;
  Style style;
};

class Chart {
 public:
  Chart(Svg& svg, const FigureInput& input, const JointPanel& panel, double top)
      : svg_(svg),
        input_(input),
        panel_(panel),
        left_(left_edge(input)),
        top_(top),
        bottom_(top + kChartHeight),
        first_(first_shown(input.time)),
        time_(shown_time(input.time)),
        x_{time_.lo, time_.hi, left_, kRight} {}

  void draw(const std::vector<Curve>& left, const std::vector<Curve>& right) {
    const auto [left_ticks, right_ticks] = ticks(left, right);
    const Scale left_y{left_ticks.lo, left_ticks.hi, bottom_, top_};
    const Scale right_y{right_ticks.lo, right_ticks.hi, bottom_, top_};
    shade_limits();
    time_axis();
    if (!left.empty()) {
      grid(left_ticks, left_y);
      labels(left_ticks, left_y, left_ - 8, Anchor::end, colour::kBlue);
      svg_.text({left_ - 54, (top_ + bottom_) / 2}, "angle (rad)",
                {.anchor = Anchor::middle, .fill = colour::kBlue, .upwards = true});
    }
    if (!right.empty()) {
      if (left.empty()) grid(right_ticks, right_y);
      labels(right_ticks, right_y, kRight + 8, Anchor::start, colour::kVermillion);
      svg_.text({kRight + 62, (top_ + bottom_) / 2}, "torque (N m)",
                {.anchor = Anchor::middle, .fill = colour::kVermillion, .upwards = true});
    }
    for (const Curve& curve : right) svg_.polyline(points(curve, right_y), curve.style);
    for (const Curve& curve : left) svg_.polyline(points(curve, left_y), curve.style);
    if (!right.empty()) mark_peak(*right.front().values, right_y);
    svg_.rectangle({left_, top_}, kRight - left_, bottom_ - top_, kAxisLine);
    legend(left, right);
  }

 private:
  [[nodiscard]] Bounds bounds(const std::vector<Curve>& curves) const {
    Bounds bounds;
    for (const Curve& curve : curves) {
      for (std::size_t i = first_; i < curve.values->size(); ++i) bounds.add((*curve.values)[i]);
    }
    return bounds;
  }

  [[nodiscard]] TwinTicks ticks(const std::vector<Curve>& left, const std::vector<Curve>& right) const {
    Bounds a = bounds(left);
    const double least = a.empty() ? 0 : panel_.least_angle;
    if (least > 0) {
      a.add(-least);
      a.add(least);
    }
    const Bounds b = bounds(right);
    if (left.empty() || right.empty()) return {ticks_around(a.lo, a.hi, 6), ticks_around(b.lo, b.hi, 6)};
    return twin_ticks(a.lo, a.hi, b.lo, b.hi);
  }

  [[nodiscard]] bool limited() const {
    if (panel_.limit.size() != input_.time.size()) return false;
    return std::any_of(panel_.limit.begin() + static_cast<std::ptrdiff_t>(first_), panel_.limit.end(),
                       [](double l) { return l != 0; });
  }

  // A span lasts from its first row to the row after its last.
  void shade_limits() {
    if (!limited()) return;
    for (std::size_t i = first_; i < panel_.limit.size(); ++i) {
      if (panel_.limit[i] == 0) continue;
      const double from = x_(input_.time[i]);
      while (i < panel_.limit.size() && panel_.limit[i] != 0) ++i;
      const double to = x_(input_.time[std::min(i, panel_.limit.size() - 1)]);
      svg_.rectangle({from, top_}, std::max(to - from, 0.5), bottom_ - top_, {.fill = colour::kPale});
    }
  }

  // A peak is of all steps, the curve of rows: the mark is at the height of the peak, on the side of the nearest row.
  void mark_peak(const std::vector<double>& torque, const Scale& y) {
    if (!(panel_.peak > 0)) return;
    std::size_t row = first_;
    while (row + 1 < torque.size() && input_.time[row] < panel_.peak_time - 1e-9) ++row;
    const bool shown = panel_.peak_time >= input_.time[first_] && std::isfinite(torque[row]);
    const double height = std::copysign(panel_.peak, shown ? torque[row] : 1);
    if (shown) {
      const double at = std::clamp(y(height), top_, bottom_);
      svg_.circle({x_(panel_.peak_time), at}, 3.5, {.stroke = colour::kWhite, .fill = colour::kVermillion, .width = 1});
    }
    svg_.text({kRight, bottom_ + 38},
              fmt::format("peak {:.3g} N m at {:.2f} s{}", panel_.peak, panel_.peak_time, shown ? "" : ", not shown"),
              {.anchor = Anchor::end, .fill = colour::kVermillion});
  }

  void time_axis() {
    for (const double t : time_.values()) {
      svg_.line({x_(t), top_}, {x_(t), bottom_}, kGridLine);
      svg_.text({x_(t), bottom_ + 18}, time_.label(t), {.anchor = Anchor::middle});
    }
    svg_.text({(left_ + kRight) / 2, bottom_ + 38}, "time (s)", {.anchor = Anchor::middle});
  }

  void grid(const Ticks& ticks, const Scale& y) {
    for (const double value : ticks.values()) {
      const bool zero = std::abs(value) < 0.5 * ticks.step;
      svg_.line({left_, y(value)}, {kRight, y(value)}, zero ? kZeroLine : kGridLine);
    }
  }

  void labels(const Ticks& ticks, const Scale& y, double x, Anchor anchor, std::string_view fill) {
    for (const double value : ticks.values())
      svg_.text({x, y(value) + 4.5}, ticks.label(value), {.anchor = anchor, .fill = fill});
  }

  [[nodiscard]] std::vector<Point> points(const Curve& curve, const Scale& y) const {
    std::vector<Point> points;
    for (std::size_t i = first_; i < input_.time.size(); ++i) points.push_back({x_(input_.time[i]), y((*curve.values)[i])});
    return thinned(points);
  }

  // In one row above the panel: the joint's name at the left, the curves at the right.
  void legend(const std::vector<Curve>& left, const std::vector<Curve>& right) {
    const double y = top_ - 13;
    double x = kRight;
    for (const std::vector<Curve>* curves : {&right, &left}) {
      for (auto curve = curves->rbegin(); curve != curves->rend(); ++curve) {
        x -= text_width(curve->name, 13);
        svg_.text({x, y}, curve->name);
        svg_.line({x - 42, y - 4.5}, {x - 8, y - 4.5}, curve->style);
        x -= 62;
      }
    }
    if (limited()) {
      const char* const name = "at a limit";
      x -= text_width(name, 13);
      svg_.text({x, y}, name);
      svg_.rectangle({x - 20, y - 10}, 12, 12, {.fill = colour::kPale});
    }
    const std::string name = "joint " + panel_.joint;
    double size = 13;
    while (size > 8 && 1.1 * text_width(name, size) > x - left_) size -= 0.5;
    svg_.text({left_, y}, name, {.size = size, .bold = true});
  }

  Svg& svg_;
  const FigureInput& input_;
  const JointPanel& panel_;
  double left_, top_, bottom_;
  std::size_t first_;
  Ticks time_;
  Scale x_;
};

// ---- lower panel: side views

struct RoleLook {
  Role role;
  std::string_view fill, name;
};
constexpr std::array<RoleLook, 4> kLooks = {
    RoleLook{Role::active, colour::kSky, "active block"}, RoleLook{Role::link, colour::kGrey, "link"},
    RoleLook{Role::passive, colour::kOrange, "passive block"}, RoleLook{Role::other, colour::kPale, "body"}};

const RoleLook& look(Role role) {
  return *std::find_if(kLooks.begin(), kLooks.end(), [role](const RoleLook& look) { return look.role == role; });
}

struct Extent {
  Bounds x, z;
};

Extent extent(const View& view) {
  Extent extent;
  for (const Outline& outline : view.outlines) {
    for (const Polygon& polygon : outline.polygons) {
      for (const Point& point : polygon) {
        extent.x.add(point.x);
        extent.z.add(point.y);
      }
    }
  }
  return extent;
}

// The part of a polygon on one side of a vertical line: where sign * (x - at) >= 0.
Polygon beside(const Polygon& polygon, double at, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i];
    const Point b = polygon[(i + 1) % polygon.size()];
    const bool a_in = sign * (a.x - at) >= 0;
    if (a_in) kept.push_back(a);
    if (a_in != (sign * (b.x - at) >= 0)) kept.push_back({at, a.y + (b.y - a.y) * (at - a.x) / (b.x - a.x)});
  }
  return kept;
}

class Views {
 public:
  explicit Views(const FigureInput& input) : input_(input), left_(left_edge(input)) {
    Bounds x;
    for (const View& view : input.views) {
      const Extent seen = extent(view);
      x.add(seen.x.lo);
      x.add(seen.x.hi);
      floors_.push_back(input.ground || seen.z.empty() ? 0 : seen.z.lo);
      if (seen.z.empty()) continue;
      above_ = std::max(above_, seen.z.hi - floors_.back());
      below_ = std::max(below_, floors_.back() - seen.z.lo);
    }
    if (x.empty()) x = {-0.5, 0.5};
    const double width = std::max(1.06 * (x.hi - x.lo), 1e-3);
    per_metre_ = (kRight - left_) / width;
    if (above_ + below_ > 0) per_metre_ = std::min(per_metre_, kViewMost / (above_ + below_));
    const double half = 0.5 * (kRight - left_) / per_metre_;
    ticks_ = ticks_within(0.5 * (x.lo + x.hi) - half, 0.5 * (x.lo + x.hi) + half, 8);
    x_ = {ticks_.lo, ticks_.hi, left_, kRight};
  }

  [[nodiscard]] double height() const { return head() + pitch() * static_cast<double>(input_.views.size()) + kFoot; }

  void draw(Svg& svg, double top) const {
    const double bottom = top + height() - kFoot;
    header(svg, top);
    for (const double x : ticks_.values()) svg.line({x_(x), top + head()}, {x_(x), bottom}, kGridLine);
    std::vector<Point> centres;
    for (std::size_t i = 0; i < input_.views.size(); ++i) {
      const double floor = top + head() + pitch() * static_cast<double>(i + 1) - kViewGap / 2 - below_ * per_metre_;
      const Scale z{floors_[i], floors_[i] + 1, floor, floor - per_metre_};
      draw_view(svg, input_.views[i], z);
      if (input_.views[i].com) centres.push_back({x_(*input_.views[i].com), floor + below_ * per_metre_ + 8});
    }
    for (const Point& m : centres)
      svg.polygons(std::vector<Polygon>{{m, {m.x - 5, m.y + 8}, {m.x + 5, m.y + 8}}}, {.fill = colour::kInk});
    axis(svg, bottom);
  }

 private:
  static constexpr double kFoot = 48, kLegendRow = 22;  // px

  [[nodiscard]] double head() const { return 34 + (two_rows() ? kLegendRow : 0); }
  [[nodiscard]] double pitch() const { return std::max(30.0, (above_ + below_) * per_metre_) + kViewGap; }

  void draw_view(Svg& svg, const View& view, const Scale& z) const {
    const auto paper = [&](Point p) { return Point{x_(p.x), z(p.y)}; };
    if (input_.ground) {
      svg.rectangle({left_, z(0)}, kRight - left_, 5, {.fill = colour::kPale});
      svg.line({left_, z(0)}, {kRight, z(0)}, kAxisLine);
    }
    for (const Polygon& solid : input_.solids) {
      Polygon seen = beside(beside(solid, ticks_.lo, 1), ticks_.hi, -1);
      if (seen.size() < 3) continue;
      std::transform(seen.begin(), seen.end(), seen.begin(), paper);
      svg.polygons(std::vector<Polygon>{std::move(seen)}, {.stroke = colour::kGrey, .fill = colour::kPale, .width = 1});
    }
    for (const Outline& outline : view.outlines) {
      std::vector<Polygon> polygons = outline.polygons;
      for (Polygon& polygon : polygons) std::transform(polygon.begin(), polygon.end(), polygon.begin(), paper);
      svg.polygons(polygons, {.stroke = colour::kInk, .fill = look(outline.role).fill, .width = 1.8, .stroke_below = true});
    }
    for (const Point& contact : view.contacts)
      svg.circle(paper(contact), 2.6, {.stroke = colour::kWhite, .fill = colour::kVermillion, .width = 0.8});
    if (view.joint) arrow(svg, paper(*view.joint));
    svg.text({left_ - 10, z(z.lo) + 4}, fmt::format("{:.6g} s", view.time), {.anchor = Anchor::end, .bold = true});
  }

  static void arrow(Svg& svg, Point tip) {
    svg.line({tip.x, tip.y - 40}, {tip.x, tip.y - 10}, {.stroke = colour::kBlack, .width = 2});
    svg.polygons(std::vector<Polygon>{{tip, {tip.x - 5, tip.y - 11}, {tip.x + 5, tip.y - 11}}}, {.fill = colour::kBlack});
  }

  struct Entry {
    std::string_view name;
    double symbol, gap;  ///< px, before the name and before the symbol
    std::function<void(Svg&, Point)> draw;
  };

  /// From right to left.
  [[nodiscard]] std::vector<Entry> legend() const {
    std::vector<Entry> all;
    if (any([](const View& view) { return view.com.has_value(); })) {
      all.push_back({"centre of mass", 12, 26, [](Svg& svg, Point m) {
                       svg.polygons(std::vector<Polygon>{{{m.x, m.y - 4}, {m.x - 5, m.y + 4}, {m.x + 5, m.y + 4}}},
                                    {.fill = colour::kInk});
                     }});
    }
    if (any([](const View& view) { return !view.contacts.empty(); })) {
      all.push_back({"contact", 11, 24, [](Svg& svg, Point m) { svg.circle(m, 3, {.fill = colour::kVermillion}); }});
    }
    for (auto role = kLooks.rbegin(); role != kLooks.rend(); ++role) {
      if (!any([&](const View& view) { return shows(view, role->role); })) continue;
      all.push_back({role->name, 19, 20, [fill = role->fill](Svg& svg, Point corner) {
                       svg.rectangle({corner.x, corner.y - 6}, 12, 12, {.stroke = colour::kInk, .fill = fill});
                     }});
    }
    return all;
  }

  [[nodiscard]] std::string views_title() const {
    if (!input_.views_title.empty()) return input_.views_title;
    return any([](const View& view) { return view.joint.has_value(); }) ? "side view (arrow: joint above)" : "side view";
  }

  /// Whether the legend has no room beside the title.
  [[nodiscard]] bool two_rows() const {
    double width = text_width(views_title(), 13) * 1.1 + 20;  // bold
    for (const Entry& entry : legend()) width += text_width(entry.name, 13) + entry.symbol + entry.gap;
    return width > kRight - left_;
  }

  void header(Svg& svg, double top) const {
    svg.text({left_, top + 14}, views_title(), {.bold = true});
    double x = kRight;
    const double y = top + 14 + (two_rows() ? kLegendRow : 0);
    for (const Entry& entry : legend()) {
      x -= text_width(entry.name, 13);
      svg.text({x, y}, entry.name);
      x -= entry.symbol;
      entry.draw(svg, {x, y - 4.5});
      x -= entry.gap;
    }
  }

  void axis(Svg& svg, double bottom) const {
    svg.line({left_, bottom}, {kRight, bottom}, kAxisLine);
    for (const double x : ticks_.values()) {
      svg.line({x_(x), bottom}, {x_(x), bottom + 5}, kAxisLine);
      svg.text({x_(x), bottom + 20}, ticks_.label(x), {.anchor = Anchor::middle});
    }
    svg.text({(left_ + kRight) / 2, bottom + 40}, input_.views_axis, {.anchor = Anchor::middle});
  }

  static bool shows(const View& view, Role role) {
    return std::any_of(view.outlines.begin(), view.outlines.end(), [role](const Outline& o) { return o.role == role; });
  }
  template <class Test>
  [[nodiscard]] bool any(const Test& test) const {
    return std::any_of(input_.views.begin(), input_.views.end(), test);
  }

  const FigureInput& input_;
  double left_;
  std::vector<double> floors_ = {};  // height drawn on the base line of each view, m
  double above_ = 0, below_ = 0;     // of the base line, m
  double per_metre_ = 1;
  Ticks ticks_;
  Scale x_;
};

void title(Svg& svg, const std::string& text) {
  double size = 18;
  while (size > 10 && text_width(text, size) > kRight - kLeft) size -= 1;
  svg.text({kWidth / 2, 28}, text, {.size = size, .anchor = Anchor::middle, .bold = true});
}

}  // namespace

std::string figure_svg(const FigureInput& input) {
  struct Curves {
    const JointPanel* panel;
    std::vector<Curve> left, right;
  };
  std::vector<Curves> charts;
  for (const JointPanel& panel : input.joints) {
    Curves curves{&panel, {}, {}};
    const auto add = [&](std::vector<Curve>& to, const char* name, const std::vector<double>& values, const Style& style) {
      if (!values.empty() && values.size() == input.time.size()) to.push_back({name, &values, style});
    };
    add(curves.left, "angle", panel.angle, kAngle);
    add(curves.left, "set point", panel.setpoint, kSetpoint);
    add(curves.right, "torque (right)", panel.torque, kTorque);
    if (!curves.left.empty() || !curves.right.empty()) charts.push_back(std::move(curves));
  }
  constexpr double kChart = kChartTop + kChartHeight + kChartFoot;
  const Views views(input);
  const bool footfalls = !input.footfalls.empty() && !input.time.empty();
  const double footfall_top = kTitleHeight + kChart * static_cast<double>(charts.size());
  const double views_top = footfall_top + (footfalls ? footfall_height(input.footfalls.size()) : 0);
  Svg svg(kWidth, views_top + (input.views.empty() ? 0 : views.height() + 8));
  title(svg, input.title);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const double top = kTitleHeight + kChart * static_cast<double>(i) + kChartTop;
    Chart(svg, input, *charts[i].panel, top).draw(charts[i].left, charts[i].right);
  }
  if (footfalls) {
    const Ticks time = shown_time(input.time);
    draw_footfalls(svg, input.footfalls, input.footfall_note, time, {time.lo, time.hi, kLeftOfNames, kRight}, footfall_top);
  }
  if (!input.views.empty()) views.draw(svg, views_top);
  return svg.finish();
}

}  // namespace gaitlab::report
