// Several runs in one figure: a curve each, panels one below another.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::report {

struct CurvesPanel {
  std::string title;                             ///< with the unit
  double from = 0;                               ///< s: start of the time axis
  std::vector<std::vector<double>> values = {};  ///< one per run, of the length of its time; not finite: a gap
};

struct CurvesInput {
  std::string title;
  std::vector<std::string> names;         ///< of the runs, in the legend
  std::vector<std::vector<double>> time;  ///< s, rising; one per run
  std::vector<CurvesPanel> panels;
  /// Groups of runs with coinciding curves: each is dashed so that all are visible, and the legend names them.
  std::vector<std::vector<std::size_t>> coincide = {};
};

/// An SVG document, 1000 px wide. Each run has the same colour and dash in all panels.
std::string curves_svg(const CurvesInput& input);

}  // namespace gaitlab::report
