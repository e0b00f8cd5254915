#include "report/figures/run/run_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/functions.h"
#include "report/plot/ticks.h"

namespace gaitlab::report {

namespace {

constexpr double kUpright = 0.7;   // least |z| of the axis of a joint that turns within the ground plane
constexpr double kWay = 0.02;      // m; a shorter path has no direction
constexpr double kOffX = 0.26;     // |y| of a direction; within 15 degrees of x it counts as x
constexpr double kAlongY = 0.035;  // 1 - |y|; within 15 degrees of y it counts as y

/// Angle of the main direction of points in the plane: the first principal axis, oriented along the path.
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

/// True if most joints turn about the vertical. The robot is then shown from above.
bool moves_in_plane(const Robot& robot, const Kinematics& k) {
  std::size_t upright = 0;
  for (const Joint& joint : robot.joints)
    upright += std::abs((k.R[joint.link] * robot.links[joint.link].axis).z()) > kUpright ? 1 : 0;
  return 2 * upright > robot.joints.size();
}

/// Profile of a height field below the robot at the end of the run.
Polygon relief_line(const Heightfield& field, const Recording& r, const Sight& from) {
  constexpr int kPieces = 400;
  constexpr double kThick = 0.004;  // m
  constexpr double kFar = 1000;     // m, length of the profile beyond the border of the field
  const Vec3 robot(r.series("base.x").back(), r.series("base.y").back(), 0);
  const Vec3& right = from.camera.right;
  const Vec3 base = robot - right.dot(robot) * right;  // point below the robot at which the horizontal axis of the view is 0
  const double width = field.spacing * static_cast<double>(std::max(field.columns, field.rows()) - 1);
  const Vec3 middle = field.origin + 0.5 * field.spacing *
                                         Vec3(static_cast<double>(field.columns - 1), static_cast<double>(field.rows() - 1), 0);
  const double start = right.dot(middle) - 0.75 * width;  // 1.5 times the longer side also covers the diagonal
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
  return line;
}

std::vector<Polygon> solids(const Scenario& scenario, const Recording& r, const Sight& from) {
  std::vector<Polygon> seen;
  for (const Box& box : scenario.ground.boxes()) seen.push_back(box_outline({box.R, box.center}, box.size, from.camera));
  const Heightfield* relief = scenario.ground.relief();
  if (relief != nullptr && r.rows() > 0 && !from.above) seen.push_back(relief_line(*relief, r, from));
  return seen;
}

}  // namespace

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
    // Near the world's x axis the view uses world coordinates, in either direction of travel.
    if (std::abs(along.y()) > kOffX) {
      s.camera = {along, Vec3::UnitZ(), Vec3(-along.y(), along.x(), 0)};
      const double degrees = std::remainder(angle, 2 * std::numbers::pi) * 180 / std::numbers::pi;
      s.axis = fmt::format("along the way (m), {} degrees from x", with_minus(fmt::format("{:.0f}", degrees)));
      if (std::abs(std::abs(along.y()) - 1) < kAlongY) {
        s.camera = {Vec3(0, along.y() > 0 ? 1 : -1, 0), Vec3::UnitZ(), Vec3(along.y() > 0 ? -1 : 1, 0, 0)};
        s.axis = along.y() > 0 ? "y (m)" : "\u2212y (m)";
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
  View view{r.series("t")[tick], side_view(robot, k, from.camera)};
  for (const ContactElement& element : contact_elements(robot, scenario.contact.on)) {
    const Ground::Touch touch = scenario.ground.query(k.point(element.link, element.centre), element.radius);
    if (scenario.ground.exists() && touch.penetration > 0) view.contacts.push_back(from.camera(touch.point));
  }
  if (!robot.joints.empty()) view.joint = from.camera(k.p[robot.joints[joint].link]);
  const Vec3 com = sums(robot, k, Vec3::Zero()).com;
  if (com.allFinite()) view.com = from.camera(com).x;
  return view;
}

ViewsInput views_input(const Scenario& scenario, const Recording& record, const Sight& from) {
  ViewsInput input;
  input.ground = !from.above && scenario.ground.has_plane();
  input.solids = solids(scenario, record, from);
  input.axis = from.axis + ", " + from.scale();
  return input;
}

}  // namespace gaitlab::report
