// The lower part of a figure: the robot at a few instants, one below the other.
#pragma once
#include "report/figures/run/figure.h"
#include "report/plot/plot.h"

namespace gaitlab::report {

inline constexpr double kLeft = 80, kRight = 920;  ///< px, for all parts of a figure
inline constexpr double kLeftOfNames = 120;        ///< px, for figures with names of legs at the left

/// Left edge of the panels of a figure, px.
inline double left_edge(const FigureInput& input) { return input.footfalls.empty() ? kLeft : kLeftOfNames; }

/// Fill colour of bodies, `#RRGGBB`.
std::string_view body_colour(Role role);

/// Horizontal range of a drawing, px.
struct Edges {
  double left = kLeft, right = kRight;
};

/// Height with legend and axis, px.
double views_height(const FigureInput& input, const Edges& edges);
void draw_views(Canvas& canvas, const FigureInput& input, const Edges& edges, double top);

}  // namespace gaitlab::report
