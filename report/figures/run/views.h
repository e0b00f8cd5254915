// The lower part of a run's figure: the robot at a few instants, one below another.
#pragma once
#include "report/figures/run/figure.h"
#include "report/plot/plot.h"

namespace gaitlab::report {

inline constexpr double kLeft = 80, kRight = 920;  ///< px, left and right edge of all parts of a figure
inline constexpr double kLeftOfNames = 120;        ///< px, left edge in figures with names of legs at the left

/// Left edge of the panels of a figure, px.
inline double left_edge(const FigureInput& input) { return input.footfalls.empty() ? kLeft : kLeftOfNames; }

/// Fill colour of the bodies of a role, `#RRGGBB`.
std::string_view body_colour(Role role);

/// Horizontal range of a drawing, px.
struct Edges {
  double left = kLeft, right = kRight;
};

/// Height of the views with legend and axis, px.
double views_height(const FigureInput& input, const Edges& edges);
void draw_views(Canvas& canvas, const FigureInput& input, const Edges& edges, double top);

}  // namespace gaitlab::report
