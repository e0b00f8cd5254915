// A scenario around a random robot: no ground, no contact, no motor; where it starts and how fast is random, too.
#pragma once
#include "fixture.h"
#include "tests/random_robots.h"

namespace gaitlab::test {

/// `still`: the fraction of RandomRobots' speeds it starts with.
inline Scenario random_scenario(RandomRobots& random, Base base, double still = 1) {
  Robot robot = random.robot();
  for (Joint& joint : robot.joints) {  // nothing reaches a stop
    joint.lo = -100;
    joint.hi = 100;
  }
  const RobotState state = random.state(robot, base);
  Scenario s;
  s.file = s.name = "random";
  s.base = base;
  s.robot = std::make_shared<const Robot>(std::move(robot));
  s.ground.kind = Ground::Kind::none;
  s.contact.on = static_cast<int>(ContactSet::none);
  s.on_ground = false;
  s.position = state.position;
  s.orientation = to_rpy(state.orientation.toRotationMatrix());
  s.initial.angles.each = state.q;
  s.initial.speeds.each = state.qd;
  for (double& speed : s.initial.speeds.each) speed *= still;
  s.initial.base_velocity = still * state.velocity;
  s.initial.base_angular_velocity = still * state.angular_velocity;
  s.physics.engine = catalog().engine("bullet");
  s.physics.gravity = random.vector(10);
  s.physics.step = 1e-3;
  return s;
}

}  // namespace gaitlab::test
