#include "report/analysis/start_row.h"

#include <fmt/format.h>

#include "core/simulation/start.h"

namespace gaitlab::report {

Recording start_row(const Scenario& scenario) {
  const Robot& robot = *scenario.robot;
  const RobotState start = start_state(scenario);
  Kinematics k(robot);
  k.update(robot, start);
  Recording made;
  const auto add = [&](std::string name, const char* unit, double value) {
    made.trace.columns.push_back({std::move(name), unit, ""});
    made.trace.values.push_back(value);
  };
  const auto add_point = [&](const char* of, const Vec3& p) {
    constexpr const char* kAxes[] = {"x", "y", "z"};
    for (Eigen::Index i = 0; i < 3; ++i) add(fmt::format("{}.{}", of, kAxes[i]), "m", p[i]);
  };
  add("t", "s", 0);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) add(fmt::format("joint.{}.angle", j), "rad", start.q[j]);
  add_point("base", start.position);
  add("base.qw", "", start.orientation.w());
  add("base.qx", "", start.orientation.x());
  add("base.qy", "", start.orientation.y());
  add("base.qz", "", start.orientation.z());
  add_point("com", sums(robot, k, scenario.physics.gravity).com);
  made.outcome.ended = Ended::not_run;
  return made;
}

}  // namespace gaitlab::report
