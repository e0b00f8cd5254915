// A figure of the points of a study, which is a line for one parameter and a map for two.
#pragma once
#include <string>
#include <vector>

#include "core/names.h"

namespace gaitlab {

namespace report {

/// Axis of a parameter or of a quantity.
struct StudyAxis {
  std::string name, unit;
  bool log = false;
  [[nodiscard]] std::string title() const { return unit.empty() ? name : name + " (" + unit + ")"; }
};

/// State of a point. `kept`: the point satisfies all guards and constraints. `infeasible`: the verdict of a run is infeasible.
/// `broken`: the point does not satisfy a guard or constraint, without such a verdict. `failed`: a run ended early, without a
/// score.
enum class PointState { kept, broken, infeasible, failed };

}  // namespace report

template <>
struct EnumNames<report::PointState> {
  using enum report::PointState;
  static constexpr EnumName<report::PointState> kTable[] = {
      {kept, "kept"}, {broken, "guard broken"}, {infeasible, "infeasible"}, {failed, "failed"}};
};

namespace report {

/// Point of a study. `value` is the mean over the replicates, `low` and `high` are their least and largest value. NaN if not
/// known.
struct StudyPoint {
  double x = 0, y = 0;
  double value = 0, low = 0, high = 0;
  PointState state = PointState::kept;
};

/// Legend entry for the points that did not fail and are not kept. Empty if there are none.
template <class Points>
const char* not_kept_text(const Points& points) {
  bool broken = false;
  bool infeasible = false;
  for (const auto& point : points) {
    broken = broken || point.state == PointState::broken;
    infeasible = infeasible || point.state == PointState::infeasible;
  }
  return broken && infeasible ? "infeasible or guard broken" : broken ? "guard broken" : infeasible ? "infeasible" : "";
}
inline bool not_kept(PointState state) { return state == PointState::broken || state == PointState::infeasible; }

struct StudyFigure {
  std::string title, note;  ///< `note` is a line below the figure
  StudyAxis x, y, value;
  bool map = false;   ///< true for two parameters
  bool grid = false;  ///< true if the points of a map are a grid of cells; otherwise they are dots
  std::vector<StudyPoint> points;
  std::size_t best = 0;   ///< index of the best point; points.size() if there is none
  bool objective = true;  ///< true if the value is an objective of the study; otherwise the best point is only in the table
  [[nodiscard]] bool marks_best() const { return objective && best < points.size(); }
};

/// SVG with at most 20 000 marks. For more points it is a histogram, whose cells show the mean of their kept points. Kept
/// points decide the range of the values. Other points beyond this range are arrows at the edge, or have the last colour of a
/// colour bar with an arrow.
std::string study_svg(const StudyFigure& figure);
/// CSV table of the points.
std::string study_csv(const StudyFigure& figure);

}  // namespace report
}  // namespace gaitlab
