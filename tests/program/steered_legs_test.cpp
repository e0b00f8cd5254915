// Values of an operator against their closed form, legs that follow them, and phases of legs.
#include <numbers>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/sensor_section.h"
#include "core/simulation/stepped.h"
#include "report/analysis/cpg_alone.h"
#include "tests/messages.h"
#include "tests/program/allocations.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

Scenario dog(const std::string& values, std::vector<std::string> sets = {}) {
  sets.insert(sets.begin(), {"physics.estimate=off", "sensors={remote: {type: steering, values: {" + values + "}}}",
                             "cpg.model={gait: trot, lift: 0.034, steering: remote}"});
  return shipped("imported/dog-trot.yaml", sets);
}

/// v = 0 until 0.1 s, 2 (t - 0.1)/0.2 until 0.3 s, then 2: a column in force just before its row.
TEST(Steering, IsLinearBetweenPoints) {
  const Scenario s = dog("speed: {unit: m/s, value: 0.1}",
                         {"sensors.second={type: steering, values: {mark: {unit: V, points: [[0.1, 0], [0.3, 2]]}}}",
                          "duration=0.5", "trace.columns=[\"sensor.*\"]", "trace.period=0.002"});
  const Recording record = run(s);
  const Table table(record.trace);
  for (std::size_t row = 1; row < record.trace.rows(); ++row) {
    const double tick = table.at(row, "t") - s.control_period;
    EXPECT_NEAR(table.at(row, "sensor.second.mark"), std::clamp((tick - 0.1) / 0.1, 0.0, 2.0), 1e-9) << row;
    EXPECT_EQ(table.at(row, "sensor.remote.speed"), 0.1);
  }
}

/// A dog whose steering is neither the first nor the only sensor, and its speeds in force at the end.
struct Steered {
  explicit Steered(const std::string& values)
      : record(run(
            shipped("imported/dog-trot.yaml",
                    {"physics.estimate=off", "duration=0.6", "trace.columns=[\"cpg.*\"]", "trace.period=0.002",
                     "cpg.model={gait: trot, lift: 0.034, steering: remote}",
                     "sensors={imu: {type: imu, body: m0/trunk}, second: {type: steering, values: {lamp: {value: 7}}}, remote: "
                     "{type: steering, values: {" +
                         values + "}}, load: {type: load}}"}))),
        table(record.trace) {}
  [[nodiscard]] double last(const std::string& name) const { return table.at(record.trace.rows() - 1, name); }
  Recording record;
  Table table;
};

// The speeds in force approach the values with T/4: v (1 - e^(-4 f t)), exactly so at the ticks, because the values are held
// between them. Each value has a different order among the sensors and among the speeds.
TEST(Steering, SpeedsFollowWithAQuarterOfAPeriod) {
  const Steered steered("turn: {value: 0.2}, speed: {value: 0.1}, side: {value: -0.05}");
  for (std::size_t row = 0; row < steered.record.trace.rows(); row += 10) {
    const double part = 1 - std::exp(-4 * 1.9 * steered.table.at(row, "t"));
    EXPECT_NEAR(steered.table.at(row, "cpg.speed"), 0.1 * part, 1e-12) << row;
    EXPECT_NEAR(steered.table.at(row, "cpg.side"), -0.05 * part, 1e-12) << row;
    EXPECT_NEAR(steered.table.at(row, "cpg.turn"), 0.2 * part, 1e-12) << row;
  }
}

// Values are limited to 10, then reduced together: 1e9 m/s is (10, 0), and (8, 6) is as long as that.
TEST(Steering, TooLongWaysAreReducedInProportion) {
  const double most = Steered("speed: {value: 1e9}").last("cpg.speed");
  const Steered across("speed: {value: 8}, side: {value: 6}");
  EXPECT_GT(most, 1) << "m/s";
  EXPECT_LT(most, 5);
  EXPECT_NEAR(across.last("cpg.speed"), 0.8 * most, 1e-12);
  EXPECT_NEAR(across.last("cpg.side"), 0.6 * most, 1e-12);
}

// With constant values the steered gait is that of the keys. Both take angles from the same least squares; the table is linear
// between 128 samples of a cycle, which leaves theta'' h^2/8. theta'' is at most 40 rad in units of the cycle's square here.
TEST(Steering, ConstantValuesGiveTheGaitOfTheKeys) {
  const std::vector<std::string> sets{"duration=2.5", "trace.columns=[\"joint.*.setpoint\"]", "trace.period=0.002"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), sets.begin(), sets.end());
    return more;
  };
  const Recording steered = run(dog("speed: {value: 0.19}, turn: {value: 0.2}", sets));
  const Recording keys = run(shipped("imported/dog-trot.yaml", with({"physics.estimate=off",
                                                                     "cpg.model={gait: trot, lift: 0.034, speed: 0.19, turn: "
                                                                     "0.2}"})));
  double most = 0;
  double moved = 0;
  for (std::size_t row = 0; row < keys.trace.rows(); ++row) {
    for (std::size_t c = 1; c < keys.trace.columns.size(); ++c) {
      if (keys.trace.at(row, 0) < 1.5) continue;  // ramp, and eleven time constants of T/4
      most = std::max(most, std::abs(steered.trace.at(row, c) - keys.trace.at(row, c)));
      moved = std::max(moved, std::abs(keys.trace.at(row, c) - keys.trace.at(0, c)));
    }
  }
  EXPECT_LT(most, 40.0 / (8 * 128 * 128));
  EXPECT_GT(moved, 0.2) << "rad: the legs move";
}

/// Yaw of the base, rad.
double yaw(const Table& table, std::size_t row) {
  const double w = table.at(row, "base.qw");
  const double x = table.at(row, "base.qx");
  const double y = table.at(row, "base.qy");
  const double z = table.at(row, "base.qz");
  return std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

// If the feet hold, the body moves with `speed` and turns with `turn`: before, during and after a curve. The walk of the dog
// with keys reaches 94 % of its speed (decision 56).
TEST(Steering, ADogWalksACurve) {
  const Scenario s = dog("speed: {value: 0.19}, turn: {points: [[3, 0], [3.2, 0.3], [6.2, 0.3], [6.4, -0.3]]}",
                         {"duration=9.6", "trace.columns=[\"base.*\"]", "trace.period=0.01"});
  const Recording record = run(s);
  const Table table(record.trace);
  const auto rate = [&](double from, double to) {
    const auto row = [&](double t) { return static_cast<std::size_t>(std::lround(t / 0.01)); };
    return (yaw(table, row(to)) - yaw(table, row(from))) / (to - from);
  };
  const double T = 1 / 1.9;  // s, of the gait: windows are whole periods
  EXPECT_NEAR(rate(1.2, 1.2 + 3 * T), 0, 0.03);
  EXPECT_NEAR(rate(4, 4 + 4 * T), 0.3, 0.05);
  EXPECT_NEAR(rate(7.2, 7.2 + 4 * T), -0.3, 0.05);
}

// A steered robot starts in its stance, and the gait without its robot has the steering of the run: the legs move as far as
// those of the keys, and other measured values change nothing.
TEST(Steering, StartsInTheStanceAndIsKnownBeforeTheRun) {
  const Scenario keys = shipped("imported/dog-trot.yaml", {"cpg.model={gait: trot, lift: 0.034, speed: 0.19}"});
  const Scenario steered = dog("speed: {points: [[0, 0.19], [100, 0.19]]}");
  EXPECT_EQ(steered.initial.angles.each, keys.initial.angles.each);
  const auto expected = report::set_point_ranges(keys);
  const auto found = report::set_point_ranges(steered);
  ASSERT_EQ(found.size(), expected.size());
  double moved = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k].least, expected[k].least, 2e-3) << k;  // rad; the table is linear between its samples
    EXPECT_NEAR(found[k].most, expected[k].most, 2e-3) << k;
    moved = std::max(moved, found[k].most - found[k].least);
  }
  EXPECT_GT(moved, 0.2);
  EXPECT_FALSE(report::stated_times(steered).by_cpg) << "its set points may change later";
}

TEST(Steering, AllocatesNothingInATick) {
  SteppedLanes lanes(std::vector<Scenario>{dog("speed: {value: 0.19}, turn: {value: 0.1}")});
  std::vector<double> sent{0.1, -0.2};
  std::vector<Action> actions(1);
  actions[0].steering = sent;
  lanes.tick(actions);
  const Allocations allocations;
  for (int k = 0; k < 50; ++k) lanes.tick(actions);
  EXPECT_EQ(allocations.count(), 0);
  EXPECT_EQ(lanes.measured(0).channels[1], -0.2) << "what was sent stays in force";
}

// Values that are sent at every tick give the bits of a run whose sensor has them.
TEST(Steering, SentValuesGiveTheBitsOfTheRun) {
  const Scenario s = dog("speed: {value: 0.19}, turn: {points: [[0.2, 0], [0.8, 0.3]]}", {"duration=1.2"});
  const Recording record = run(s);
  const Trace& poses = record.poses;
  SteppedLanes lanes(std::vector<Scenario>{dog("speed: {value: 0}, turn: {value: 0}", {"duration=1.2"})});
  std::vector<Action> actions(1);
  std::vector<double> sent(2);
  actions[0].steering = sent;
  const std::size_t joints = s.robot->joints.size();
  RobotState state;
  state.q.resize(joints);
  state.qd.resize(joints);
  for (std::size_t k = 0; k + 1 < poses.rows(); ++k) {
    const double t = static_cast<double>(k) * s.control_period;
    sent = {0.19, t < 0.2 ? 0 : t >= 0.8 ? 0.3 : 0.3 * ((t - 0.2) / (0.8 - 0.2))};
    lanes.tick(actions);
    lanes.read(0, state);
    for (std::size_t j = 0; j < joints; ++j) ASSERT_EQ(state.q[j], poses.at(k + 1, 8 + j)) << "tick " << k << ", joint " << j;
  }
}

// The trot by its phases, and a gait that has no name: the right legs a quarter later.
TEST(LegPhases, ReplaceThoseOfTheGait) {
  const auto at = [](const std::string& more, double t) {
    const Scenario s = shipped("imported/dog-trot.yaml", {"cpg.model={gait: trot, stride: 0.1, lift: 0.034" + more + "}"});
    std::vector<double> setpoint(s.robot->joints.size());
    make_cpg(s.cpg, plugin_info(s))->output(t, {}, setpoint);
    return std::pair(setpoint, plugin_info(s).legs);
  };
  const double T = 1 / 1.9;
  EXPECT_EQ(at(", phases: [0, 0.5, 0.5, 0]", 3.1).first, at("", 3.1).first);
  const auto [setpoint, legs] = at(", phases: [0, -0.25, 0.5, 0.25]", 3);
  const auto trot = at("", 3).first;
  const auto earlier = at("", 3 + 0.25 * T).first;  // the right front leg of the trot leads by a half, and now by -1/4
  for (const Leg& leg : legs) {
    for (const std::int64_t j : leg.joints) {
      const auto k = static_cast<std::size_t>(j);
      EXPECT_NEAR(setpoint[k], (leg.side > 0 ? trot : earlier)[k], 1e-9) << leg.name;
    }
  }
  EXPECT_TRUE(contains(message_of([&] { at(", phases: [0, 0.5, 0.5]", 0); }),
                       "model.phases has 3 numbers; the robot has 4 legs: front_left, front_right, rear_left, rear_right"));
}

TEST(Steering, Messages) {
  const auto refused = [](const std::vector<std::string>& sets) {
    return message_of([&] { shipped("imported/dog-trot.yaml", sets); });
  };
  EXPECT_TRUE(contains(refused({"cpg.model.steering=remote"}),
                       "no sensor gives remote.speed, remote.side or remote.turn; add sensors: {remote: {type: steering"));
  EXPECT_TRUE(contains(refused({"cpg.model.steering=remote", "sensors={remote: {type: steering, values: {speed: {}}}}"}),
                       "stride is given, and speed is steered by 'remote'; expected one"));
  const auto of = [&](const std::string& value) {
    return refused({"sensors={remote: {type: steering, values: {turn: {" + value + "}}}}"});
  };
  const std::string once =
      refused({"cpg.model.steering=remote", "sensors={remote: {type: steering, values: {turn: {points: [[0]]}}}}"});
  EXPECT_TRUE(contains(once, "point 0 of points has 1 numbers")) << once;
  EXPECT_FALSE(contains(once, "no sensor gives") || contains(once, "initial angle")) << "one fault, one message: " << once;
  EXPECT_TRUE(contains(of("points: [[0, 1], [0, 2]]"), "point 1 of points is not later than the one before it"));
  EXPECT_TRUE(contains(of("points: [[0, 1, 2]]"), "point 0 of points has 3 numbers; expected [time, value]"));
  EXPECT_TRUE(contains(of("value: 0, points: [[0, 1]]"), "unknown key 'value'"));
  EXPECT_TRUE(contains(refused({"sensors={remote: {type: steering}}"}), "values"));
  EXPECT_TRUE(contains(of("unit: deg/s, value: 20"), "unit of turn is deg/s; expected rad/s, or another name"));
  EXPECT_TRUE(contains(refused({"cpg.model.steering=remot", "sensors={remote: {type: steering, values: {speed: {}}}}"}),
                       "no sensor gives remot.speed, remot.side or remot.turn; the sensors give remote.speed"));
  EXPECT_TRUE(
      contains(refused({"cpg.model={steering: remote}", "sensors={remote: {type: steering, values: {turn: {}, sped: {}}}}"}),
               "legs do not follow 'remote.sped'; expected remote.speed, remote.side or remote.turn"));
  EXPECT_TRUE(
      contains(refused({"cpg.model={steering: remote, turn: 1}", "sensors={remote: {type: steering, values: {turn: {}}}}"}),
               "turn is given, and turn is steered by 'remote'; expected one"));
  EXPECT_TRUE(
      contains(refused({"sensors={remote: {type: steering, values: {\"tu rn\": {}}}}"}), "'tu rn' is not a name of a value"));
  EXPECT_TRUE(contains(refused({"cpg.model={gait: walk, phases: [0, 0.5, 0.75, 0.25]}"}), "expected lean: 0"));
}

}  // namespace
}  // namespace gaitlab::test
