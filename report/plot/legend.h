// The legend of a figure: samples of lines with their names.
#pragma once
#include <span>
#include <string>

#include "report/plot/canvas.h"

namespace gaitlab::report {

struct LegendEntry {
  std::string name;
  Style style;
};

/// px: lengths of a sample, from its start to its name, and behind a name; and the width of a text of a size.
struct LegendLook {
  double sample = 38, name = 46, gap = 24;
  double (*width)(std::string_view, double) = text_width;
};

inline constexpr double kLegendLine = 24;  ///< px, from line to line

/// Draws the entries from left to right and line by line, the first baseline at `y` (px); without a canvas it only measures.
/// Returns the last baseline.
double draw_legend(Canvas* canvas, std::span<const LegendEntry> entries, double left, double right, double y,
                   const LegendLook& look = {});

}  // namespace gaitlab::report
