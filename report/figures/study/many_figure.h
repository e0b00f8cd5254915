// Figures over the points of a study with any number of parameters.
#pragma once
#include <string>
#include <vector>

#include "report/figures/study/study_figure.h"

namespace gaitlab::report {

/// A parameter: numbers, or words, of which a point has the index.
struct ManyAxis {
  StudyAxis axis;
  std::vector<std::string> words = {};
};

struct ManyPoint {
  std::vector<double> at;  ///< by axis
  double value = 0;        ///< NaN: not known
  PointState state = PointState::kept;
};

struct ManyFigure {
  std::string title, note;  ///< note: below
  std::vector<ManyAxis> axes;
  StudyAxis value;
  std::vector<ManyPoint> points;
  std::size_t best = 0;  ///< index of a point; points.size(): none
};

/// Parallel coordinates: a line per point over an axis per parameter, kept ones coloured by their value, others grey, the best
/// black. Above 20 000 line segments between axes a histogram of them. At most 16 parameters; the note mentions those left out.
std::string parallel_svg(const ManyFigure& figure);
/// A panel per parameter, at most 24: the value over the parameter. Above 20 000 dots a histogram of them.
std::string scatter_svg(const ManyFigure& figure);
/// Points of both figures as CSV.
std::string many_csv(const ManyFigure& figure);

}  // namespace gaitlab::report
