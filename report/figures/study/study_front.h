// Two objectives against one another: the Pareto front, and the dominated points.
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
  std::vector<double> objectives;  ///< two or three; the third is in the table alone
  FrontState state = FrontState::behind;
};

struct FrontFigure {
  std::string title, note;
  std::vector<StudyAxis> objectives;
  std::vector<bool> maximize;
  std::vector<FrontPoint> points;  ///< kept ones; points of the front ordered by the first objective
};

/// SVG with at most 20 000 marks: above that every n-th dominated point.
std::string front_svg(const FrontFigure& figure);
std::string front_csv(const FrontFigure& figure);

}  // namespace report
}  // namespace gaitlab
