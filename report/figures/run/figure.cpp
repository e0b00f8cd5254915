#include "report/figures/run/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/recording/motor_limit.h"
#include "report/figures/run/run_sheet.h"
#include "report/figures/run/views.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr double kChartHead = 36, kChartHeight = 260, kChartFoot = 58;  // px; the legend is in the head
// Share of the torque at rest above which a curve comes near it.
constexpr double kNear = 0.8;

constexpr Style kAngle{.stroke = colour::kBlue, .width = 2};
constexpr Style kSetpoint{.stroke = colour::kBlack, .width = 1.1, .dash = "2 3"};
constexpr Style kTorque{.stroke = colour::kVermillion, .width = 1.6, .dash = "8 3"};
constexpr Style kRestTorque{.stroke = colour::kVermillion, .width = 1, .dash = "10 3 2 3"};

constexpr Style kChange{.stroke = colour::kBlack, .width = 1, .dash = "1 3"};

struct LimitLook {
  MotorLimit limit;
  std::string_view fill;
  const char* name;
};
constexpr std::array<LimitLook, 2> kLimits{
    {{MotorLimit::voltage, "#E3E3E3", "voltage limit"}, {MotorLimit::current, "#F3D3BD", "current limit"}}};

// Index of the first sample that is shown. `time` must not be empty.
std::size_t first_shown(const std::vector<double>& time) {
  std::size_t first = 0;
  while (time[first] < time.back() - kShownSeconds - 1e-9) ++first;
  return first;
}

Ticks shown_time(const std::vector<double>& time) { return ticks_within(time[first_shown(time)], time.back(), 8); }

/// Chart of one joint over time, with angle and set point on the left axis and torque on the right axis.
class JointChart {
 public:
  JointChart(const FigureInput& input, const JointPanel& panel) : time_(input.time), panel_(panel) {
    add("angle", panel.angle, kAngle, Side::left);
    add("set point", panel.setpoint, kSetpoint, Side::left);
    add("torque (right)", panel.torque, kTorque, Side::right);
    if (curves_.empty()) return;
    first_ = first_shown(time_);
    for (const Curve& curve : curves_)
      (curve.side == Side::left ? angles_ : torques_).add(std::span(*curve.values).subspan(first_));
  }
  [[nodiscard]] bool empty() const { return curves_.empty(); }

  void draw(Canvas& canvas, const PlotArea& area) const {
    const bool angles = has(Side::left);
    const TwinTicks twin = ticks();
    Plot plot(canvas, area, {.ticks = shown_time(time_), .title = time_title()},
              angles ? Axis{.ticks = twin.a, .title = "angle (rad)", .away = 54, .fill = colour::kBlue} : Axis{}, {.text = 13});
    if (has(Side::right)) {
      plot.right_axis({.ticks = twin.b,
                       .title = "torque (N m)",
                       .lines = angles ? TickLines::outside : TickLines::grid,
                       .fill = colour::kVermillion});
    }
    shade_limits(plot);
    plot.draw_axes();
    for (const double change : panel_.changes) {
      if (change >= time_[first_]) plot.moment(change, kChange);
    }
    for (const Side side : {Side::right, Side::left}) {
      for (const Curve& curve : curves_) {
        if (curve.side == side) plot.curve(time_, *curve.values, curve.style, side);
      }
    }
    draw_rest_torques(canvas, plot, area);
    if (has(Side::right) && panel_.peak > 0) mark_peak(canvas, plot, area);
    draw_head(canvas, area);
  }

 private:
  struct Curve {
    const char* name;
    const std::vector<double>* values;
    Style style;
    Side side;
  };

  void add(const char* name, const std::vector<double>& values, const Style& style, Side side) {
    if (!values.empty() && values.size() == time_.size()) curves_.push_back({name, &values, style, side});
  }

  [[nodiscard]] bool has(Side side) const {
    return std::ranges::any_of(curves_, [side](const Curve& curve) { return curve.side == side; });
  }

  [[nodiscard]] TwinTicks ticks() const {
    Bounds a = angles_;
    if (!a.empty() && panel_.least_angle > 0) {
      a.add(-panel_.least_angle);
      a.add(panel_.least_angle);
    }
    Bounds b = torques_;
    b.add(rest_torques());
    const bool both = has(Side::left) && has(Side::right);
    TwinTicks twin =
        both ? twin_ticks(a.lo, a.hi, b.lo, b.hi) : TwinTicks{ticks_around(a.lo, a.hi, 6), ticks_around(b.lo, b.hi, 6)};
    make_room(twin, angles_, torques_);
    return twin;
  }

  [[nodiscard]] std::string time_title() const {
    if (first_ == 0) return "time (s)";
    return fmt::format("time (s), the last {:.3g} of {:.4g}", time_.back() - time_[first_], time_.back());
  }

  /// Torques at rest of the motor, with each sign for which the curve comes near.
  [[nodiscard]] std::vector<double> rest_torques() const {
    std::vector<double> near;
    const double most = panel_.rest_torque;
    if (most > 0 && torques_.hi > kNear * most) near.push_back(most);
    if (most > 0 && torques_.lo < -kNear * most) near.push_back(-most);
    return near;
  }

  [[nodiscard]] bool reaches(MotorLimit limit) const {
    if (panel_.limit.size() != time_.size()) return false;
    const auto shown = std::span(panel_.limit).subspan(first_);
    return std::ranges::find(shown, saturation_of(limit)) != shown.end();
  }

  /// Shades the time at a limit. An interval extends from its first row to the row after its last.
  void shade_limits(const Plot& plot) const {
    if (panel_.limit.size() != time_.size()) return;
    for (std::size_t i = first_; i < panel_.limit.size();) {
      std::size_t next = i + 1;
      while (next < panel_.limit.size() && panel_.limit[next] == panel_.limit[i]) ++next;
      for (const LimitLook& look : kLimits) {
        if (panel_.limit[i] == saturation_of(look.limit))
          plot.band(time_[i], time_[std::min(next, time_.size() - 1)], look.fill);
      }
      i = next;
    }
  }

  // Marks the largest torque. Its height is from all steps, whereas the curve is from rows; the mark is at the nearest row.
  void mark_peak(Canvas& canvas, const Plot& plot, const PlotArea& area) const {
    const std::vector<double>& torque = panel_.torque;
    std::size_t row = first_;
    while (row + 1 < torque.size() && time_[row] < panel_.peak_time - 1e-9) ++row;
    const bool shown = panel_.peak_time >= time_[first_] && std::isfinite(torque[row]);
    if (shown) {
      Point at = plot.at(panel_.peak_time, std::copysign(panel_.peak, torque[row]), Side::right);
      at.y = std::clamp(at.y, area.top, area.bottom);
      canvas.circle(at, 3.5, {.stroke = colour::kWhite, .fill = colour::kVermillion, .width = 1});
    }
    canvas.text({area.right, area.bottom + kTitleBelow},
                fmt::format("peak {:.3g} N m at {:.2f} s{}", panel_.peak, panel_.peak_time, shown ? "" : ", not shown"),
                {.anchor = Anchor::end, .fill = colour::kVermillion});
  }

  void draw_rest_torques(Canvas& canvas, const Plot& plot, const PlotArea& area) const {
    const std::vector<double> near = rest_torques();
    for (const double limit : near) plot.level(limit, kRestTorque, Side::right);
    if (near.empty()) return;
    const double y = area.bottom + kTitleBelow;
    canvas.line({area.left, y - 4.5}, {area.left + 34, y - 4.5}, kRestTorque);
    canvas.text({area.left + 42, y}, fmt::format("torque of the motor at rest, {:.3g} N m", panel_.rest_torque),
                {.fill = colour::kVermillion});
  }

  // Draws one row of text above the frame: the joint's name at the left, the legend at the right.
  void draw_head(Canvas& canvas, const PlotArea& area) const {
    std::vector<LegendEntry> entries;
    for (const LimitLook& look : kLimits) {
      if (reaches(look.limit)) entries.push_back(box_entry(look.name, {.fill = look.fill}));
    }
    for (const Curve& curve : curves_) entries.push_back(line_entry(curve.name, curve.style, 34));
    const double y = area.top - 13;
    const double room = draw_legend_row(canvas, entries, area.right, y) - 20 - area.left;
    const std::string name = "joint " + panel_.joint;
    canvas.text({area.left, y}, name, {.size = fitting_size(name, 13, 8, room), .bold = true});
  }

  const std::vector<double>& time_;
  const JointPanel& panel_;
  std::vector<Curve> curves_;
  std::size_t first_ = 0;
  Bounds angles_, torques_;
};

}  // namespace

std::string figure_svg(const FigureInput& input) {
  std::vector<JointChart> charts;
  for (const JointPanel& panel : input.joints) {
    if (JointChart chart(input, panel); !chart.empty()) charts.push_back(std::move(chart));
  }
  constexpr double kChart = kChartHead + kChartHeight + kChartFoot;
  const bool footfalls = !input.footfalls.empty() && !input.time.empty();
  const double footfall_top = kTitleHeight + kChart * static_cast<double>(charts.size());
  const Edges edges{left_edge(input), kRight};
  const double views_top = footfall_top + (footfalls ? footfall_height(input.footfalls.size()) : 0);
  Svg svg(kWidth, views_top + (input.views.empty() ? 0 : views_height(input, edges) + 8), input.title);
  draw_run_title(svg, input.title);
  double top = kTitleHeight + kChartHead;
  for (const JointChart& chart : charts) {
    chart.draw(svg, {edges.left, edges.right, top, top + kChartHeight});
    top += kChart;
  }
  if (footfalls) {
    const double first = footfall_top + kFootfallHead;
    const double bottom = footfall_top + footfall_height(input.footfalls.size()) - kFootfallFoot;
    draw_footfalls(svg, {input.footfalls, "footfall", input.footfall_note}, {.ticks = shown_time(input.time), .texts = false},
                   {edges.left, edges.right, first, bottom});
  }
  if (!input.views.empty()) draw_views(svg, input, edges, views_top);
  return svg.finish();
}

}  // namespace gaitlab::report
