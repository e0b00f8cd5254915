// A figure over the points of a study: a line over one parameter, a map over two.
#pragma once
#include <string>
#include <vector>

#include "core/names.h"

namespace gaitlab {

namespace report {

/// An axis: a parameter or a quantity.
struct StudyAxis {
  std::string name, unit;
  bool log = false;
  [[nodiscard]] std::string title() const { return unit.empty() ? name : name + " (" + unit + ")"; }
};

/// kept: breaks no guard and no constraint. Others: infeasible by the verdict of a run, or broken without such a verdict.
enum class PointState { kept, broken, infeasible, failed };

}  // namespace report

template <>
struct EnumNames<report::PointState> {
  using enum report::PointState;
  static constexpr EnumName<report::PointState> kTable[] = {
      {kept, "kept"}, {broken, "guard broken"}, {infeasible, "infeasible"}, {failed, "failed"}};
};

namespace report {

/// value: the mean over the replicates, low and high the least and the largest; NaN: not known.
struct StudyPoint {
  double x = 0, y = 0;
  double value = 0, low = 0, high = 0;
  PointState state = PointState::kept;
};

/// Entry of a legend for the points that ended normally and are not kept; empty: none.
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
  std::string title, note;  ///< note: a line below
  StudyAxis x, y, value;
  bool map = false;   ///< two parameters
  bool grid = false;  ///< a map of cells; else of dots
  std::vector<StudyPoint> points;
  std::size_t best = 0;  ///< index of a point; points.size(): none
};

/// SVG with at most 20 000 marks: above that a histogram, whose cells are the means of their kept points.
std::string study_svg(const StudyFigure& figure);
/// The points as CSV.
std::string study_csv(const StudyFigure& figure);

}  // namespace report
}  // namespace gaitlab
