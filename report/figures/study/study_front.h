// A figure of two objectives, with the Pareto front and the dominated points.
#pragma once
#include "core/names.h"
#include "report/figures/study/study_figure.h"

namespace gaitlab {

namespace report {

enum class FrontState { behind, front, verified };

}  // namespace report

template <>
struct EnumNames<report::FrontState> {
  using enum report::FrontState;
  static constexpr EnumName<report::FrontState> kTable[] = {{behind, "behind"}, {front, "front"}, {verified, "verified"}};
};

namespace report {

struct FrontPoint {
  double run = 0;
  std::vector<double> objectives;  ///< two or three values; a third one is only in the table
  FrontState state = FrontState::behind;
};

struct FrontFigure {
  std::string title, note;
  std::vector<StudyAxis> objectives;
  std::vector<bool> maximize;
  std::vector<FrontPoint> points;  ///< kept points; those of the front are in the order of the first objective
};

/// SVG with at most 20 000 marks. If there are more points, only every nth dominated point is drawn.
std::string front_svg(const FrontFigure& figure);
std::string front_csv(const FrontFigure& figure);

}  // namespace report
}  // namespace gaitlab
