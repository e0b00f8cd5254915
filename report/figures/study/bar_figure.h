// A figure of bars with error bands: the influence of each of several names.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::report {

/// A bar. NaN: not known, and not drawn.
struct Bar {
  double value = 0, low = 0, high = 0;
};

struct BarRow {
  std::string name;
  std::vector<Bar> bars;  ///< one per kind
};

struct BarFigure {
  std::string title, note, axis;
  std::vector<std::string> kinds;  ///< for the legend: at most three
  std::vector<BarRow> rows;        ///< from above
};

/// SVG of at most 200 rows: the rows below are left out, which the note mentions.
std::string bar_svg(const BarFigure& figure);

}  // namespace gaitlab::report
