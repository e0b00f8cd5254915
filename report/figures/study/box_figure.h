// A box plot of the spread of a value in several groups.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::report {

struct BoxGroup {
  std::string name;
  std::vector<double> values;  ///< NaN if not known
  bool kept = true;
};

struct BoxFigure {
  std::string title, note, axis, below;  ///< `axis` is the title of the value axis, `below` that of the axis with the names
  std::vector<BoxGroup> groups;          ///< at most 12 groups are drawn
};

/// SVG with a box for each group from the first to the third quartile, a line at the median, lines to the least and the largest
/// value, and a dot for each of up to 500 values.
std::string box_svg(const BoxFigure& figure);

/// Quantile: the value that a share of the sorted values does not exceed, linear between neighbours (Hyndman and Fan 1996, type
/// 7).
double quartile(const std::vector<double>& sorted, double share);

}  // namespace gaitlab::report
