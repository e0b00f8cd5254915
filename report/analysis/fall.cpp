#include "report/analysis/fall.h"

#include <algorithm>
#include <cmath>

#include "report/analysis/states.h"

namespace gaitlab::report {

std::vector<double> heights(const Scenario& scenario, const Recording& r) {
  const Robot& robot = *scenario.robot;
  const States states = States::at_ticks(r, robot);
  Kinematics k(robot);
  std::vector<double> all;
  for (std::size_t row = 0; row < states.size(); ++row) {
    k.update(robot, states(row));
    all.push_back(sums(robot, k, scenario.physics.gravity).com.z());
  }
  return all;
}

std::optional<Fall> fall(const Scenario& scenario, const Recording& r) {
  const Ground::Kind ground = scenario.ground.kind;
  if (scenario.base != Base::floating) return {};
  if (ground != Ground::Kind::plane && ground != Ground::Kind::boxes) return {};
  const std::vector<double> height = heights(scenario, r);
  if (height.empty()) return {};
  const States states = States::at_ticks(r, *scenario.robot);
  const Vec3 up = states(0).orientation.inverse() * Vec3::UnitZ();
  Fall found{.start = height[0], .lowest = height[0], .fallen_time = r.simulated};
  bool fallen = false;
  double least = 1;  // cosine of the tilt
  for (std::size_t row = 0; row < height.size(); ++row) {
    if (height[row] < found.lowest) {
      found.lowest = height[row];
      found.lowest_time = states.time(row);
    }
    if (!fallen && found.share() < scenario.limits.height) {
      fallen = true;
      found.fallen_time = states.time(row);
    }
    if (const double upright = (states(row).orientation * up).z(); upright < least) {
      least = upright;
      found.tilt_time = states.time(row);
    }
  }
  found.tilt = std::acos(std::clamp(least, -1.0, 1.0));
  return found;
}

}  // namespace gaitlab::report
