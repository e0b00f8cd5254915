// A bar figure with error bands, for the influence of several parameters.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::report {

/// A bar with its error band. A value that is NaN is not known and not drawn.
struct Bar {
  double value = 0, low = 0, high = 0;
};

struct BarRow {
  std::string name;
  std::vector<Bar> bars;    ///< one bar for each entry of BarFigure::kinds
  std::string remark = {};  ///< short text at the right of the row
};

struct BarFigure {
  std::string title, note, axis;
  std::vector<std::string> kinds;  ///< names of the bars in the legend, at most three
  std::vector<BarRow> rows;        ///< rows from top to bottom
};

/// SVG with at most 200 rows. Further rows are left out, and the note says so.
std::string bar_svg(const BarFigure& figure);

}  // namespace gaitlab::report
