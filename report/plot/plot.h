// A plot, which is a frame with axes and curves in a rectangle of a canvas.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/plot/canvas.h"
#include "report/plot/ticks.h"

namespace gaitlab::report {

inline constexpr Style kAxisLine{.stroke = colour::kInk, .width = 1.2};

struct PlotArea {
  double left = 0, right = 0, top = 0, bottom = 0;  ///< px
};

/// Linear map from the interval [lo, hi] to [from, to], px.
struct Scale {
  double lo = 0, hi = 1, from = 0, to = 1;
  [[nodiscard]] double operator()(double value) const { return from + (value - lo) / (hi - lo) * (to - from); }
};

/// Lines at the ticks: across the frame, or 4 px long outside it.
enum class TickLines { grid, outside, none };

struct Axis {
  Ticks ticks = {};
  std::string title = {};  ///< empty if there is none; at a side of the frame it is to be read from the right
  TickLines lines = TickLines::grid;
  bool texts = true;                     ///< true: numbers or words are printed at the ticks
  double away = 62;                      ///< px, from the frame to the baseline of a title at a side
  std::string_view fill = colour::kInk;  ///< colour of the tick texts and the title
};

/// Sizes of a plot. The defaults are for the screen. `kPrint` has one text size, and finer lines and curves.
struct PlotLook {
  double text = 11;   ///< px, of the texts at the ticks
  double grid = 1;    ///< px, width of grid lines
  double cell = 1;    ///< px; a curve keeps at most two points per cell of this width
  bool frame = true;  ///< true: the whole frame is drawn; false: only its lower edge
};
inline constexpr PlotLook kPrint{.text = 13, .grid = 0.8, .cell = 0.25};

inline constexpr double kTitleBelow = 36;  ///< px, from a frame to the baseline of the title below the frame

enum class Side { left, right };

/// A plot. The order of calls is areas below the grid, `draw_axes`, then curves above the grid.
class Plot {
 public:
  /// The canvas must outlive the plot.
  Plot(Canvas& canvas, const PlotArea& area, Axis below, Axis left, const PlotLook& look = {});
  /// Adds an axis at the right, for curves with Side::right.
  void right_axis(Axis right);
  void draw_axes() const;

  /// Point on the sheet, px.
  [[nodiscard]] Point at(double x, double value, Side side = Side::left) const;
  /// Fills the interval [from, to] of x over the whole height of the frame. Parts outside the frame are left out.
  void band(double from, double to, std::string_view fill) const;
  /// Draws a curve. `values` has the length of `x`. Values that are not finite leave a gap, and parts outside the frame are
  /// left out.
  void curve(std::span<const double> x, std::span<const double> values, const Style& style, Side side = Side::left) const;
  void level(double value, const Style& style, Side side = Side::left) const;
  void moment(double x, const Style& style) const;

 private:
  enum class Edge { below, left, right };
  void draw_ticks(const Axis& axis, Edge edge) const;
  void draw_title(const Axis& axis, Edge edge) const;

  Canvas& canvas_;
  PlotArea area_;
  Axis below_, left_;
  std::optional<Axis> right_;
  PlotLook look_;
  Scale x_, y_, right_y_;
};

/// Draws a colour bar, with the first colour at the bottom and an axis at its right.
void draw_colours(Canvas& canvas, const PlotArea& area, std::span<const std::string> colours, Axis right,
                  const PlotLook& look = {});

/// Width of the widest tick text, px.
double widest_text(const Ticks& ticks, double size, double (*width)(std::string_view, double) = text_width);

/// Keeps at most two points per `cell` of width (px), the lowest and the highest, in their original order, so that peaks remain
/// visible. `points` are in px with rising x.
std::vector<Point> thinned(const std::vector<Point>& points, double cell = 1);

}  // namespace gaitlab::report
