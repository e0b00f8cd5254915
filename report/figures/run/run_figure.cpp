#include "report/figures/run/run_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/math/periods.h"
#include "core/scenario/change_section.h"
#include "report/analysis/motors.h"
#include "report/figures/run/run_footfalls.h"
#include "report/figures/run/run_views.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kViews = 5;
// Longest time that the views cover, s. The period found may be a multiple of the gait's.
constexpr double kLongest = 4;
constexpr double kPeriodless = 2;     // s, time that the views cover without a limit cycle
constexpr double kLeastAngle = 0.02;  // rad, least half range of the angle axis, for a joint at rest
constexpr double kAboutY = 0.9;       // least |y| of the axis of a joint that turns about y
constexpr double kSamePlace = 1e-3;   // m, distances that differ by less are equal

JointPanel joint_panel(const Scenario& scenario, const Recording& r, const Summary& summary, std::size_t joint) {
  JointPanel panel;
  panel.joint = std::to_string(joint) + " (" + scenario.robot->joints[joint].name + ")";
  for (const FaultSpan& fault : fault_spans(scenario)) {
    if (fault.joint == joint && fault.from < r.simulated)
      panel.joint += fmt::format(", {} from {:.4g} s", name_of(fault.kind), fault.from);
  }
  for (const Change& change : scenario.changes) {
    if (change.t < r.simulated) panel.changes.push_back(change.t);
  }
  panel.angle = r.joint(joint, "angle").values();
  if (scenario.actuator.entry != nullptr && scenario.robot->joints[joint].driven()) {
    panel.setpoint = r.joint(joint, "setpoint").values();
    panel.torque = r.joint(joint, "torque").values();
    panel.limit = r.joint(joint, "saturation").values();
    if (const std::vector<double> rest = rest_torques(scenario); joint < rest.size()) panel.rest_torque = rest[joint];
    if (joint < summary.judged.joints.size()) {
      panel.peak = summary.judged.joints[joint].torque_peak;
      panel.peak_time = summary.judged.joints[joint].torque_peak_time;
    }
  }
  return panel;
}

// Start of the whole periods within the time shown at the end of the run, s.
double periods_from(const Summary& s) {
  const double shown = std::min(kShownSeconds, s.simulated);
  const double period = s.limit_cycle.period;
  if (!s.limit_cycle.found || period > shown) return s.simulated - shown;
  return s.simulated - std::floor(shown / period + 1e-3) * period;
}

/// Sides of the view at which the robot's front is and to which the robot moves: `, front at the right, moves to the left`.
/// Empty if neither is along the axis.
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

// Adds five views from the start of the last period on. A view at its end would be equal to the first one.
void add_period(FigureInput& input, const Scenario& scenario, const Recording& r, const Summary& s, const Sight& from,
                std::size_t joint) {
  const MotionCycle& cycle = s.limit_cycle;
  const double span = std::min({cycle.found ? cycle.period : kPeriodless, kLongest, s.simulated});
  for (std::size_t i = 0; i < kViews; ++i) {
    const double t = s.simulated - span * (1 - static_cast<double>(i) / kViews);
    const auto tick = static_cast<std::size_t>(std::llround(t / scenario.trace.period));
    if (tick >= input.time.size() || (i > 0 && input.time[tick] <= input.views.back().time)) continue;
    input.views.push_back(view_at(scenario, r, from, tick, joint));
  }
  input.views_title =
      fmt::format("{} over {} {:.3g} s (arrow: {})", from.view,
                  cycle.found && cycle.period <= span ? "one period," : "the last", span, scenario.robot->joints[joint].name);
  input.views_axis = fmt::format("{}{}; {}", from.axis, directions(*scenario.robot, r, from), from.scale());
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
  const std::size_t spine = central_spine_joint(info(*scenario.robot), legs);
  if (worst != spine) drawn.push_back({worst, told(worst)});
  drawn.push_back({spine, std::string(", middle of the spine") + told(spine), kLeastAngle});
  return drawn;
}

}  // namespace

std::size_t central_spine_joint(const RobotInfo& robot, const std::vector<Leg>& legs) {
  std::vector<bool> in_leg(robot.modules.size(), false);
  for (const Leg& leg : legs) {
    for (const std::int64_t m : leg.modules) in_leg[static_cast<std::size_t>(m)] = true;
  }
  std::vector<std::size_t> joints(robot.joints.size());
  std::iota(joints.begin(), joints.end(), 0);
  const auto keep = [&](const auto& test) {
    std::vector<std::size_t> kept;
    std::copy_if(joints.begin(), joints.end(), std::back_inserter(kept), test);
    if (!kept.empty()) joints = kept;
  };
  keep([&](std::size_t j) { return !in_leg[static_cast<std::size_t>(robot.joints[j].module)]; });
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
  const Sight from = sight(scenario, r);
  FigureInput input = views_input(scenario, r, from);
  input.title = scenario.name;
  const std::size_t pointed = drawn.empty() ? 0 : drawn.front().joint;
  const std::string arrow = drawn.empty() ? "" : fmt::format(" (arrow: {})", scenario.robot->joints[pointed].name);
  input.views_title = from.view + arrow;
  if (!drawn.empty()) input.time = r.series("t").values();
  for (const Drawn& each : drawn) {
    input.joints.push_back(joint_panel(scenario, r, summary, each.joint));
    input.joints.back().joint += each.what;
    input.joints.back().least_angle = each.least_angle;
  }
  if (!legs.empty()) {
    const double start = periods_from(summary);
    input.footfalls = footfalls(scenario, r, legs, input.time, start);
    input.footfall_note = fmt::format("bars: load above {:.3g} % of the weight; at the right the duty factor over {:.3g} s",
                                      100 * kStands, summary.simulated - start);
  }
  if (!input.time.empty() && (summary.limit_cycle.found || !legs.empty())) {
    add_period(input, scenario, r, summary, from, pointed);
    return figure_svg(input);
  }
  const auto second = static_cast<std::size_t>(std::max<std::int64_t>(1, math::steps_in(1.0, scenario.trace.period)));
  for (std::size_t back = kViews; back-- > 0;) {
    if (r.rows() > back * second) input.views.push_back(view_at(scenario, r, from, r.rows() - 1 - back * second, pointed));
  }
  return figure_svg(input);
}

}  // namespace gaitlab::report
