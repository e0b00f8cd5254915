// Common parts of the figures of studies: the sheet, its title and note, colours of values, marks of points.
#pragma once
#include <string>
#include <string_view>

#include "report/plot/plot.h"

namespace gaitlab::report {

inline constexpr double kSheetWidth = 760, kSheetTop = 64;  ///< px
inline constexpr double kMark = 5;                          ///< px, radius of a point
inline constexpr std::size_t kMostMarks = 20000;            ///< per figure
inline constexpr Style kBestMark{.stroke = colour::kBlack, .width = 2.4};
inline constexpr Style kHatchLine{.stroke = colour::kInk, .width = 0.8};

/// Bins of a histogram: equal parts of [lo, hi].
struct Bins {
  double lo = 0, hi = 1;
  std::size_t count = 1;
  /// The bin that contains a value; values outside are in the outermost bins.
  [[nodiscard]] std::size_t of(double value) const;
  /// Place at a share of a bin: 0 its lower edge, 1 its upper one.
  [[nodiscard]] double at(std::size_t bin, double share) const;
};

/// A number of a CSV file; empty: not finite.
std::string csv_cell(double value);

/// A name without its middle part if it is too long for the sheet.
std::string shortened(const std::string& name);

/// Draws the title: long ones are made smaller, and then cut.
void draw_sheet_title(Canvas& canvas, const std::string& title);
/// Draws a note, small and grey, in the necessary number of lines; the last at `y` (px).
void draw_sheet_note(Canvas& canvas, const std::string& note, double y);

/// `#RRGGBB` from pale (0) to dark blue (1), steadily darker, so that it is readable in grey also.
std::string shade(double share);

/// Draws the scale of shades right of an area, with ticks and a title; without bounds nothing.
void draw_shades(Canvas& canvas, const PlotArea& area, const Bounds& bounds, const std::string& title);

/// Mark of a failed point.
void draw_cross(Canvas& canvas, Point centre, double half);
/// Mark of the best point.
void draw_ring(Canvas& canvas, Point centre);

}  // namespace gaitlab::report
