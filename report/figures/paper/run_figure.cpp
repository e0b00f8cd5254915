#include "report/figures/paper/run_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/scenario/change_section.h"
#include "report/figures/paper/paper_figure.h"
#include "report/figures/run/run_footfalls.h"
#include "report/figures/run/run_views.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kViews = 5;
constexpr double kShownSeconds = 8;  // s, curves show the end of the run, at most of this length
// Longest time that the views cover, s. The period found may be a multiple of the gait's.
constexpr double kLongest = 4;
constexpr double kPeriodless = 2;     // s, time that the views cover without a limit cycle
constexpr double kLeastAngle = 0.02;  // rad, least half range of the angle axis, for a joint at rest
constexpr double kAboutY = 0.9;       // least |y| of the axis of a joint that turns about y
constexpr double kSamePlace = 1e-3;   // m, distances that differ by less are equal
constexpr double kChartHeight = 65;   // mm

// Start of the whole periods within the time shown at the end of the run, s.
double periods_from(const Summary& s) {
  const double shown = std::min(kShownSeconds, s.simulated);
  const double period = s.limit_cycle.period;
  if (!s.limit_cycle.found || period > shown) return s.simulated - shown;
  return std::max(0.0, s.simulated - std::floor(shown / period + 1e-3) * period);
}

/// Text with the robot's front and its direction of motion in the view: `, front at the right, moves to the left`. Empty if
/// neither is along the axis.
std::string directions(const Robot& robot, const Recording& r, const Sight& from) {
  constexpr double kAlong = 0.7;   // a smaller component means that the robot is seen from the front rather than from the side
  constexpr double kMoved = 0.02;  // m
  const auto side = [](double along) { return along > 0 ? "right" : "left"; };
  std::string text;
  const double ahead = from.camera.right.dot(r.state(robot, r.rows() - 1).orientation * Vec3::UnitX());
  if (std::abs(ahead) >= kAlong) text += fmt::format(", front at the {}", side(ahead));
  const Series x = r.series("com.x");
  const Series y = r.series("com.y");
  if (x.empty() || y.empty()) return text;
  const double moved = from.camera.right.dot(Vec3(x.back() - x.front(), y.back() - y.front(), 0));
  if (std::abs(moved) > kMoved) text += fmt::format(", moves to the {}", side(moved));
  return text;
}

/// Five views from the start of the last period on (a view at its end would be equal to the first one). Without a period, the
/// views are one second apart up to the end of the run.
PanelRecipe views(const Scenario& scenario, const Recording& r, const Summary& s, bool walks, const Joint* pointed) {
  const Sight from = sight(scenario, r);
  const MotionCycle& cycle = s.limit_cycle;
  const bool periodic = pointed != nullptr && (cycle.found || walks);
  const double span = periodic ? std::min({cycle.found ? cycle.period : kPeriodless, kLongest, s.simulated}) : kViews - 1;
  PanelRecipe panel;
  panel.kind = &kViewsPanel;
  for (std::size_t i = 0; i < kViews; ++i) {
    const double t = s.simulated - span * (1 - static_cast<double>(i) / (periodic ? kViews : kViews - 1));
    if (t > -1e-9 && (panel.times.empty() || t > panel.times.back() + scenario.trace.period - 1e-9))
      panel.times.push_back(std::max(0.0, t));
  }
  panel.title = from.view;
  if (periodic)
    panel.title += fmt::format(" over {} {:.3g} s", cycle.found && cycle.period <= span ? "one period," : "the last", span);
  if (pointed != nullptr) {
    panel.joint = pointed->name;
    panel.title += fmt::format(" (arrow: {})", pointed->name);
  }
  panel.title += directions(*scenario.robot, r, from);
  return panel;
}

struct Drawn {
  std::size_t joint = 0;
  std::string what = {};
  double least_angle = 0;  ///< rad
};

/// The joints that `figure.joints` lists or, if it is empty, the most loaded joint, and for a robot on legs the central spine
/// joint.
std::vector<Drawn> drawn_joints(const Scenario& scenario, const Summary& summary, const std::vector<Leg>& legs) {
  const std::vector<Joint>& joints = scenario.robot->joints;
  if (joints.empty()) return {};
  std::vector<Drawn> drawn;
  const std::size_t worst = summary.most_loaded();
  const auto told = [&](std::size_t joint) { return joint == worst ? ", most loaded" : ""; };
  for (const std::string& name : scenario.figure.joints) {
    const auto number = static_cast<std::size_t>(std::ranges::find(joints, name, &Joint::name) - joints.begin());
    const auto same = [&](const Drawn& other) { return other.joint == number; };
    if (std::ranges::none_of(drawn, same)) drawn.push_back({number, told(number)});
  }
  if (!drawn.empty()) return drawn;
  if (legs.empty()) return {{worst, told(worst)}};
  const std::optional<std::size_t> spine = central_spine_joint(info(*scenario.robot), legs);
  if (worst != spine) drawn.push_back({worst, told(worst)});
  if (spine) drawn.push_back({*spine, std::string(", middle of the spine") + told(*spine), kLeastAngle});
  return drawn;
}

/// Angle and set point of a joint, with its torque on the right axis.
PanelRecipe chart(const Scenario& scenario, const Recording& r, const Summary& summary, const Drawn& drawn, double from) {
  const Joint& joint = scenario.robot->joints[drawn.joint];
  PanelRecipe panel;
  panel.from = from;
  panel.height = kChartHeight;
  panel.left.label = "angle (rad)";
  panel.left.least = drawn.least_angle;
  panel.title = fmt::format("joint {} ({})", drawn.joint, joint.name);
  for (const FaultSpan& fault : fault_spans(scenario)) {
    if (fault.joint == drawn.joint && fault.from < r.simulated)
      panel.title += fmt::format(", {} from {:.4g} s", name_of(fault.kind), fault.from);
  }
  panel.title += drawn.what;
  for (const Change& change : scenario.changes) panel.marks.push_back(change.t);
  const auto add = [&](AxisRecipe& axis, const char* quantity) {
    if (!r.joint(drawn.joint, quantity).empty()) axis.columns.push_back(fmt::format("joint.{}.{}", drawn.joint, quantity));
  };
  add(panel.left, "angle");
  add(panel.left, "logged_angle");
  if (scenario.actuator.entry == nullptr || !joint.driven()) return panel;
  add(panel.left, "setpoint");
  add(panel.right, "torque");
  add(panel.right, "logged_torque");
  panel.motor = joint.name;
  if (drawn.joint < summary.judged.joints.size()) {
    const JudgedJoint& judged = summary.judged.joints[drawn.joint];
    if (judged.torque_peak > 0)
      panel.title += fmt::format(", peak {:.3g} N m at {:.2f} s", judged.torque_peak, judged.torque_peak_time);
  }
  return panel;
}

}  // namespace

std::optional<std::size_t> central_spine_joint(const RobotInfo& robot, const std::vector<Leg>& legs) {
  const auto in_leg = [&](std::size_t j) {
    return std::ranges::any_of(
        legs, [&](const Leg& leg) { return std::ranges::find(leg.joints, static_cast<std::int64_t>(j)) != leg.joints.end(); });
  };
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (!in_leg(j)) joints.push_back(j);
  }
  if (joints.empty()) return {};
  const auto keep = [&](const auto& test) {
    std::vector<std::size_t> kept;
    std::copy_if(joints.begin(), joints.end(), std::back_inserter(kept), test);
    if (!kept.empty()) joints = kept;
  };
  const auto x = [&](std::size_t j) { return robot.joints[j].origin[0]; };
  const auto [rear, front] =
      std::minmax_element(joints.begin(), joints.end(), [&](std::size_t a, std::size_t b) { return x(a) < x(b); });
  const double middle = 0.5 * (x(*rear) + x(*front));
  keep([&](std::size_t j) { return std::abs(robot.joints[j].axis[1]) > kAboutY; });
  const auto off = [&](std::size_t j) { return std::abs(x(j) - middle); };
  const double least =
      off(*std::min_element(joints.begin(), joints.end(), [&](std::size_t a, std::size_t b) { return off(a) < off(b); }));
  keep([&](std::size_t j) { return off(j) < least + kSamePlace; });
  return *std::max_element(joints.begin(), joints.end(), [&](std::size_t a, std::size_t b) { return x(a) < x(b); });
}

std::string run_figure(const Scenario& scenario, const Recording& r, const Summary& summary) {
  const std::vector<Leg> legs = r.rows() > 0 ? legs_that_walk(scenario) : std::vector<Leg>();
  const std::vector<Drawn> drawn = drawn_joints(scenario, summary, legs);
  const double from = periods_from(summary);
  const std::vector<double> time = row_times(r);
  const RowRange shown = rows_within(time, from, 0);
  Recipe recipe = screen_recipe(scenario.name);
  if (shown.last - shown.first > 1) {
    for (const Drawn& each : drawn) {
      PanelRecipe panel = chart(scenario, r, summary, each, from);
      if (!panel.left.columns.empty() || !panel.right.columns.empty()) recipe.panels.push_back(std::move(panel));
    }
    if (!legs.empty() && loads_of(scenario, r, legs).lacks.empty()) {
      PanelRecipe& panel = recipe.panels.emplace_back();
      panel.kind = &kFootfallsPanel;
      panel.from = from;
      panel.title = fmt::format("footfalls: load above {:.3g} % of the weight, duty factor over {:.3g} s", 100 * kStands,
                                summary.simulated - from);
    }
  }
  if (r.rows() > 0 && r.has_states(*scenario.robot)) {
    const Joint* pointed = drawn.empty() ? nullptr : &scenario.robot->joints[drawn.front().joint];
    recipe.panels.push_back(views(scenario, r, summary, !legs.empty(), pointed));
  }
  return figure_svg(recipe, std::vector<PaperRun>{{scenario.name, scenario, r}});
}

}  // namespace gaitlab::report
