// The lower part of a figure: the robot at a few instants, one below the other.
#pragma once
#include "report/figures/run/figure.h"

namespace gaitlab::report {

inline constexpr double kLeft = 80, kRight = 920;  ///< px, of all parts of a figure
inline constexpr double kLeftOfNames = 120;        ///< px, where legs have their names at the left

/// px: where the panels of this figure begin.
inline double left_edge(const FigureInput& input) { return input.footfalls.empty() ? kLeft : kLeftOfNames; }

/// With which bodies are filled, `#RRGGBB`.
std::string_view body_colour(Role role);

/// px, from left to right, where something is drawn.
struct Edges {
  double left = kLeft, right = kRight;
};

/// px, legend and axis included.
double views_height(const FigureInput& input, const Edges& edges);
void draw_views(Canvas& canvas, const FigureInput& input, const Edges& edges, double top);

}  // namespace gaitlab::report
