#include "core/simulation/start.h"

namespace gaitlab {

RobotState start_state(const Scenario& s) {
  const Robot& robot = *s.robot;
  RobotState start;
  start.orientation = Quat(rpy(s.orientation)).normalized();
  if (start.orientation.w() < 0) start.orientation.coeffs() *= -1;
  start.position = s.position;
  start.velocity = s.initial.base_velocity;
  start.angular_velocity = s.initial.base_angular_velocity;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    start.q.push_back(s.initial.angles[j]);
    start.qd.push_back(s.initial.speeds[j]);
  }
  if (s.on_ground && s.ground.kind != Ground::Kind::none) {
    Kinematics kinematics(robot);
    kinematics.update(robot, start);
    start.position.z() -= lowest_point(robot, kinematics, contact_elements(robot, static_cast<ContactSet>(s.contact.on)));
  }
  return start;
}

}  // namespace gaitlab
