#include "core/simulation/start.h"

#include <algorithm>
#include <limits>

namespace gaitlab {

namespace {

constexpr double kTouches = 1e-12;  // m
constexpr int kMostDrops = 1000;    // each drop is as long as the gap, which closes slowly beside an almost vertical edge

/// Distance that the robot can sink before its lowest element touches the ground. Negative if the robot has to rise.
double height_above(const Scenario& s, const Kinematics& k, const std::vector<ContactElement>& elements) {
  const double lowest = lowest_point(*s.robot, k, elements);
  if (s.ground.is_plane() || elements.empty()) return lowest;
  // The robot starts above all solids, so that it comes to rest on a box and not beneath one.
  double sunk = lowest - s.ground.highest();
  for (int drop = 0; drop < kMostDrops; ++drop) {
    double gap = std::numeric_limits<double>::infinity();
    for (const ContactElement& e : elements) {
      const Vec3 centre = k.point(e.link, e.centre) - sunk * Vec3::UnitZ();
      gap = std::min(gap, -s.ground.query(centre, e.radius).penetration);
    }
    sunk += gap;
    if (std::abs(gap) < kTouches) break;
  }
  return sunk;
}

RobotState start_of(const Scenario& s, bool lowered) {
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
  for (const std::size_t j : joints_with_play(robot)) {  // in the middle of the play
    start.rotor.push_back(start.q[j]);
    start.rotor_speed.push_back(start.qd[j]);
  }
  if (lowered && s.ground.exists()) {
    Kinematics kinematics(robot);
    kinematics.update(robot, start);
    start.position.z() -= height_above(s, kinematics, contact_elements(robot, s.contact.on));
  }
  return start;
}

}  // namespace

RobotState start_state(const Scenario& s) { return start_of(s, s.on_ground); }

RobotState lowered_start(const Scenario& s) { return start_of(s, true); }

}  // namespace gaitlab
