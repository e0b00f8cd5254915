// Drawing of a robot at a few instants, one below another.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/figures/run/side_view.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"

namespace gaitlab::report {

/// The robot at one instant, in the plane of the view; lengths in m. x is along the direction of travel, y is up, and the
/// ground is at y = 0.
struct View {
  double time = 0;                   ///< s
  std::vector<Outline> outlines;     ///< outlines of the bodies from far to near, as side_view returns them
  std::vector<Point> contacts = {};  ///< points at which the ground pushes
  std::optional<Point> joint = {};   ///< position of a joint, marked by an arrow
  std::optional<double> com = {};    ///< x of the centre of mass
};

struct ViewsInput {
  std::vector<View> views;           ///< from top to bottom
  std::vector<Polygon> solids = {};  ///< obstacles on the ground, m, in the plane of the view; only the part within its x
                                     ///< range is drawn
  bool ground = true;                ///< true: a plane at height 0 is drawn; false: every view is centred on the robot
  std::string axis = "x (m), heights on the same scale";
};

/// Fill colour of the bodies of a role, `#RRGGBB`.
std::string_view body_colour(Role role);

/// Horizontal range of a drawing, px.
struct Edges {
  double left = 0, right = 0;
};

/// Legend of the views.
std::vector<LegendEntry> views_legend(const std::vector<View>& views);

/// Height of the views with their axis, px.
double views_height(const ViewsInput& input, const Edges& edges);
void draw_views(Canvas& canvas, const ViewsInput& input, const Edges& edges, double top);

}  // namespace gaitlab::report
