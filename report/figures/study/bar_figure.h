// A figure of bars with error bands: how much each of several names counts.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::report {

/// NaN: not known, and not drawn.
struct Bar {
  double value = 0, low = 0, high = 0;
};

struct BarRow {
  std::string name;
  std::vector<Bar> bars;  ///< one of each kind
};

struct BarFigure {
  std::string title, note, axis;
  std::vector<std::string> kinds;  ///< for the legend: at most three
  std::vector<BarRow> rows;        ///< from above
};

/// At most 200 rows: those below are left out, and the note says so.
std::string bar_svg(const BarFigure& figure);

}  // namespace gaitlab::report
