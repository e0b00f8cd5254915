// One panel of a figure: values over time in a frame.
#pragma once
#include <limits>
#include <span>

#include "report/plot/axes.h"

namespace gaitlab::report {

/// The range of what is drawn; values that are not finite do not count.
struct Bounds {
  double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();
  void add(double value);
  void add(std::span<const double> values);
  [[nodiscard]] bool empty() const { return lo > hi; }
  /// About `count` ticks; of nothing, 0 to 1.
  [[nodiscard]] Ticks ticks(int count) const;
};

struct PlotArea {
  double left = 0, right = 0, top = 0, bottom = 0;  ///< px
};

/// For the screen as it is; `kPrint`: one size of text, real minus signs, curves cut at the frame, and finer ones.
struct PanelLook {
  double tick_size = 11;   ///< px, of the labels at the sides
  bool minus = false;      ///< U+2212 instead of a hyphen
  bool cut = false;        ///< curves end at the frame, also above and below
  double cell = 1;         ///< px: of each, a curve keeps two points
  Style grid = kGridLine;  ///< lines at the ticks
  Style zero = kGridLine;  ///< the one at zero
};
inline constexpr PanelLook kPrint{.tick_size = 13,
                                  .minus = true,
                                  .cut = true,
                                  .cell = 0.25,
                                  .grid = {.stroke = colour::kPale, .width = 0.8},
                                  .zero = {.stroke = colour::kGrey, .width = 0.8}};

enum class Side { left, right };

/// Grid, tick labels at the left and frame are drawn when it is made; curves over them.
class Panel {
 public:
  Panel(Canvas& canvas, const PlotArea& area, const Ticks& time, const Ticks& values, const PanelLook& look = {});
  /// Ticks and labels at the right, for curves of that side.
  void right_axis(const Ticks& values);
  /// `values` as long as `time`; not finite: a gap. What lies outside the time axis is left out.
  void curve(std::span<const double> time, std::span<const double> values, const Style& style, Side side = Side::left);
  /// Where it is on paper, px.
  [[nodiscard]] Point at(double x, double value, Side side = Side::left) const;
  void level(double value, const Style& style);
  void moment(double time, const Style& style);
  /// Labels below, and "time (s)".
  void time_axis() { axis_below("time (s)"); }
  void axis_below(std::string_view title);
  /// A title at a side, to be read from the right; its baseline is so far from the frame (px).
  void side_title(std::string_view title, Side side, double away);

 private:
  [[nodiscard]] std::string label(const Ticks& ticks, double value) const;

  Canvas& canvas_;
  PlotArea area_;
  Ticks time_;
  Scale x_, y_, right_;
  PanelLook look_;
};

/// Labels and a title below an area.
void draw_axis_below(Canvas& canvas, const PlotArea& area, const Ticks& ticks, std::string_view title, bool minus);

/// A number as it is printed: with a real minus sign.
std::string with_minus(std::string text);

}  // namespace gaitlab::report
