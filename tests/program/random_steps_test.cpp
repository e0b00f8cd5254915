// Every implicit step ends with torques of motors and stops that satisfy their laws at the speeds at the end of the step. The
// robots are random, with tight limits, stiff contacts and stops, and long steps. The test computes the laws independently.
#include "core/laws/hinge_stop.h"
#include "core/plugin/plugin_instance.h"
#include "core/simulation/plant.h"
#include "tests/labels.h"
#include "tests/program/random_scenario.h"

namespace gaitlab::test {
namespace {

// Steps of hundreds of random robots.
const Label kEveryMotor("RandomSteps.EndOnTheLawOfEveryMotor", "long;unsanitized");

/// Random scenario with low motor limits, stiff ground and long steps.
Scenario at_limits(RandomRobots& random) {
  const std::array bases{Base::floating, Base::fixed, Base::planar};
  Scenario s = random_run(random, bases[random.below(3)], 1, 1);
  auto motors = std::make_shared<actuators::DcMotorActuator::Settings>(
      *static_cast<const actuators::DcMotorActuator::Settings*>(s.actuator.settings.get()));
  for (double& limit : motors->i_max.each) limit = random.scaled(0.02, 0.5);
  for (double& supply : motors->u_max.each) supply = random.uniform(2, 24);
  s.actuator.settings = motors;
  const double stiffer = random.scaled(1, 300);
  s.contact.penalty.kn *= stiffer;
  s.contact.penalty.cd *= stiffer * random.scaled(0.1, 10);
  s.physics.engine = catalog().engine("articulated");
  s.physics.step = random.scaled(5e-4, 7.5e-3);
  return s;
}

struct Rollout {
  std::unique_ptr<Actuator> actuator;
  std::unique_ptr<Plant> plant;
  std::vector<double> state, history;
};

Rollout start(const Scenario& s, const char* integrator) {
  Rollout r;
  r.actuator = make_actuator(s.actuator, info(*s.robot));
  PlantSettings settings;
  static_cast<LaneSettings&>(settings) = {
      s.robot, s.physics.gravity, s.ground, contact_elements(*s.robot, s.contact.on), s.contact.penalty, 0.01};
  settings.base = s.base;
  settings.actuator = r.actuator.get();
  settings.integrator = integrator;
  r.plant = s.physics.engine->make(settings);
  const StateLayout layout{s.robot->joints.size(), 1, joints_with_play(*s.robot).size()};
  r.state.resize(layout.size());
  layout.write(start_state(s), 0, r.state);
  r.history.resize(r.plant->history());
  r.plant->bind(r.state, r.history);
  return r;
}

/// Torque of a stop for a step of h from the angle q that ends with the speed qd. Spring and damper act at the end of the step
/// and only push. If the step starts within the range, the damper acts on the depth divided by h.
double stop(const Joint& joint, double q, double qd, double h) {
  const bool up = q > (joint.lo + joint.hi) / 2;
  const double excess = q - (up ? joint.hi : joint.lo);
  const bool within = q <= joint.hi && q >= joint.lo;
  const double end = excess + h * qd;
  const double torque = -HingeStop::kStiffness * end - HingeStop::kDamping * (within ? end / h : qd);
  return up ? std::min(torque, 0.0) : std::max(torque, 0.0);
}

TEST(RandomSteps, EndOnTheLawOfEveryStop) {
  int pushed = 0;
  int let_go = 0;
  for (std::uint32_t seed = 1; seed <= 120; ++seed) {
    RandomRobots random(seed);
    const Scenario s = at_limits(random);
    Rollout r = start(s, "implicit");
    const std::size_t joints = s.robot->joints.size();
    const StateLayout layout{joints, 1};
    const double h = s.physics.step;
    std::vector<double> command(joints);
    for (int k = 0; k < 40; ++k) {
      if (k % 4 == 0) {
        for (std::size_t j = 0; j < joints; ++j) command[j] = random.uniform(-1, 1) * r.actuator->command_limit()[j];
      }
      const std::vector<double> before = r.state;
      r.plant->advance(command, h);
      const StepEffort applied = r.plant->applied();
      if (applied.parts.size() != 2) continue;  // the step was divided, and the angles in between are not known
      double work = 0;
      double scale = 0;
      for (std::size_t j = 0; j < joints; ++j) {
        const double q = before[layout.angles() + j];
        const double mean = (before[layout.speeds() + j] + r.state[layout.speeds() + j]) / 2;
        const double torque = stop(s.robot->joints[j], q, r.state[layout.speeds() + j], h);
        work -= h * torque * mean;
        // The tolerance is 1e-9 N m, or the rounding error of a speed times k h + c.
        scale += h * std::abs(mean) * (1e-9 + 1e-12 * std::abs(torque));
        pushed += torque != 0;
        let_go += torque == 0 && (q > s.robot->joints[j].hi || q < s.robot->joints[j].lo);
      }
      EXPECT_NEAR(applied.stops[0], work, scale) << "seed " << seed << ", step " << k;
    }
  }
  EXPECT_GT(pushed, 1000);
  EXPECT_GT(let_go, 10);
}

TEST(RandomSteps, EndOnTheLawOfEveryMotor) {
  constexpr int kSteps = 40;
  int limited = 0;
  int changed = 0;
  StepTally tally;
  for (const char* integrator : {"implicit", "extrapolated", "adaptive"}) {
    double worst = 0;
    for (std::uint32_t seed = 1; seed <= 120; ++seed) {
      RandomRobots random(seed);
      const Scenario s = at_limits(random);
      Rollout r = start(s, integrator);
      const std::size_t joints = s.robot->joints.size();
      std::vector<double> command(joints), torque(joints), slope(joints), most(joints), before(joints);
      const std::vector<double> still(joints, 0.0);
      const In limit = r.actuator->command_limit();
      r.actuator->effort(limit, still, most, slope);
      for (int k = 0; k < kSteps; ++k) {
        if (k % 4 == 0) {
          for (std::size_t j = 0; j < joints; ++j) command[j] = random.uniform(-1, 1) * limit[j];
        }
        r.plant->advance(command, s.physics.step);
        for (const StepEffort::Part& part : r.plant->applied().parts) {
          if (part.instant || (part.sum[0] == 0 && part.share[0] == 0)) continue;  // rejected part of the step
          r.actuator->effort(command, part.speed, torque, slope);
          for (std::size_t j = 0; j < joints; ++j) {
            worst = std::max(worst, std::abs(part.torque[j] - torque[j]) / most[j]);
            limited += slope[j] == 0;
            changed += slope[j] != before[j];
          }
          before = slope;
        }
        // The rollout ends if the state is NaN or very large. A long step across an impact may cause this without violating a
        // law.
        if (!std::all_of(r.state.begin(), r.state.end(), [](double x) { return std::abs(x) < 1e4; })) break;
      }
      r.plant->tally(0, tally);
      EXPECT_EQ(tally.off, 0) << integrator << ", seed " << seed;
    }
    // The search for the end of a step has a tolerance of 1e-9, or of a thousandth of the accuracy of 1 %. Rounding the speed
    // at the end of the step adds 1e-13 at a back-EMF of 1e3 N m s/rad.
    EXPECT_LE(worst, (integrator == std::string("adaptive") ? 1e-5 : 1e-9) * (1 + 1e-3)) << integrator;
  }
  EXPECT_GT(limited, 1000);
  EXPECT_GT(changed, 1000);
}

/// A motor in its play that breaks away at rest leaves the torques of the others as they are. Both motors stick in the step.
TEST(GearsAtRest, BreakAwayBesideOthers) {
  const Scenario s = scenario(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 2]
  modules:
    gaitlab_module: 1
    name: arm
    bodies:
      support: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}
      upper: {mass: 1, com: [0, 0, -0.5], inertia: [0.1, 0.1, 1e-3, 0, 0, 0]}
      lower: {mass: 1, com: [0, 0, -0.5], inertia: [0.1, 0.1, 1e-3, 0, 0, 0]}
    hinges:
      - {name: hip, parent: support, child: upper, axis: [0, 1, 0], range: free, play: 0.02}
      - {name: knee, parent: upper, child: lower, origin: [0, 0, -1], axis: [0, 1, 0], range: free, play: 0.02}
ground: {type: none}
contact: {on: none}
initial: {angles: 0.3}
actuator: {type: servo, voltage: 6, stall_torque: 60, no_load_speed: 6, load_friction: 0, dry_friction: 20, viscous_friction: 0, rotor_inertia: 0.04}
physics: {engine: articulated}
duration: 1
)");
  Rollout r = start(s, "adaptive");
  const std::vector<double> rest(2, 0.0);
  for (int i = 0; i < 400; ++i) r.plant->advance(rest, 0.005);
  const auto at_rest = [&](const std::vector<double>& volts) {
    std::vector<double> torque(2, 0.0);
    EXPECT_TRUE(r.plant->add_friction(volts, 0, torque));
    return torque;
  };
  const std::vector<double> held = at_rest(rest);
  const std::vector<double> pushed = at_rest({6, 0});
  for (const double torque : held) EXPECT_LT(std::abs(torque), 20);
  EXPECT_NEAR(pushed[0], 60 - 20, 1e-12) << "the whole torque of the motor less its friction";
  EXPECT_EQ(pushed[1], held[1]);
}

}  // namespace
}  // namespace gaitlab::test
