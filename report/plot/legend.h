// The legend of a figure, which shows symbols with their names.
#pragma once
#include <functional>
#include <span>
#include <string>

#include "report/plot/canvas.h"

namespace gaitlab::report {

struct LegendEntry {
  std::string name;
  std::function<void(Canvas&, Point)> draw;  ///< draws the symbol around a point
  double wide = 12;                          ///< px, width of the symbol
};
LegendEntry line_entry(std::string name, const Style& style, double wide = 30);
LegendEntry dot_entry(std::string name, const Style& style, double radius);
LegendEntry box_entry(std::string name, const Style& style);

/// Gaps before and after a name, px, and the function that computes the width of a text.
struct LegendLook {
  double before = 8, behind = 24;
  double (*width)(std::string_view, double) = text_width;
};

inline constexpr double kLegendLine = 24;  ///< px, distance between lines of a legend

/// Draws the entries from left to right and line by line. The first baseline is at `y` (px). Without a canvas nothing is drawn.
/// Returns the last baseline.
double draw_legend(Canvas* canvas, std::span<const LegendEntry> entries, double left, double right, double y,
                   const LegendLook& look = {});

}  // namespace gaitlab::report
