// The figure of a run: one joint's motion and torque over time, the legs' footfalls, and the robot from the side.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/figures/run/footfall.h"
#include "report/figures/run/side_view.h"

namespace gaitlab::report {

inline constexpr double kShownSeconds = 8;  ///< s: curves over time show the last of a run

/// The robot at one instant, m, in the plane of the view: x along the travel, y up, the ground at 0.
struct View {
  double time = 0;                   ///< s
  std::vector<Outline> outlines;     ///< far to near, as from side_view
  std::vector<Point> contacts = {};  ///< points where the ground pushes
  std::optional<Point> joint = {};   ///< the joint of the first panel, marked by an arrow
  std::optional<double> com = {};    ///< x of the centre of mass
};

/// One joint over time.
struct JointPanel {
  std::string joint;                    ///< name of the joint shown, `m3/passive`
  std::vector<double> angle, setpoint;  ///< rad; as long as the figure's time, or empty: not drawn
  std::vector<double> torque;           ///< N m; likewise
  std::vector<double> limit;            ///< 1 at the limit of voltage, 2 of current: shaded; likewise
  double peak = 0, peak_time = 0;       ///< N m, s: the largest torque of the judged window; 0: not shown
  double rest_torque = 0;               ///< N m: largest torque of the motor at rest; 0: not known
  double least_angle = 0;  ///< rad: the angle axis spans at least -this to this, so that a joint at rest appears at rest
};

struct FigureInput {
  std::string title;
  std::vector<double> time;              ///< s, rising
  std::vector<JointPanel> joints;        ///< from top to bottom
  std::vector<Footfall> footfalls = {};  ///< one per leg, from top to bottom; empty: no diagram
  std::string footfall_note = {};        ///< caption over the right end, for bars and numbers
  std::vector<View> views;               ///< drawn from top to bottom
  std::vector<Polygon> solids = {};      ///< obstacles on the ground, m, in the plane of the view; drawn within its x range
  bool ground = true;                    ///< a plane at height 0; without it every view is centred on the robot
  std::string views_title = {};          ///< instead of `side view (arrow: joint above)`
  bool views_legend = true;
  std::string views_axis = "x (m), heights on the same scale";
};

/// An SVG document, 1000 px wide, as high as the views need. A panel per joint (left out without its series): the last 8 s,
/// angle and set point on the left axis, torque on the right one, zeros on one line if that takes less than half the height,
/// the largest torque marked, time at a limit shaded, and the motor's torque at rest as a line if the curve comes near it.
/// Below it the footfalls over the same seconds (left out without `time`), and the views, all on one scale in both directions
/// and over one x range, with the ground and an axis in metres. Values that are not finite leave a gap.
std::string figure_svg(const FigureInput& input);

}  // namespace gaitlab::report
