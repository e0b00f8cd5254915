// A figure of the progress of a search: best value, median and share of kept points over the number of runs.
#pragma once
#include "report/figures/study/study_figure.h"

namespace gaitlab::report {

/// State of a search after a generation. `best` and `median` are over the kept points, NaN if there are none.
struct ConvergencePoint {
  double generation = 0, restart = 0, points = 0;
  double best = 0, median = 0, kept = 0, spread = 0;  ///< `kept` is a share of the points, `spread` a share of the parameter
                                                      ///< box
  double runs = 0;                                    ///< number of runs of the study when the generation has ended
};

/// A new best value, and the number of runs of the study when it was found.
struct Improvement {
  double runs = 0, value = 0;
};

struct ConvergenceFigure {
  std::string title, note;
  StudyAxis value;
  bool maximize = true;
  std::vector<std::vector<ConvergencePoint>> searches;  ///< one list per search, in the order of the generations
  std::vector<Improvement> best;                        ///< improvements of all searches together, in the order of the runs
  double runs = 0;                                      ///< number of runs of the study
};

std::string convergence_svg(const ConvergenceFigure& figure);
/// A row per generation of each search.
std::string convergence_csv(const ConvergenceFigure& figure);
/// A row per improvement of the best value.
std::string improvements_csv(const ConvergenceFigure& figure);

}  // namespace gaitlab::report
