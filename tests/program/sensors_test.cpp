// Tests of sensors in a run: the values that the controller gets and the trace shows. Nothing else changes.
#include <cmath>

#include "controllers/pid.h"
#include "core/math/philox.h"
#include "core/scenario/resolved.h"
#include "tests/oracles/pendulum.h"
#include "tests/program/allocations.h"
#include "tests/program/as_alone.h"
#include "tests/program/engines.h"

namespace gaitlab::test {
namespace {

const std::string kNoisy = "sensors.e={type: encoder, resolution: 0.00511, noise: 0.0035, delay: 0.03, lost: 0.1, walk: 0.001}";
const std::string kImu =
    "sensors.head={type: imu, body: m0/active, gyro: {noise: 0.01}, accelerometer: {noise: 0.1, walk: 0.01}, "
    "tilt: {delay: [0.015, 0.06]}}";
const std::string kFeet = "sensors.feet={type: load, bodies: m3/active, noise: 0.2, period: 0.03}";
const std::string kDrives = "sensors.drives={type: motor, current: {noise: 0.01}, torque: {range: [-1, 1]}}";

Scenario sensed_caterpillar(std::vector<std::string> sets, const std::string& engine = "articulated") {
  sets.push_back("physics.engine=" + engine);
  return shipped("caterpillar.yaml", sets);
}

class SensorsOf : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Engine, SensorsOf, engines(), engine_name);

// A row shows the values in force just before it, which are those of the previous tick. The row at t = 0 has those of tick 0.
TEST_P(SensorsOf, ADelayIsExact) {
  const Recording r =
      run(sensed_caterpillar({"duration=0.6", "trace.period=0.015", "sensors={type: encoder, delay: 0.03}"}, GetParam()));
  const Table table(r.trace);
  ASSERT_EQ(r.trace.rows(), 41U);
  for (std::size_t j = 0; j < 16; ++j) {
    const std::string joint = fmt::format("joint.{}.", j);
    EXPECT_EQ(table.at(0, joint + "measured"), table.at(0, joint + "angle"));
    for (std::size_t row = 1; row < 41; ++row) {
      const std::size_t seen = row < 3 ? 0 : row - 3;
      ASSERT_EQ(table.at(row, joint + "measured"), table.at(seen, joint + "angle")) << joint << row;
      const double before = table.at(row < 4 ? 0 : row - 4, joint + "angle");
      ASSERT_EQ(table.at(row, joint + "measured_speed"), (table.at(seen, joint + "angle") - before) / 0.015) << joint << row;
    }
  }
}

TEST_P(SensorsOf, CurrentTorqueAndLoadAreThoseOfTheTrace) {
  const Recording r = run(sensed_caterpillar({"duration=0.3", "trace.period=0.015", "trace.columns=[joint.*, load.*, sensor.*]",
                                              "sensors={d: {type: motor}, f: {type: load}}"},
                                             GetParam()));
  const Table table(r.trace);
  for (std::size_t row = 1; row < r.trace.rows(); ++row) {
    for (const char* quantity : {"current", "torque"}) {
      ASSERT_EQ(table.at(row, fmt::format("joint.5.measured_{}", quantity)),
                table.at(row - 1, fmt::format("joint.5.{}", quantity)));
    }
    for (std::size_t m = 0; m < 8; ++m) {
      const double load = table.at(row - 1, fmt::format("load.{}", m));
      ASSERT_EQ(table.at(row, fmt::format("sensor.f.m{}", m)), load);
      if (load > 1 || load < 0.5) {
        ASSERT_EQ(table.at(row, fmt::format("sensor.f.m{}.touching", m)), load > 1 ? 1 : 0);
      }
    }
  }
}

TEST_P(SensorsOf, SnapshotGoesOnWithinADelay) {
  const Scenario s = sensed_caterpillar({"duration=1", kNoisy, kImu, kFeet, kDrives}, GetParam());
  const auto go = [](Simulation& simulation, int steps) {
    for (int i = 0; i < steps; ++i) simulation.step();
    return std::vector<double>(simulation.state().begin(), simulation.state().end());
  };
  Simulation first({&s, 1});
  const std::vector<double> snapshot = go(first, 40);  // 0.2 s or 1 ms, within the delays of 30 and 60 ms of each
  const std::vector<double> end = go(first, 100);
  Simulation second({&s, 1});
  std::copy(snapshot.begin(), snapshot.end(), second.state().begin());
  EXPECT_EQ(go(second, 100), end);
}

TEST_P(SensorsOf, AllocateNothingInTheSteadyState) {
  const Scenario s = sensed_caterpillar({"duration=12", kNoisy, kImu, kFeet, kDrives}, GetParam());
  Simulation simulation({&s, 1});
  for (int i = 0; i < 1000; ++i) simulation.step();
  const Allocations allocations;
  for (int i = 0; i < 1000; ++i) simulation.step();
  EXPECT_EQ(allocations.count(), 0);
}

TEST(Sensors, NoneLeavesTheSameBytes) {
  const std::vector<std::string> plain{"duration=0.45"};
  const Scenario without = sensed_caterpillar(plain);
  const Scenario none = sensed_caterpillar({"duration=0.45", "sensors={}"});
  EXPECT_EQ(resolved(none), resolved(without));
  EXPECT_EQ(alone(none), alone(without));
  const std::string encoder = "sensors={type: encoder, noise: 0.001}";
  const std::string explicit_zeros =
      "sensors={type: encoder, noise: 0.001, delay: 0, lost: 0, walk: 0, zero: 0, gain: 1, bias: 0}";
  EXPECT_EQ(alone(sensed_caterpillar({"duration=0.45", encoder})),
            alone(sensed_caterpillar({"duration=0.45", explicit_zeros})));
}

// An exact encoder gives the true angles, and the controller uses no speed, so that the motion has the same bits.
TEST(Sensors, AnExactEncoderChangesNothing) {
  const auto torques = [](const std::vector<std::string>& own) {
    std::vector<std::string> sets{"duration=0.45", "trace.columns=[joint.*.torque, joint.*.angle]"};
    sets.insert(sets.end(), own.begin(), own.end());
    const Recording r = run(sensed_caterpillar(sets));
    return hash(r.trace) + bits(r);  // the other columns have the measured angles
  };
  EXPECT_EQ(torques({"sensors={type: encoder}"}), torques({}));
  EXPECT_NE(torques({"sensors={type: encoder, delay: 0.015}"}), torques({}));
}

TEST(Sensors, ASensorMoreChangesNoOther) {
  const auto imu = [](const std::vector<std::string>& own) {
    std::vector<std::string> sets{"duration=0.45", "trace.columns=[t, sensor.head.*, joint.*.torque]", kImu};
    sets.insert(sets.end(), own.begin(), own.end());
    return hash(run(sensed_caterpillar(sets)).trace);
  };
  const std::string one = imu({});
  EXPECT_EQ(imu({kFeet}), one);
  EXPECT_EQ(imu({kFeet, kDrives}), one);
  EXPECT_EQ(imu({"sensors.a_first={type: load, noise: 3}"}), one);
  EXPECT_NE(imu({"seed=2"}), one);
}

// Noise divides steps of one lane and not of its neighbours, so that lanes of the adaptive steps are often alone.
class SensorsInLanes : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Step, SensorsInLanes, ::testing::Values("5e-4", "auto"),
                         [](const auto& step) { return step.index == 0 ? "fixed" : "adaptive"; });

TEST_P(SensorsInLanes, AreAsAlone) {
  const std::vector<std::vector<std::string>> own{{kNoisy}, {}, {kImu, kFeet}, {kNoisy, "seed=5"}, {kDrives, kNoisy}};
  const std::vector<Scenario> all = rollouts(
      kScenarios + "caterpillar.yaml",
      {"physics.engine=articulated", "physics.estimate=off", std::string("physics.step=") + GetParam(), "duration=0.3"}, own,
      catalog());
  const std::vector<std::string> expected = expect_as_alone(all, 7);
  EXPECT_NE(expected[0], expected[3]);
}

TEST(Sensors, RowsWithinAStepChangeNothing) {
  const auto with_rows = [](const std::string& period) {
    return bits(run(sensed_caterpillar({"duration=0.09", kNoisy, kImu, "trace.period=" + period})));
  };
  EXPECT_EQ(with_rows("0.0023"), with_rows("0.005"));
}

/// The program's PID with a separate encoder, which adds the noise of the joint's stream, rounds to the grid and delays by
/// `delay` ticks. It shares only the random stream with the sensor.
struct PidBehindEncoder final : Controller {
  struct Settings : controllers::Pid::Settings {
    double resolution = 0, noise = 0;
    std::int64_t delay = 0;
    void fields(Fields& f) {
      controllers::Pid::Settings::fields(f);
      f.number("resolution", resolution, {"rad", 0, 1, "A test's."});
      f.number("noise", noise, {"rad", 0, 1, "A test's."});
      f.integer("delay", delay, {"", 0, 8, "A test's."});
    }
  };
  PidBehindEncoder(const RobotInfo& robot, const Settings& s)
      : settings(s), pid(robot, static_cast<const controllers::Pid::Settings&>(s)), seen(robot.joints.size()) {
    for (const JointInfo& joint : robot.joints) streams.emplace_back(1, "e." + joint.name);
  }
  [[nodiscard]] std::string_view command_unit() const override { return "V"; }
  [[nodiscard]] std::size_t states() const override { return pid.states() + kLine * seen.size(); }
  void start(Out x) const override {
    std::fill(x.begin(), x.end(), NAN);
    pid.start(x.first(pid.states()));
  }
  void update(const Measured& m, In setpoint, In limit, Out x, Out command) const override {
    const auto tick = static_cast<std::uint64_t>(std::llround(m.t / m.period));
    for (std::size_t j = 0; j < seen.size(); ++j) {
      double a = m.angle[j];
      if (settings.noise > 0) a += settings.noise * streams[j].normal(tick, 0);
      if (settings.resolution > 0) a = settings.resolution * std::floor(a / settings.resolution + 0.5);
      const Out line = x.subspan(pid.states() + kLine * j, kLine);
      std::shift_right(line.begin(), line.end(), 1);
      line[0] = a;
      if (tick == 0) std::fill(line.begin(), line.end(), a);
      seen[j] = line[static_cast<std::size_t>(settings.delay)];
    }
    Measured own = m;
    own.angle = seen;
    pid.update(own, setpoint, limit, x, command);
  }

  static constexpr std::size_t kLine = 9;
  Settings settings;
  controllers::Pid pid;
  std::vector<math::PhiloxStream> streams;
  mutable std::vector<double> seen;  // one thread at a time
};

struct EncoderCase {
  const char* sensor;
  const char* controller;
};

TEST(Sensors, ControllerBehindTheEncoderHasTheBitsOfOneWithAnEncoderInside) {
  if (catalog().find(Kind::controller, "behind") == nullptr) add_controller<PidBehindEncoder>(catalog(), "behind", "a test's");
  const std::string columns = "trace.columns=[joint.*.torque, com.*]";
  for (const auto& [sensor, controller] :
       {EncoderCase{"resolution: 0.00511", "resolution: 0.00511"},
        {"noise: 0.0035", "noise: 0.0035"},
        {"delay: 0.03", "delay: 2"},
        {"resolution: 0.00511, noise: 0.0035, delay: 0.015", "resolution: 0.00511, noise: 0.0035, delay: 1"}}) {
    const Recording a =
        run(sensed_caterpillar({"duration=1", columns, fmt::format("sensors.e={{type: encoder, {}}}", sensor)}));
    const Recording b =
        run(sensed_caterpillar({"duration=1", columns, fmt::format("controller={{type: behind, {}}}", controller)}));
    EXPECT_EQ(hash(a.trace), hash(b.trace)) << sensor;
  }
}

/// RMS of the torques of all joints, N m.
double torque_of(const Recording& r) {
  double sum = 0;
  for (const JointStatistics& joint : r.joints) sum += joint.torque_rms * joint.torque_rms;
  return std::sqrt(sum / static_cast<double>(r.joints.size()));
}

double way_of(const Recording& r) { return r.travel().head<2>().norm(); }

/// Share of the time in which the worst motor is at its limit of voltage.
double limited(const Recording& r) {
  double share = 0;
  for (const JointStatistics& joint : r.joints) share = std::max(share, joint.saturated_voltage);
  return share;
}

// Over 20 s, encoders of this size move RMS by at most 0.9 % and travel by at most 1.3 %, and two ticks of delay bring a motor
// to its limit of voltage for 27 % of the time and raise RMS by 3 % (docs/real-robot.md). Over 4 s, the start, which all runs
// share, has a larger part in both. Twice these changes are therefore allowed.
TEST(Sensors, CaterpillarMovesTheSameAndItsTorquesDoNot) {
  const auto walk = [](const std::string& keys) {
    return run(sensed_caterpillar({"duration=4", "physics.estimate=off", fmt::format("sensors.e={{type: encoder{}}}", keys)}));
  };
  const Recording ideal = walk("");
  EXPECT_EQ(limited(ideal), 0);
  for (const char* keys : {", resolution: 0.00511", ", noise: 0.0035", ", delay: 0.015"}) {
    const Recording r = walk(keys);
    EXPECT_NEAR(torque_of(r) / torque_of(ideal), 1, 0.02) << keys;
    EXPECT_NEAR(way_of(r) / way_of(ideal), 1, 0.03) << keys;
  }
  const Recording late = walk(", delay: 0.03");
  EXPECT_GT(limited(late), 0.1);
  EXPECT_GT(torque_of(late) / torque_of(ideal), 1.01);
}

// The rollouts beside a run, which estimate its torque error, have the noise of the run. With other noise, their torques would
// differ by a third: Kp (100 V/rad) * 0.0035 rad * 2^(1/2) is 0.5 V, and R = 4.3 ohm makes 0.19 N m of it, against 0.46 N m
// RMS.
TEST(Sensors, EstimateSeesTheSameNoise) {
  for (const char* step : {"auto", "5e-4"}) {
    const Recording r =
        run(sensed_caterpillar({"duration=1", "sensors={type: encoder, noise: 0.0035}", fmt::format("physics.step={}", step)}));
    for (std::size_t j = 0; j < 16; ++j) {
      EXPECT_LT(r.tally.torque_error[j], 0.05 * r.tally.torque_peak[j]) << step << ", joint " << j;
    }
  }
}

TEST(Sensors, AccelerometerAtRestGivesGravity) {
  const std::string text = R"(
gaitlab: 1
robot: {modules: rod, base: fixed, position: [0, 0, 2], orientation: [0.3, -0.4, 1]}
ground: {type: none}
contact: {on: none}
actuator: {type: none}
physics: {engine: articulated, step: 1e-3, integrator: rk4}
duration: 0.1
sensors: {type: imu, body: m0/pivot}
)";
  const Recording r = run(scenario(text));
  const Mat3 R = rpy({0.3, -0.4, 1});
  const Vec3 expected = R.transpose() * Vec3(0, 0, 9.81);
  constexpr double kRounding = 1e-14;  // rounding error of sums of three products up to 10
  for (const double t : {0.0, 0.05, 0.1}) {
    const Table table(r.trace);
    EXPECT_NEAR(table(t, "sensor.imu.accelerometer_x"), expected.x(), kRounding);
    EXPECT_NEAR(table(t, "sensor.imu.accelerometer_y"), expected.y(), kRounding);
    EXPECT_NEAR(table(t, "sensor.imu.accelerometer_z"), expected.z(), kRounding);
    EXPECT_EQ(table(t, "sensor.imu.gyro_x"), 0);
    EXPECT_NEAR(table(t, "sensor.imu.roll"), 0.3, 1e-15);
    EXPECT_NEAR(table(t, "sensor.imu.pitch"), -0.4, 1e-15);
  }
}

// Bodies of one link move as one: an IMU at the same place gives the same vectors through each, in the axes of each.
TEST(Sensors, ImusOfFusedBodiesAgree) {
  const Scenario bare = shipped("hexapod.yaml", {"physics.engine=articulated"});
  const Robot& robot = *bare.robot;
  const auto named = [&](const std::string& name) -> const Body& {
    return *std::ranges::find_if(robot.bodies, [&](const Body& body) { return body.name == name; });
  };
  const Body& one = named("m0/passive");
  const Body* other = nullptr;  // of another module, and turned
  for (const Body& body : robot.bodies) {
    if (body.link == one.link && !body.in_link.R.isApprox(one.in_link.R)) other = &body;
  }
  ASSERT_NE(other, nullptr);
  const Vec3 place(0.03, -0.02, 0.05);
  const Vec3 in_other = other->in_link.inverse() * (one.in_link * place);
  const Recording r = run(shipped(
      "hexapod.yaml",
      {"physics.engine=articulated", "duration=0.6", "trace.columns=[sensor.*]",
       fmt::format(
           "sensors={{a: {{type: imu, body: {}, position: [{}, {}, {}]}}, b: {{type: imu, body: {}, position: [{}, {}, {}]}}}}",
           one.name, place.x(), place.y(), place.z(), other->name, in_other.x(), in_other.y(), in_other.z())}));
  const Table table(r.trace);
  const Mat3 turned = other->in_link.R.transpose() * one.in_link.R;
  double largest = 0;
  for (std::size_t row = 0; row < r.trace.rows(); ++row) {
    for (const char* const quantity : {"gyro", "accelerometer"}) {
      const auto vector = [&](const char* name) {
        const auto at = [&](const char* axis) { return table.at(row, fmt::format("sensor.{}.{}_{}", name, quantity, axis)); };
        return Vec3(at("x"), at("y"), at("z"));
      };
      EXPECT_LT((vector("b") - turned * vector("a")).norm(), 1e-9) << quantity << ", row " << row << "; difference over 15 ms";
      if (*quantity == 'g') largest = std::max(largest, vector("a").norm());
    }
  }
  EXPECT_GT(largest, 0.05) << "the body turns, so that the place matters";
}

// The tip of a rod of length 1 at the angle theta moves at theta' (-cos theta, 0, sin theta); its frame is turned by theta
// about y.
TEST(Sensors, ImuAtTheTipOfAPendulum) {
  const Recording r = run(shipped(
      "pendulum.yaml", {"duration=2", "trace.columns=[sensor.*]", "sensors={type: imu, body: m0/rod, position: [0, 0, -1]}"}));
  const oracle::Pendulum rod(std::sqrt(1.5 * 9.81), 1);
  const Table table(r.trace);
  constexpr double kTs = 0.005;  // the trace period, where there are no motors
  const auto velocity = [&](double t) {
    return Vec3(-rod.speed(t) * std::cos(rod.angle(t)), 0, rod.speed(t) * std::sin(rod.angle(t)));
  };
  double worst = 0;
  for (std::size_t row = 2; row < r.trace.rows(); ++row) {
    const double t = static_cast<double>(row - 1) * kTs;
    const Mat3 R = turn(Vec3::UnitY(), rod.angle(t)).toRotationMatrix();
    const Vec3 force = R.transpose() * ((velocity(t) - velocity(t - kTs)) / kTs + Vec3(0, 0, 9.81));
    worst = std::max({worst, std::abs(table.at(row, "sensor.imu.accelerometer_x") - force.x()),
                      std::abs(table.at(row, "sensor.imu.accelerometer_y") - force.y()),
                      std::abs(table.at(row, "sensor.imu.accelerometer_z") - force.z()),
                      std::abs(table.at(row, "sensor.imu.gyro_y") - rod.speed(t)),
                      std::abs(table.at(row, "sensor.imu.pitch") - rod.angle(t))});
  }
  // The angle has an error of 1e-10 (Pendulum.SwingsAsTheEllipticFunctionsSay), and the speed 5 times this error. The
  // difference of two speeds is divided by 5 ms.
  EXPECT_LT(worst, 2e-7);
}

}  // namespace
}  // namespace gaitlab::test
