// In every number of lanes, a rollout has the same bits as alone. The other lanes contain other parameters, other robots with
// the same structure, motors at their limits, or NaN.
#include <gtest/gtest.h>

#include <bit>

#include "actuators/dc_motor.h"
#include "core/simulation/plant.h"
#include "physics_articulated/engine.h"
#include "tests/random_robots.h"

namespace gaitlab::test {
namespace {

std::string method_name(const testing::TestParamInfo<std::string>& method) { return method.param; }

class Lanes : public testing::TestWithParam<std::string> {
 protected:
  Lanes() { register_articulated(catalog_); }
  [[nodiscard]] const Engine& engine() const { return *catalog_.engine("articulated"); }

 private:
  Catalog catalog_;
};
INSTANTIATE_TEST_SUITE_P(Of, Lanes, testing::Values("adaptive", "implicit", "extrapolated", "rk4"), method_name);

/// Settings, state and commands of one lane.
struct Lane {
  LaneSettings settings;
  actuators::DcMotorActuator::Settings motors;
  std::vector<double> numbers, history, command;
};

/// Sums over the parts of a step, as the ledger and the statistics compute them.
struct EffortSums {
  std::vector<double> work, torque;  ///< one element per joint
  double share = 0;
};

EffortSums sums(const StepEffort& applied, std::size_t joints, std::size_t lane, std::size_t lanes) {
  EffortSums all{std::vector<double>(joints), std::vector<double>(joints)};
  for (const StepEffort::Part& part : applied.parts) {
    if (part.instant) continue;
    for (std::size_t j = 0; j < joints; ++j) {
      const std::size_t i = j * lanes + lane;
      all.work[j] += part.sum[lane] * part.torque[i] * part.speed[i];
      all.torque[j] += part.share[lane] * part.torque[i];
    }
    all.share += part.share[lane];
  }
  return all;
}

/// Lane with a robot like `first`, but with other masses and lengths. The index selects the kind of its settings.
Lane lane(RandomRobots& random, const Robot& first, Base base, std::size_t index) {
  Lane one;
  auto robot = std::make_shared<Robot>(first);
  for (Link& link : robot->links) {
    const double scale = random.uniform(0.8, 1.25);
    link.mass *= scale;
    link.inertia *= scale;
    link.in_parent.p *= random.uniform(0.9, 1.1);
  }
  one.settings.robot = robot;
  one.settings.gravity = random.vector(10);
  one.settings.contacts = contact_elements(*robot, ContactSet::all);
  for (std::size_t l = 0; l < robot->links.size(); ++l) {  // adds contact elements, which random types may lack
    ContactElement element;
    element.link = l;
    element.radius = random.uniform(0.02, 0.07);
    one.settings.contacts.push_back(element);
  }
  one.settings.ground.friction = random.friction();
  one.settings.law = random.contact();
  one.settings.accuracy = random.scaled(1e-3, 3e-2);
  one.motors = random.motors(robot->joints.size());
  RobotState state = random.state(*robot, base);
  state.position.z() = index % 3 == 2 ? 0.1 : -0.005;  // in the air, or slightly inside the ground
  const StateLayout alone{robot->joints.size(), 1};
  one.numbers.resize(alone.size());
  alone.write(state, 0, one.numbers);
  for (std::size_t j = 0; j < robot->joints.size(); ++j) one.command.push_back(random.uniform(-8, 8));
  return one;
}

const std::string kExplicit = "rk4";

/// Largest decay rate lambda at the start, 1/s.
double rate(const Engine& engine, const Lane& lane, Base base) {
  PlantSettings settings;
  static_cast<LaneSettings&>(settings) = lane.settings;
  settings.base = base;
  const actuators::DcMotorActuator motors(info(*lane.settings.robot), {&lane.motors});
  settings.actuator = &motors;
  settings.integrator = kExplicit;
  const std::unique_ptr<Plant> plant = engine.make(settings);
  std::vector<double> numbers = lane.numbers;
  plant->bind(numbers, {});
  return plant->stability(0, lane.command, false).rate;
}

/// Compares the states at the eighths of the last step of a lane in a pack with those of its rollout alone, which went from
/// `before` to `after` in a step h, and their positions with the cubic through both ends (half an eighth of the way: impacts).
/// Returns the number of eighths that have a state.
int compare_within(const Plant& pack, std::size_t lane, std::size_t lanes, const Plant& alone,
                   const std::vector<double>& before, const std::vector<double>& after, double h) {
  int found = 0;
  for (std::size_t eighth = 1; eighth < kEighths; ++eighth) {
    std::vector<double> beside(after.size() * lanes);
    std::vector<double> own(after.size());
    const bool has = alone.state_within(0, eighth, own);
    EXPECT_EQ(pack.state_within(lane, eighth, beside), has) << "eighth " << eighth;
    if (!has) continue;
    ++found;
    for (std::size_t e = 0; e < own.size(); ++e) EXPECT_EQ(beside[e * lanes + lane], own[e]) << "eighth " << eighth;
    const double s = static_cast<double>(eighth) / kEighths;
    for (std::size_t e = 0; e < 3; ++e) {
      const double way = after[e] - before[e];
      const double first = h * before[StateLayout::kVelocity + e];
      const double last = h * after[StateLayout::kVelocity + e];
      const double cubic = way * s * s * (3 - 2 * s) + first * s * (1 - s) * (1 - s) - last * s * s * (1 - s);
      EXPECT_NEAR(own[e] - before[e], cubic, 0.0625 * std::abs(way) + 1e-6) << "eighth " << eighth;
    }
  }
  return found;
}

// Every rollout has the same bits alone and in any lane of every number of lanes. The test takes 5 s of CPU time for
// `adaptive`.
TEST_P(Lanes, GiveEveryRolloutTheBitsItHasAlone) {
  if (engine().lanes.size() < 2) GTEST_SKIP() << "this processor has neither AVX2 nor AVX-512";
  constexpr int kSteps = 60;
  RandomRobots random(41);
  double rubbed = 0;  // friction energy of all lanes, J
  int within = 0;     // states at eighths of divided steps
  for (const std::size_t width : engine().lanes) {
    for (int i = 0; i < 4; ++i) {
      const Robot first = random.robot_of(4);
      const std::size_t n = first.joints.size();
      const Base base = std::array{Base::floating, Base::fixed, Base::planar, Base::floating}[static_cast<std::size_t>(i)];
      std::vector<Lane> lanes;
      double fastest = 0;
      for (std::size_t l = 0; l < width; ++l) {
        lanes.push_back(lane(random, first, base, l));
        if (i == 3) {  // grounds of every kind in one lane group
          const Boxes box{Box{.center = {0.1, 0, 0}, .size = {0.4, 0.4, 0.02}, .friction = 0.4}};
          lanes[l].settings.ground.shape = std::array<Ground::Shape, 3>{NoGround{}, box, Plane{}}[l % 3];
        }
        fastest = std::max(fastest, rate(engine(), lanes[l], base));
      }
      // The step of an explicit method is far below 1 / lambda, also if a contact becomes ten times as deep.
      const double h = GetParam() == kExplicit ? std::min(1e-6, 0.05 / fastest) : random.scaled(1e-4, 2e-3);
      if (width > 1) lanes[1].numbers[StateLayout::kVelocity] = std::numeric_limits<double>::infinity();  // diverged

      const StateLayout beside{n, width};
      std::vector<double> numbers(beside.size());
      std::vector<double> commands(width * n);
      std::vector<const actuators::DcMotorActuator::Settings*> motors;
      PlantSettings together;
      together.integrator = GetParam();
      together.base = base;
      for (std::size_t l = 0; l < width; ++l) {
        for (std::size_t e = 0; e < lanes[l].numbers.size(); ++e) numbers[e * width + l] = lanes[l].numbers[e];
        for (std::size_t j = 0; j < n; ++j) commands[j * width + l] = lanes[l].command[j];
        motors.push_back(&lanes[l].motors);
        (l == 0 ? static_cast<LaneSettings&>(together) : together.others.emplace_back()) = lanes[l].settings;
      }
      const actuators::DcMotorActuator all(info(first), motors);
      together.actuator = &all;
      const std::unique_ptr<Plant> pack = engine().make(together);
      std::vector<double> history(pack->history());
      pack->bind(numbers, history);
      for (int step = 0; step < kSteps; ++step) pack->advance(commands, h);

      for (std::size_t l = 0; l < width; ++l) {
        if (width > 1 && l == 1) continue;
        PlantSettings own;
        static_cast<LaneSettings&>(own) = lanes[l].settings;
        own.integrator = GetParam();
        own.base = base;
        const actuators::DcMotorActuator motor(info(first), {&lanes[l].motors});
        own.actuator = &motor;
        const std::unique_ptr<Plant> alone = engine().make(own);
        lanes[l].history.resize(alone->history());
        alone->bind(lanes[l].numbers, lanes[l].history);
        std::vector<double> before;
        for (int step = 0; step < kSteps; ++step) {
          before = lanes[l].numbers;
          alone->advance(lanes[l].command, h);
        }
        within += compare_within(*pack, l, width, *alone, before, lanes[l].numbers, h);
        for (std::size_t e = 0; e < lanes[l].numbers.size(); ++e) {
          EXPECT_EQ(std::bit_cast<std::uint64_t>(numbers[e * width + l]), std::bit_cast<std::uint64_t>(lanes[l].numbers[e]))
              << width << " lanes, robot " << i << ", lane " << l << ", entry " << e;
          EXPECT_LT(std::abs(lanes[l].numbers[e]), 1e5);
        }
        const StepEffort a = pack->applied();
        const StepEffort b = alone->applied();
        for (std::size_t e = 0; e < lanes[l].history.size(); ++e) EXPECT_EQ(history[e * width + l], lanes[l].history[e]);
        const EffortSums beside_others = sums(a, n, l, width);
        const EffortSums by_itself = sums(b, n, 0, 1);
        EXPECT_EQ(beside_others.work, by_itself.work);
        EXPECT_EQ(beside_others.torque, by_itself.torque);
        EXPECT_EQ(beside_others.share, by_itself.share);
        EXPECT_EQ(a.contact[l], b.contact[0]);
        EXPECT_EQ(a.friction[l], b.friction[0]);
        EXPECT_EQ(a.stops[l], b.stops[0]);
        rubbed += b.friction[0];
      }
    }
  }
  EXPECT_EQ(within > 0, GetParam() == "adaptive");
  EXPECT_GT(rubbed, 0);
}

}  // namespace
}  // namespace gaitlab::test
