// Common parts of the figures of studies: the sheet, its title and note, colours of values, marks of points.
#pragma once
#include <string>
#include <string_view>

#include "report/plot/plot.h"

namespace gaitlab::report {

inline constexpr double kSheetWidth = 760, kSheetTop = 64;  ///< px
inline constexpr double kMark = 5;                          ///< px, radius of a point
inline constexpr std::size_t kMostMarks = 20000;            ///< largest number of marks in a figure
inline constexpr Style kBestMark{.stroke = colour::kBlack, .width = 2.4};
inline constexpr Style kHatchLine{.stroke = colour::kInk, .width = 0.8};

/// Bins of a histogram, which are equal parts of [lo, hi].
struct Bins {
  double lo = 0, hi = 1;
  std::size_t count = 1;
  /// Index of the bin that contains a value. Values outside [lo, hi] belong to the first or last bin.
  [[nodiscard]] std::size_t of(double value) const;
  /// Position within a bin: its lower edge for share 0, its upper edge for share 1.
  [[nodiscard]] double at(std::size_t bin, double share) const;
};

/// Number as a cell of a CSV file; empty if it is not finite.
std::string csv_cell(double value);

/// The name, without its middle part if it is too long for the sheet.
std::string shortened(const std::string& name);

/// Draws the title. A long title is made smaller, and cut if it is still too long.
void draw_sheet_title(Canvas& canvas, const std::string& title);
/// Draws a note in small grey text, with line breaks as needed. The last baseline is at `y` (px).
void draw_sheet_note(Canvas& canvas, const std::string& note, double y);

/// Colour `#RRGGBB` of a share, from pale (0) to dark blue (1). It darkens steadily, so that it is also readable in grey.
std::string shade(double share);

/// Range of an axis of values: the range of the kept points, extended towards `all` by at most a quarter of its size. `all` if
/// the kept points have one value or none. Points that exploit the simulation would compress the others.
Bounds shown_range(const Bounds& kept, const Bounds& all);

/// Draws the colour scale right of an area, with ticks and a title. If values of `all` are beyond `bounds`, an arrow at that
/// end has the last colour, and a text states the farthest value. Draws nothing if the bounds are empty.
void draw_shades(Canvas& canvas, const PlotArea& area, const Bounds& bounds, const Bounds& all, const std::string& title);

/// Draws the mark of a failed point.
void draw_cross(Canvas& canvas, Point centre, double half);
/// Draws an arrow whose tip is at an edge of a plot, for a point beyond the edge.
/// `half` is half its width, px.
void draw_arrow(Canvas& canvas, Point tip, bool upwards, const Style& style, double half = kMark);
/// Draws the mark of the best point.
void draw_ring(Canvas& canvas, Point centre);

}  // namespace gaitlab::report
