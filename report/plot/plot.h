// A plot: a frame with axes and curves in a rectangle of a canvas.
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

/// Maps [lo, hi] to [from, to], px.
struct Scale {
  double lo = 0, hi = 1, from = 0, to = 1;
  [[nodiscard]] double operator()(double value) const { return from + (value - lo) / (hi - lo) * (to - from); }
};

/// Lines at the ticks: across the frame, or 4 px outside it.
enum class TickLines { grid, outside, none };

struct Axis {
  Ticks ticks = {};
  std::string title = {};  ///< at a side to be read from the right; empty: none
  TickLines lines = TickLines::grid;
  bool texts = true;                     ///< at the ticks
  double away = 62;                      ///< px, of a title at a side: from the frame to its baseline
  std::string_view fill = colour::kInk;  ///< of texts and title
};

/// For the screen as it is; `kPrint`: one size of text, and finer lines and curves.
struct PlotLook {
  double text = 11;   ///< px, of the texts at the ticks
  double grid = 1;    ///< px, width of grid lines
  double cell = 1;    ///< px: a curve keeps two points of each cell
  bool frame = true;  ///< otherwise only its lower edge
};
inline constexpr PlotLook kPrint{.text = 13, .grid = 0.8, .cell = 0.25};

inline constexpr double kTitleBelow = 36;  ///< px, from a frame to the baseline of the title below it

enum class Side { left, right };

/// A plot, in the order of drawing: areas below the grid, `draw_axes`, curves above it.
class Plot {
 public:
  /// The canvas must outlive the plot.
  Plot(Canvas& canvas, const PlotArea& area, Axis below, Axis left, const PlotLook& look = {});
  /// Adds an axis at the right, for curves of that side.
  void right_axis(Axis right);
  void draw_axes() const;

  /// Place on paper, px.
  [[nodiscard]] Point at(double x, double value, Side side = Side::left) const;
  /// Fills an interval of x, as far as it is in the frame, from top to bottom.
  void band(double from, double to, std::string_view fill) const;
  /// Draws a curve. `values` are as long as `x`; not finite: a gap. It ends at the frame.
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

/// Draws a bar of colours, from the lowest up, with an axis at its right.
void draw_colours(Canvas& canvas, const PlotArea& area, std::span<const std::string> colours, Axis right,
                  const PlotLook& look = {});

/// Width of the widest text, px.
double widest_text(const Ticks& ticks, double size, double (*width)(std::string_view, double) = text_width);

/// At most two points per `cell` of width (px): the lowest and highest of each, in their order, so that peaks survive. `points`
/// in px, by rising x.
std::vector<Point> thinned(const std::vector<Point>& points, double cell = 1);

}  // namespace gaitlab::report
