#include "report/run_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "report/figure.h"
#include "report/motors.h"

namespace gaitlab::report {

namespace {

constexpr double kUpright = 0.7;   // least |z| of an axis that turns within the ground plane
constexpr double kWay = 0.02;      // m: a shorter way has no direction
constexpr double kOffX = 0.26;     // |y| of a direction: within 15 degrees of x it counts as x
constexpr double kAlongY = 0.035;  // 1 - |y|: within 15 degrees of y it counts as y

/// How the robot is looked at: from the side of its way, or from above where it moves within the ground plane.
struct Sight {
  Camera camera;
  std::string view = "side view";
  std::string axis = "x (m)";  ///< what goes to the right
  bool above = false;
  [[nodiscard]] const char* scale() const { return above ? "both ways on one scale" : "heights on the same scale"; }
};

/// The main direction of points in the plane: of the first axis of their scatter, forwards along the way.
double main_direction(const Series& x, const Series& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0;
  double my = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mx += x[k] / n;
    my += y[k] / n;
  }
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mx) * (x[k] - mx);
    xy += (x[k] - mx) * (y[k] - my);
    yy += (y[k] - my) * (y[k] - my);
  }
  const double angle = 0.5 * math::atan2(2 * xy, xx - yy);
  const double forward = (x.back() - x.front()) * math::cos(angle) + (y.back() - y.front()) * math::sin(angle);
  return forward < 0 ? angle + std::numbers::pi : angle;
}

/// Most joints turn about the vertical: what happens is seen from above.
bool moves_in_plane(const Robot& robot, const Kinematics& k) {
  std::size_t upright = 0;
  for (const Joint& joint : robot.joints)
    upright += std::abs((k.R[joint.link] * robot.links[joint.link].axis).z()) > kUpright ? 1 : 0;
  return 2 * upright > robot.joints.size();
}

Sight sight(const Scenario& scenario, const Recording& r) {
  Sight s;
  const Robot& robot = *scenario.robot;
  const Series x = r.series("com.x");
  const Series y = r.series("com.y");
  if (x.empty() || y.empty() || !r.has_states(robot)) return s;
  Kinematics k(robot);
  k.update(robot, r.state(robot, r.rows() - 1));
  if (const double way = std::hypot(x.back() - x.front(), y.back() - y.front()); way > kWay) {
    const double angle = main_direction(x, y);
    const Vec3 along(math::cos(angle), math::sin(angle), 0);
    // Near the world's x the picture is of world coordinates, forwards or backwards.
    if (std::abs(along.y()) > kOffX) {
      s.camera = {along, Vec3::UnitZ(), Vec3(-along.y(), along.x(), 0)};
      const double degrees = std::remainder(angle, 2 * std::numbers::pi) * 180 / std::numbers::pi;
      s.axis = fmt::format("along the way (m), {:.0f} degrees from x", degrees);
      if (std::abs(std::abs(along.y()) - 1) < kAlongY) {
        s.camera = {Vec3(0, along.y() > 0 ? 1 : -1, 0), Vec3::UnitZ(), Vec3(along.y() > 0 ? -1 : 1, 0, 0)};
        s.axis = along.y() > 0 ? "y (m)" : "-y (m)";
      }
    }
  }
  if (moves_in_plane(robot, k)) {
    s.camera = {s.camera.right, s.camera.away, -Vec3::UnitZ()};
    s.view = "view from above";
    s.above = true;
  }
  return s;
}

View view_at(const Scenario& scenario, const Recording& r, const Sight& from, std::size_t tick, std::size_t joint) {
  const Robot& robot = *scenario.robot;
  Kinematics k(robot);
  k.update(robot, r.state(robot, tick));
  View view{static_cast<double>(tick) * scenario.trace.period, side_view(robot, k, from.camera)};
  for (const ContactElement& element : contact_elements(robot, scenario.contact.on)) {
    const Ground::Touch touch = scenario.ground.query(k.point(element.link, element.centre), element.radius);
    if (scenario.ground.kind != Ground::Kind::none && touch.penetration > 0) view.contacts.push_back(from.camera(touch.point));
  }
  if (!robot.joints.empty()) view.joint = from.camera(k.p[robot.joints[joint].link]);
  const Vec3 com = sums(robot, k, Vec3::Zero()).com;
  if (com.allFinite()) view.com = from.camera(com).x;
  return view;
}

// Boxes as they are; of a field the line below the robot at the end.
std::vector<Polygon> solids(const Scenario& scenario, const Recording& r, const Sight& from) {
  std::vector<Polygon> seen;
  const Ground& ground = scenario.ground;
  if (ground.kind == Ground::Kind::boxes) {
    for (const Box& box : ground.boxes) seen.push_back(box_outline({box.R, box.center}, box.size, from.camera));
  } else if (ground.kind == Ground::Kind::heightfield && r.rows() > 0 && !from.above) {
    constexpr int kPieces = 400;
    constexpr double kThick = 0.004;  // m
    constexpr double kFar = 1000;     // m, beyond the border, where the heights go on
    const Heightfield& field = ground.field;
    const Vec3 robot(r.series("base.x").back(), r.series("base.y").back(), 0);
    const Vec3& right = from.camera.right;
    const Vec3 base = robot - right.dot(robot) * right;  // on the line below the robot, where the picture has 0
    const double width = field.spacing * static_cast<double>(std::max(field.columns, field.rows()) - 1);
    const Vec3 middle =
        field.origin +
        0.5 * field.spacing * Vec3(static_cast<double>(field.columns - 1), static_cast<double>(field.rows() - 1), 0);
    const double start = right.dot(middle) - 0.75 * width;  // 1.5 times the longer side: the diagonal, too
    const auto height = [&](double at) { return field.at(base.x() + at * right.x(), base.y() + at * right.y()).z; };
    Polygon line{{start - kFar, height(start)}};
    for (int i = 0; i <= kPieces; ++i) {
      const double at = start + i * 1.5 * width / kPieces;
      line.push_back({at, height(at)});
    }
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
constexpr double kShown = 8;          // s, of the upper panels
constexpr double kLongest = 4;        // s, of the side views: a period may have been found as a multiple of the gait's
constexpr double kPeriodless = 2;     // s, of the side views without a limit cycle
constexpr double kStands = 0.02;      // of the weight
constexpr double kLeastAngle = 0.02;  // rad, the angle axis of a joint at rest
constexpr double kAboutY = 0.9;       // least |y| of an axis
constexpr double kSamePlace = 1e-3;   // m

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

JointPanel joint_panel(const Scenario& scenario, const Recording& r, const Summary& summary, std::size_t joint) {
  JointPanel panel;
  panel.joint = std::to_string(joint) + " (" + scenario.robot->joints[joint].name + ")";
  panel.angle = r.joint(joint, "angle").values();
  if (scenario.actuator.entry != nullptr) {
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
  input.views_axis = from.axis + ", " + from.scale();
  const double ahead = from.camera.right.dot(r.state(*scenario.robot, r.rows() - 1).orientation * Vec3::UnitX());
  if (std::abs(ahead) < 0.7) return;  // seen from the front rather than from the side
  input.views_axis = fmt::format("{}, forward is {}; {}", from.axis, ahead > 0 ? "right" : "left", from.scale());
}

struct Drawn {
  std::size_t joint = 0;
  std::string what = {};
  double least_angle = 0;  ///< rad
};

/// Those of the figure's key; without it the most loaded joint, and of a robot on legs the middle of the spine.
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
  FigureInput input;
  input.title = scenario.name;
  const std::size_t pointed = drawn.empty() ? 0 : drawn.front().joint;
  const std::string arrow = drawn.empty() ? "" : fmt::format(" (arrow: {})", scenario.robot->joints[pointed].name);
  const Ground::Kind ground = scenario.ground.kind;
  input.ground = !from.above && (ground == Ground::Kind::plane || ground == Ground::Kind::boxes);
  input.solids = solids(scenario, r, from);
  input.views_title = from.view + arrow;
  input.views_axis = from.axis + ", " + from.scale();
  if (!drawn.empty()) input.time = times(scenario, r, summary);
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
  const auto second = static_cast<std::size_t>(std::max<std::int64_t>(1, whole(1.0, scenario.trace.period)));
  for (std::size_t back = kViews; back-- > 0;) {
    if (r.rows() > back * second) input.views.push_back(view_at(scenario, r, from, r.rows() - 1 - back * second, pointed));
  }
  return figure_svg(input);
}

}  // namespace gaitlab::report
