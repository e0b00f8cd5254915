#include "report/run_figure.h"

#include <algorithm>

#include "report/figure.h"

namespace gaitlab {

namespace {

std::vector<double> series(const std::vector<double>& values, std::size_t columns, std::size_t column) {
  std::vector<double> out;
  for (std::size_t at = column; at < values.size(); at += columns) out.push_back(values[at]);
  return out;
}

RobotState state_at(const Robot& robot, const RunRecord& r, std::size_t tick) {
  const double* p = r.poses.data() + 7 * tick;
  const std::size_t n = robot.joints.size();
  RobotState s;
  s.position = Vec3(p[0], p[1], p[2]);
  s.orientation = Quat(p[3], p[4], p[5], p[6]);
  s.q.assign(r.angles.begin() + static_cast<std::ptrdiff_t>(tick * n),
             r.angles.begin() + static_cast<std::ptrdiff_t>((tick + 1) * n));
  s.qd.assign(n, 0.0);
  return s;
}

View view_at(const Scenario& scenario, const RunRecord& r, std::size_t tick, std::size_t joint) {
  const Robot& robot = *scenario.robot;
  Kinematics k(robot);
  k.update(robot, state_at(robot, r, tick));
  View view{static_cast<double>(tick) * scenario.trace.period, side_view(robot, k)};
  for (const ContactElement& element : contact_elements(robot, static_cast<ContactSet>(scenario.contact.on))) {
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

}  // namespace

std::string run_figure(const Scenario& scenario, const RunRecord& r, const Summary& summary) {
  constexpr std::size_t kViews = 5;
  const std::size_t n = scenario.robot->joints.size();
  const std::size_t joint = summary.most_loaded;
  FigureInput input;
  input.title = scenario.name;
  input.ground = scenario.ground.kind != Ground::Kind::none;
  const std::size_t ticks = r.com_x.size();
  if (n > 0) {
    input.joint = std::to_string(joint) + " (" + scenario.robot->joints[joint].name + ")";
    for (std::size_t k = 0; k < ticks; ++k)
      input.time.push_back(std::min(static_cast<double>(k) * scenario.trace.period, summary.simulated));
    input.angle = series(r.angles, n, joint);
    input.setpoint = series(r.setpoints, n, joint);
    if (scenario.actuator.entry != nullptr) input.torque = series(r.torques, n, joint);
  }
  const auto second = static_cast<std::size_t>(std::max<std::int64_t>(1, whole(1.0, scenario.trace.period)));
  for (std::size_t back = kViews; back-- > 0;) {
    if (ticks > back * second) input.views.push_back(view_at(scenario, r, ticks - 1 - back * second, joint));
  }
  return figure_svg(input);
}

}  // namespace gaitlab
