// What the figures of studies share: the sheet, its title and note, colours of values, marks of points.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/plot/canvas.h"
#include "report/plot/panel.h"

namespace gaitlab::report {

inline constexpr double kSheetWidth = 760, kSheetTop = 64;  ///< px
inline constexpr double kMark = 5;                          ///< px, radius of a point
inline constexpr std::size_t kMostMarks = 20000;            ///< of a figure
inline constexpr Style kBestMark{.stroke = colour::kBlack, .width = 2.4};
inline constexpr Style kHatchLine{.stroke = colour::kInk, .width = 0.8};

/// An axis: from `lo` to `hi`, of a logarithmic one their logarithms to base 10; and what is written at it, where.
struct AxisMarks {
  double lo = 0, hi = 1;
  std::vector<std::pair<double, std::string>> labels;
};
/// About `count` labels of round numbers within the bounds, which are widened by a share of them; of a logarithmic axis 1, 2,
/// 5, 10
/// ..., over many decades 1, 10 ... One value alone stands in the middle.
AxisMarks axis_marks(const Bounds& bounds, bool log, int count, double wider = 0);
/// Frame, labels and, where wanted, lines across.
struct FrameLook {
  bool grid = true, left_labels = true, below_labels = true;
};
void draw_frame(Canvas& canvas, const PlotArea& area, const AxisMarks& x, const AxisMarks& y, const FrameLook& look = {});

/// 10^exponent.
double power_of_ten(double exponent);
double log10_of(double value);

/// A name that would take too much of the sheet, with its middle left out.
std::string shortened(const std::string& name);

/// Long ones are made smaller, and then cut.
void draw_sheet_title(Canvas& canvas, const std::string& title);
/// Small and grey, in as many lines as it takes; the last at `y` (px).
void draw_sheet_note(Canvas& canvas, const std::string& note, double y);

/// `#RRGGBB` from pale (0) to dark blue (1), ever darker, so that it is read in grey, too.
std::string shade(double share);

/// The scale of shades right of an area, with ticks and a title. lo = hi: one value; lo > hi: none.
void draw_shades(Canvas& canvas, const PlotArea& area, double lo, double hi, std::string_view title);

/// Of a failed point.
void draw_cross(Canvas& canvas, Point centre, double half);
/// Of the best.
void draw_ring(Canvas& canvas, Point centre);

}  // namespace gaitlab::report
