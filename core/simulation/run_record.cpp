#include "core/simulation/simulation.h"

namespace gaitlab {

RobotState RunRecord::state(const Robot& robot, std::size_t tick) const {
  const double* p = poses.data() + 7 * tick;
  const std::size_t n = robot.joints.size();
  RobotState s;
  s.position = Vec3(p[0], p[1], p[2]);
  s.orientation = Quat(p[3], p[4], p[5], p[6]);
  s.q.assign(angles.begin() + static_cast<std::ptrdiff_t>(tick * n),
             angles.begin() + static_cast<std::ptrdiff_t>((tick + 1) * n));
  s.qd.assign(n, 0.0);
  return s;
}

Out Simulation::state() {
  if (plant_->memoryless()) return state_;
  throw InputError(scenarios_[0].place("contact.law"),
                   "contact.law: bullet gives no snapshot: its contact points and boxes are no part of the state");
}

}  // namespace gaitlab
