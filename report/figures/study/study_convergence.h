// Progress of a search: best, median and share of kept points by generation.
#pragma once
#include "report/figures/study/study_figure.h"

namespace gaitlab::report {

/// best, median: of the kept points; NaN: none.
struct ConvergencePoint {
  double generation = 0, restart = 0, points = 0;
  double best = 0, median = 0, kept = 0, spread = 0;  ///< kept: share of the points; spread: share of the box
};

struct ConvergenceFigure {
  std::string title, note;
  StudyAxis value;
  bool maximize = true;
  std::vector<std::vector<ConvergencePoint>> searches;  ///< each in the order of its generations
};

std::string convergence_svg(const ConvergenceFigure& figure);
std::string convergence_csv(const ConvergenceFigure& figure);

}  // namespace gaitlab::report
