// Random scenarios with random robots: released in free space without motors, or with motors on a ground. Start poses and start
// speeds are random.
#pragma once
#include "controllers/pid.h"
#include "core/simulation/start.h"
#include "tests/program/fixture.h"
#include "tests/random_robots.h"

namespace gaitlab::test {

/// Random robot without motors in free space. `still` is a factor of the speeds at the start.
inline Scenario random_scenario(RandomRobots& random, Base base, double still = 1) {
  Robot robot = random.robot();
  for (Joint& joint : robot.joints) {  // no joint reaches a stop
    joint.lo = -100;
    joint.hi = 100;
  }
  const RobotState state = random.state(robot, base);
  Scenario s;
  s.file = s.name = "random";
  s.base = base;
  s.robot = std::make_shared<const Robot>(std::move(robot));
  s.ground.shape = NoGround{};
  s.contact.on = ContactSet::none;
  s.on_ground = false;
  s.position = state.position;
  s.orientation = to_rpy(state.orientation.toRotationMatrix());
  s.initial.angles.each = state.q;
  s.initial.speeds.each = state.qd;
  for (double& speed : s.initial.speeds.each) speed *= still;
  s.initial.base_velocity = still * state.velocity;
  s.initial.base_angular_velocity = still * state.angular_velocity;
  s.physics.engine = catalog().engine("bullet");
  s.physics.integrator = &s.physics.engine->fixed();
  s.physics.gravity = random.vector(10);
  s.physics.step = 1e-3;
  return s;
}

/// Adds random motors, and a PID controller that holds the initial angles.
inline void add_motors(RandomRobots& random, Scenario& s) {
  s.actuator.entry = catalog().find(Kind::actuator, "dc_motor");
  s.actuator.settings = std::make_shared<actuators::DcMotorActuator::Settings>(random.motors(s.robot->joints.size()));
  auto pid = std::make_shared<controllers::Pid::Settings>();
  pid->Kp.common = random.scaled(10, 1000);
  pid->Ki.common = random.scaled(0.1, 100);
  pid->Kd.common = random.below(2) == 0 ? 0 : random.scaled(0.1, 1);
  s.controller = {catalog().find(Kind::controller, "pid"), pid};
}

/// Random robot on or slightly above a random ground (a plane, with or without boxes), with random motors, and with hinge stops
/// near its initial angles. The run has `ticks` control and trace ticks of ten steps each. The step is at most 0.1 ms and, for
/// the largest decay rate lambda of the run, at most 2 share / lambda. It resolves the oscillation of a light body on a stop's
/// spring (50 N m/rad, 2e-5 kg m^2, 1600 rad/s).
inline Scenario random_run(RandomRobots& random, Base base, int ticks, double share) {
  constexpr int kTickSteps = 10;
  Scenario s = random_scenario(random, base);
  add_motors(random, s);
  Robot robot = *s.robot;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    robot.joints[j].lo = s.initial.angles[j] - random.scaled(0.003, 1);
    robot.joints[j].hi = s.initial.angles[j] + random.scaled(0.003, 1);
  }
  s.robot = std::make_shared<const Robot>(std::move(robot));
  s.physics.gravity = random.vector(5) + Vec3(0, 0, -10);
  s.contact.on = ContactSet::all;
  s.contact.penalty = random.contact();
  if (base != Base::fixed) s.initial.base_velocity.z() = -random.uniform(0.1, 0.5);
  const bool with_boxes = random.below(2) != 0;
  s.ground.friction = random.friction();
  std::vector<Box> boxes;
  for (int i = 0; with_boxes && i < 5; ++i) {
    Box box;
    box.center = s.position + random.vector(0.3);
    box.center.z() = random.uniform(0, 0.05);
    box.size = {random.uniform(0.1, 0.4), random.uniform(0.1, 0.4), 0.1};
    box.rpy = random.vector(0.2);
    box.R = rpy(box.rpy);
    box.friction = random.friction();
    boxes.push_back(box);
  }
  if (with_boxes) s.ground.shape = Boxes(std::move(boxes));
  s.on_ground = true;
  s.position = start_state(s).position;
  s.on_ground = false;
  s.position.z() += random.uniform(-2e-3, 2e-3);  // otherwise rounding errors decide whether the lowest point touches
  const auto set_step = [&](double h) {
    s.physics.step = h;
    s.control_period = s.cpg_step = s.trace.period = kTickSteps * h;
    s.duration = ticks * s.trace.period;
  };
  set_step(1e-9);
  set_step(std::min(1e-4, share / Simulation({&s, 1}).standing().rate));
  for (;;) {  // shortens the step until it suits the largest rate of the whole run
    s.trace.columns = {"t"};
    const double rate = run(s).worst.rate;
    if (s.physics.step * rate <= 2 * share) break;
    set_step(share / rate);
  }
  // All columns except the residual of the ledger, which is a small difference of large numbers.
  s.trace.columns = {"joint.*", "base.*", "com.*", "contact.*", "body.*", "reaction.*", "momentum.*", "angular_momentum.*"};
  for (const char* energy :
       {"kinetic", "potential", "electrical", "copper", "gear", "stored", "contact", "friction", "stops"}) {
    s.trace.columns.push_back(std::string("energy.") + energy);
  }
  return s;
}

}  // namespace gaitlab::test
