// Figures of all points of a study with any number of parameters.
#pragma once
#include <string>
#include <vector>

#include "report/figures/study/study_figure.h"

namespace gaitlab::report {

/// Axis of a parameter. If the parameter is a word, the coordinate of a point is its index in `words`.
struct ManyAxis {
  StudyAxis axis;
  std::vector<std::string> words = {};
};

struct ManyPoint {
  std::vector<double> at;  ///< one coordinate per axis
  double value = 0;        ///< NaN if not known
  PointState state = PointState::kept;
};

struct ManyFigure {
  std::string title, note;  ///< `note` is printed below the figure
  std::vector<ManyAxis> axes;
  StudyAxis value;
  std::vector<ManyPoint> points;
  std::size_t best = 0;   ///< index of the best point; points.size() if there is none
  bool objective = true;  ///< true if the value is an objective of the study; otherwise the best point is only in the table
  [[nodiscard]] bool marks_best() const { return objective && best < points.size(); }
};

/// SVG with parallel coordinates: one axis per parameter, at most 16, and one line per point. Kept points are coloured by their
/// value, others are grey, the best point is black. Above 20 000 line segments, a histogram of the lines is drawn instead. The
/// note lists the parameters that were left out.
std::string parallel_svg(const ManyFigure& figure);
/// SVG with a panel for each of at most 24 parameters, which shows the value over the parameter. Above 20 000 dots, a histogram
/// of the dots is drawn instead.
std::string scatter_svg(const ManyFigure& figure);
/// CSV table of the points, for both figures.
std::string many_csv(const ManyFigure& figure);

}  // namespace gaitlab::report
