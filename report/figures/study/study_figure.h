// A figure over the points of a study: a line over one parameter, a map over two.
#pragma once
#include <string>
#include <vector>

#include "core/names.h"

namespace gaitlab {

namespace report {

/// An axis: a parameter or a figure.
struct StudyAxis {
  std::string name, unit;
  bool log = false;
  [[nodiscard]] std::string title() const { return unit.empty() ? name : name + " (" + unit + ")"; }
};

enum class PointState { feasible, infeasible, failed };

}  // namespace report

template <>
struct EnumNames<report::PointState> {
  using enum report::PointState;
  static constexpr EnumName<report::PointState> kTable[] = {
      {feasible, "feasible"}, {infeasible, "infeasible"}, {failed, "failed"}};
};

namespace report {

/// value: the mean over the replicates, low and high the least and the largest; NaN where not known.
struct StudyPoint {
  double x = 0, y = 0;
  double value = 0, low = 0, high = 0;
  PointState state = PointState::feasible;
};

struct StudyFigure {
  std::string title, note;  ///< note: a line below
  StudyAxis x, y, value;
  bool map = false;   ///< two parameters
  bool grid = false;  ///< a map of cells; else of dots
  std::vector<StudyPoint> points;
  std::size_t best = 0;  ///< number of a point; points.size(): there is none
};

/// At most 20 000 marks: above that a histogram, whose cells are the means of their feasible points.
std::string study_svg(const StudyFigure& figure);
/// The points it draws.
std::string study_csv(const StudyFigure& figure);

}  // namespace report
}  // namespace gaitlab
