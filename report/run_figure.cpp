#include "report/run_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/figure.h"

namespace gaitlab::report {

namespace {

View view_at(const Scenario& scenario, const Recording& r, std::size_t tick, std::size_t joint) {
  const Robot& robot = *scenario.robot;
  Kinematics k(robot);
  k.update(robot, r.state(robot, tick));
  View view{static_cast<double>(tick) * scenario.trace.period, side_view(robot, k)};
  for (const ContactElement& element : contact_elements(robot, scenario.contact.on)) {
    const Ground::Touch touch = scenario.ground.query(k.point(element.link, element.centre), element.radius);
    if (scenario.ground.kind != Ground::Kind::none && touch.penetration > 0) {
      view.contacts.push_back({touch.point.x(), touch.point.z()});
    }
  }
  if (!robot.joints.empty()) {
    const Vec3& at = k.p[robot.joints[joint].link];
    view.joint = Point{at.x(), at.z()};
  }
  return view;
}

// Boxes as they are; of a field the line below the robot at the end.
std::vector<Polygon> solids(const Scenario& scenario, const Recording& r) {
  std::vector<Polygon> seen;
  const Ground& ground = scenario.ground;
  if (ground.kind == Ground::Kind::boxes) {
    for (const Box& box : ground.boxes) seen.push_back(box_outline({box.R, box.center}, box.size));
  } else if (ground.kind == Ground::Kind::heightfield && r.rows() > 0) {
    constexpr int kPieces = 400;
    constexpr double kThick = 0.004;  // m
    const double y = r.series("base.y").back();
    const double from = ground.field.origin.x();
    const double step = ground.field.spacing * static_cast<double>(ground.field.columns - 1) / kPieces;
    constexpr double kFar = 1000;  // m, beyond the border, where the heights go on
    Polygon line{{from - kFar, ground.field.at(from, y).z}};
    for (int i = 0; i <= kPieces; ++i) line.push_back({from + i * step, ground.field.at(from + i * step, y).z});
    line.push_back({line.back().x + kFar, line.back().y});
    for (std::size_t i = line.size(); i-- > 0;) {
      const Point above = line[i];
      line.push_back({above.x, above.y - kThick});
    }
    seen.push_back(std::move(line));
  }
  return seen;
}

constexpr std::size_t kViews = 5;
constexpr double kShown = 8;         // s, of the upper panels
constexpr double kLongest = 4;       // s, of the side views: a period may have been found as a multiple of the gait's
constexpr double kPeriodless = 2;    // s, of the side views without a limit cycle
constexpr double kStands = 0.02;     // of the weight
constexpr double kPaperAngle = 0.1;  // rad, the angle axis of the paper's figure 14
constexpr double kAboutY = 0.9;      // least |y| of an axis
constexpr double kSamePlace = 1e-3;  // m

std::vector<Leg> legs_that_walk(const Scenario& s) {
  if (s.ground.kind == Ground::Kind::none || s.contact.on == ContactSet::none) return {};
  std::vector<Leg> legs = find_legs(info(*s.robot));
  if (legs.size() < 4) legs.clear();
  return legs;
}

std::vector<double> times(const Scenario& scenario, const Recording& r, const Summary& summary) {
  std::vector<double> time;
  for (std::size_t k = 0; k < r.rows(); ++k)
    time.push_back(std::min(static_cast<double>(k) * scenario.trace.period, summary.simulated));
  return time;
}

// Angle, set point and torque of a joint over `input.time`.
void add_joint(FigureInput& input, const Scenario& scenario, const Recording& r, std::size_t joint) {
  input.joint = std::to_string(joint) + " (" + scenario.robot->joints[joint].name + ")";
  input.angle = r.joint(joint, "angle").values();
  if (scenario.actuator.entry != nullptr) {
    input.setpoint = r.joint(joint, "setpoint").values();
    input.torque = r.joint(joint, "torque").values();
  }
}

// The start of the whole periods at the end of the run, as many as are shown.
double periods_from(const Summary& s) {
  const double shown = std::min(kShown, s.simulated);
  const double period = s.limit_cycle.period;
  if (!s.limit_cycle.found || period > shown) return s.simulated - shown;
  return s.simulated - std::floor(shown / period + 1e-3) * period;
}

std::vector<Footfall> footfalls(const Scenario& scenario, const Recording& r, const std::vector<Leg>& legs,
                                const std::vector<double>& time, double from) {
  const double weight = scenario.robot->mass * scenario.physics.gravity.norm();
  const std::vector<std::string> names = leg_names(legs);
  std::vector<Footfall> rows;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    std::vector<double> load(time.size(), 0.0);
    for (const std::int64_t m : legs[i].modules) {
      const Series of_module = r.series(fmt::format("load.{}", m));
      for (std::size_t k = 0; k < of_module.size(); ++k) load[k] += of_module[k];
    }
    Footfall row{names[i], stances(time, load, kStands * weight)};
    row.duty_factor = duty_factor(row.stances, from, time.back());
    rows.push_back(std::move(row));
  }
  return rows;
}

// Five views from the start of the last period on; the sixth would show what the first shows.
void add_period(FigureInput& input, const Scenario& scenario, const Recording& r, const Summary& s, std::size_t joint) {
  const MotionCycle& cycle = s.limit_cycle;
  const double span = std::min({cycle.found ? cycle.period : kPeriodless, kLongest, s.simulated});
  for (std::size_t i = 0; i < kViews; ++i) {
    const double t = s.simulated - span * (1 - static_cast<double>(i) / kViews);
    const auto tick = static_cast<std::size_t>(std::llround(t / scenario.trace.period));
    if (tick >= input.time.size() || (i > 0 && input.time[tick] <= input.views.back().time)) continue;
    input.views.push_back(view_at(scenario, r, tick, joint));
  }
  input.views_title =
      fmt::format("side view over {} {:.3g} s", cycle.found && cycle.period <= span ? "one period," : "the last", span);
  const double ahead = (r.state(*scenario.robot, r.rows() - 1).orientation * Vec3::UnitX()).x();
  if (std::abs(ahead) < 0.7) return;  // seen from the front rather than from the side
  input.views_axis = fmt::format("x (m), forward is {}; heights on the same scale", ahead > 0 ? "right" : "left");
}

std::string legged_figure(const Scenario& scenario, const Recording& r, const Summary& summary, const std::vector<Leg>& legs) {
  FigureInput input;
  input.title = scenario.name;
  input.ground = scenario.ground.kind != Ground::Kind::heightfield;
  input.solids = solids(scenario, r);
  input.time = times(scenario, r, summary);
  const double from = periods_from(summary);
  const std::size_t joint = central_spine_joint(info(*scenario.robot), legs);
  add_joint(input, scenario, r, joint);
  input.joint += ", middle of the spine (arrow below)";
  input.least_angle = kPaperAngle;
  input.footfalls = footfalls(scenario, r, legs, input.time, from);
  input.footfall_note = fmt::format("bars: load above {:.3g} % of the weight; at the right the duty factor over {:.3g} s",
                                    100 * kStands, summary.simulated - from);
  add_period(input, scenario, r, summary, joint);
  return figure_svg(input);
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
  const std::vector<Leg> legs = legs_that_walk(scenario);
  const std::size_t ticks = r.rows();
  if (!legs.empty() && ticks > 0) return legged_figure(scenario, r, summary, legs);
  const std::size_t joint = summary.most_loaded;
  FigureInput input;
  input.title = scenario.name;
  input.ground = scenario.ground.kind == Ground::Kind::plane || scenario.ground.kind == Ground::Kind::boxes;
  input.solids = solids(scenario, r);
  if (!scenario.robot->joints.empty()) {
    input.time = times(scenario, r, summary);
    add_joint(input, scenario, r, joint);
  }
  const auto second = static_cast<std::size_t>(std::max<std::int64_t>(1, whole(1.0, scenario.trace.period)));
  for (std::size_t back = kViews; back-- > 0;) {
    if (ticks > back * second) input.views.push_back(view_at(scenario, r, ticks - 1 - back * second, joint));
  }
  return figure_svg(input);
}

}  // namespace gaitlab::report
