// A figure of several runs, with one curve per run in each of several panels.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::report {

struct CurvesPanel {
  std::string title;                             ///< title with the unit
  double from = 0;                               ///< s, start of the time axis
  std::vector<std::vector<double>> values = {};  ///< one curve per run, as long as its time; values that are not finite leave a
                                                 ///< gap
};

struct CurvesInput {
  std::string title;
  std::vector<std::string> names;         ///< names of the runs in the legend
  std::vector<std::vector<double>> time;  ///< s, rising; one list per run
  std::vector<CurvesPanel> panels;
  /// Groups of runs whose curves coincide. Their curves are dashed so that all are visible, and the legend names the groups.
  std::vector<std::vector<std::size_t>> coincide = {};
};

/// SVG document, 1000 px wide. Each run has the same colour and dash in all panels.
std::string curves_svg(const CurvesInput& input);

}  // namespace gaitlab::report
