#include "report/figures/run/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/recording/motor_limit.h"
#include "report/figures/run/views.h"
#include "report/plot/panel.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr double kChartTop = 36, kChartHeight = 260, kChartFoot = 58;  // below the legend; px
constexpr double kWindow = 8;                                          // s

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

constexpr Style kRestTorque{.stroke = colour::kVermillion, .width = 1, .dash = "10 3 2 3"};
constexpr double kNear = 0.8;  // of the torque at rest

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
      for (const double value : right_ticks.values())
        svg_.line({kRight, right_y(value)}, {kRight + 4, right_y(value)}, kAxisLine);
      labels(right_ticks, right_y, kRight + 8, Anchor::start, colour::kVermillion);
      svg_.text({kRight + 62, (top_ + bottom_) / 2}, "torque (N m)",
                {.anchor = Anchor::middle, .fill = colour::kVermillion, .upwards = true});
    }
    for (const Curve& curve : right) svg_.polyline(points(curve, right_y), curve.style);
    for (const Curve& curve : left) svg_.polyline(points(curve, left_y), curve.style);
    draw_rest_torques(bounds(right), right_y);
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
    Bounds b = bounds(right);
    for (const double limit : rest_torques(b)) b.add(limit);
    if (left.empty() || right.empty()) return {ticks_around(a.lo, a.hi, 6), ticks_around(b.lo, b.hi, 6)};
    return twin_ticks(a.lo, a.hi, b.lo, b.hi);
  }

  /// The motor's torque at rest, of each sign with which the curve comes near it.
  [[nodiscard]] std::vector<double> rest_torques(const Bounds& torque) const {
    std::vector<double> near;
    const double most = panel_.rest_torque;
    if (most > 0 && torque.hi > kNear * most) near.push_back(most);
    if (most > 0 && torque.lo < -kNear * most) near.push_back(-most);
    return near;
  }

  [[nodiscard]] bool limited() const {
    if (panel_.limit.size() != input_.time.size()) return false;
    return std::any_of(panel_.limit.begin() + static_cast<std::ptrdiff_t>(first_), panel_.limit.end(),
                       [](double l) { return l != 0; });
  }

  struct Limit {
    MotorLimit limit;
    std::string_view fill;
    const char* name;
  };
  static constexpr std::array<Limit, 2> kLimits{
      {{MotorLimit::voltage, "#E3E3E3", "voltage limit"}, {MotorLimit::current, "#F3D3BD", "current limit"}}};

  /// A span lasts from its first row to the row after its last.
  void shade_limits() {
    if (!limited()) return;
    for (std::size_t i = first_; i < panel_.limit.size();) {
      std::size_t next = i + 1;
      while (next < panel_.limit.size() && panel_.limit[next] == panel_.limit[i]) ++next;
      for (const Limit& limit : kLimits) {
        if (panel_.limit[i] != saturation_of(limit.limit)) continue;
        const double from = x_(input_.time[i]);
        const double to = x_(input_.time[std::min(next, panel_.limit.size() - 1)]);
        svg_.rectangle({from, top_}, std::max(to - from, 0.5), bottom_ - top_, {.fill = limit.fill});
      }
      i = next;
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

  void draw_rest_torques(const Bounds& torque, const Scale& y) {
    const std::vector<double> near = rest_torques(torque);
    for (const double limit : near) svg_.line({left_, y(limit)}, {kRight, y(limit)}, kRestTorque);
    if (near.empty()) return;
    svg_.line({left_, bottom_ + 33.5}, {left_ + 34, bottom_ + 33.5}, kRestTorque);
    svg_.text({left_ + 42, bottom_ + 38}, fmt::format("torque of the motor at rest, {:.3g} N m", panel_.rest_torque),
              {.fill = colour::kVermillion});
  }

  void time_axis() {
    for (const double t : time_.values()) {
      svg_.line({x_(t), top_}, {x_(t), bottom_}, kGridLine);
      svg_.text({x_(t), bottom_ + 18}, time_.label(t), {.anchor = Anchor::middle});
    }
    const double shown = input_.time.back() - input_.time[first_];
    svg_.text({(left_ + kRight) / 2, bottom_ + 38},
              first_ > 0 ? fmt::format("time (s), the last {:.3g} of {:.4g}", shown, input_.time.back()) : "time (s)",
              {.anchor = Anchor::middle});
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
    for (const Limit& limit : kLimits) {
      if (!limited() || std::find(panel_.limit.begin() + static_cast<std::ptrdiff_t>(first_), panel_.limit.end(),
                                  saturation_of(limit.limit)) == panel_.limit.end())
        continue;
      x -= text_width(limit.name, 13);
      svg_.text({x, y}, limit.name);
      svg_.rectangle({x - 20, y - 10}, 12, 12, {.fill = limit.fill});
      x -= 36;
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
  const bool footfalls = !input.footfalls.empty() && !input.time.empty();
  const double footfall_top = kTitleHeight + kChart * static_cast<double>(charts.size());
  const Edges edges{left_edge(input), kRight};
  const double views_top = footfall_top + (footfalls ? footfall_height(input.footfalls.size()) : 0);
  Svg svg(kWidth, views_top + (input.views.empty() ? 0 : views_height(input, edges) + 8));
  title(svg, input.title);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const double top = kTitleHeight + kChart * static_cast<double>(i) + kChartTop;
    Chart(svg, input, *charts[i].panel, top).draw(charts[i].left, charts[i].right);
  }
  if (footfalls) {
    const Ticks time = shown_time(input.time);
    draw_footfalls(svg, {input.footfalls, "footfall", input.footfall_note}, time, {time.lo, time.hi, kLeftOfNames, kRight},
                   footfall_top);
  }
  if (!input.views.empty()) draw_views(svg, input, edges, views_top);
  return svg.finish();
}

}  // namespace gaitlab::report
