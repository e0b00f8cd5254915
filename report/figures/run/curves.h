// Several runs in one figure: a curve each, panel under panel.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::report {

struct CurvesPanel {
  std::string title;                             ///< with the unit
  double from = 0;                               ///< s: the time axis begins here
  std::vector<std::vector<double>> values = {};  ///< one per run, as long as its time; not finite: a gap
};

struct CurvesInput {
  std::string title;
  std::vector<std::string> names;         ///< of the runs, in the legend
  std::vector<std::vector<double>> time;  ///< s, rising; one per run
  std::vector<CurvesPanel> panels;
  /// Groups of runs whose curves lie on each other: each is dashed so that all are seen, and the legend names them.
  std::vector<std::vector<std::size_t>> coincide = {};
};

/// An SVG document, 1000 px wide. The runs keep colour and dash from panel to panel.
std::string curves_svg(const CurvesInput& input);

}  // namespace gaitlab::report
