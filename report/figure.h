// The figure of a run: one joint's motion and torque over time, when each leg stands, and the robot from the side.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/footfall.h"
#include "report/side_view.h"

namespace gaitlab::report {

/// The robot at one instant, m, in the plane of the view: x along the travel, y up, the ground at 0.
struct View {
  double time = 0;                   ///< s
  std::vector<Outline> outlines;     ///< far to near, as side_view gives them
  std::vector<Point> contacts = {};  ///< where the ground pushes
  std::optional<Point> joint = {};   ///< the joint of the upper panel: an arrow points it out
};

struct FigureInput {
  std::string title;
  std::string joint;                     ///< name of the joint shown, `m3/passive`
  std::vector<double> time;              ///< s, rising
  std::vector<double> angle, setpoint;   ///< rad; as long as `time`, or empty: not drawn
  std::vector<double> torque;            ///< N m; likewise
  double least_angle = 0;                ///< rad: the angle axis spans at least -this to this, so that a joint at rest looks it
  std::vector<Footfall> footfalls = {};  ///< one a leg, from top to bottom; none: no diagram
  std::string footfall_note = {};        ///< over its right end: what the bars and the numbers are
  std::vector<View> views;               ///< drawn from top to bottom
  std::vector<Polygon> solids = {};      ///< what stands on the ground, m, in the plane of the view; drawn within its x range
  bool ground = true;                    ///< a plane at height 0; without it every view is centred on the robot
  std::string views_title = {};          ///< instead of `side view (arrow: joint above)`
  std::string views_axis = "x (m), heights on the same scale";
};

/// An SVG document, 1000 px wide, as high as the views need. Upper panel (left out without a joint's series): the last 8 s,
/// angle and set point on the left axis, torque on the right one, zeros on one line. Below it the footfalls over the same
/// seconds (left out without `time`), and the views, all on one scale in both directions and over one x range, with the ground
/// and an axis in metres. Values that are not finite leave a gap.
std::string figure_svg(const FigureInput& input);

}  // namespace gaitlab::report
