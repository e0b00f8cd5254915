// The figure of a run: motion and torque of joints over time, the footfalls of the legs, and views of the robot.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/figures/run/footfall.h"
#include "report/figures/run/side_view.h"

namespace gaitlab::report {

inline constexpr double kShownSeconds = 8;  ///< s, curves show the end of the run, at most of this length

/// The robot at one instant, m, in the plane of the view: x is along the direction of travel, y up, and the ground is at y = 0.
struct View {
  double time = 0;                   ///< s
  std::vector<Outline> outlines;     ///< outlines of the bodies from far to near, as side_view returns them
  std::vector<Point> contacts = {};  ///< points at which the ground pushes
  std::optional<Point> joint = {};   ///< position of the joint in the first panel, marked by an arrow
  std::optional<double> com = {};    ///< x of the centre of mass
};

/// Curves of one joint over time. A curve has the length of the figure's time, or is empty and not drawn.
struct JointPanel {
  std::string joint;                    ///< name of the joint, `m3/passive`
  std::vector<double> angle, setpoint;  ///< rad
  std::vector<double> torque;           ///< N m
  std::vector<double> limit;            ///< 1 at the limit of voltage, 2 at the limit of current; both are shaded
  double peak = 0, peak_time = 0;       ///< N m and s, largest torque of the judged window; not drawn if 0
  double rest_torque = 0;               ///< N m, largest torque of the motor at rest; 0 if not known
  std::vector<double> changes = {};     ///< s, times of changes (section `at`), drawn as vertical lines
  double least_angle = 0;  ///< rad, least half range of the angle axis, which prevents noise of a resting joint from filling
                           ///< the panel
};

struct FigureInput {
  std::string title;
  std::vector<double> time;              ///< s, rising
  std::vector<JointPanel> joints;        ///< panels from top to bottom
  std::vector<Footfall> footfalls = {};  ///< rows of the footfall diagram from top to bottom; no diagram if empty
  std::string footfall_note = {};        ///< caption over the right end of the diagram, for bars and duty factors
  std::vector<View> views;               ///< views from top to bottom
  std::vector<Polygon> solids = {};      ///< obstacles on the ground, m, in the plane of the view; only the part within its x
                                         ///< range is drawn
  bool ground = true;                    ///< true: a plane at height 0 is drawn; false: every view is centred on the robot
  std::string views_title = {};          ///< title that replaces `side view (arrow: joint above)`
  bool views_legend = true;
  std::string views_axis = "x (m), heights on the same scale";
};

/// SVG document, 1000 px wide and as high as the views need. From top to bottom:
/// - A panel per joint over the last 8 s, left out without curves: angle and set point on the left axis, torque on the right
/// axis. The zeros of both axes coincide if that costs less than half the height. The largest torque is marked, time at a limit
/// is shaded, and the motor's torque at rest is a line if the curve comes near it.
/// - The footfalls over the same seconds, left out without `time`.
/// - The views, with the same scale in both directions, the same x range, the ground, and an axis in m.
/// Values that are not finite leave a gap.
std::string figure_svg(const FigureInput& input);

}  // namespace gaitlab::report
