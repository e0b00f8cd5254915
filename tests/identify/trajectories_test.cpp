// Tests of the trajectories of `gaitlab new log`: the bench of `new bench` plays them within the range of its joint, and logs
// of them have the numbers of the servo that made them.
#include "identify/trajectories.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/files/csv_table.h"
#include "identify/identify.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace identify;

const Label kLongTrajectories("Trajectories.LogsOfThemHaveTheNumbersOfTheServo", "long;unsanitized");

constexpr double kAmplitude = 1.57, kSpeed = 10.786, kDuration = 6;  // rad; rad/s, of the XL330 without load; s
const std::vector<std::string> kNames{"sweep", "sines", "drop", "slow"};

/// A bench and its trajectories, as the program writes them.
class Trajectories : public ::testing::Test {
 protected:
  void make() {
    const Result bench = gaitlab("new bench lift --servo xl330-m288 --mass 0.25 --length 0.1", folder_ / "");
    ASSERT_EQ(bench.code, 0) << bench.err;
    made_ = gaitlab("new log lift --servo xl330-m288", folder_ / "");
    ASSERT_EQ(made_.code, 0) << made_.err;
  }
  /// The bench with a trajectory in the place of its log, as the printed command has it.
  Scenario bench(const std::string& trajectory, std::vector<std::string> sets = {}) {
    const std::string file = folder_ / ("lift-" + trajectory + ".csv");
    for (const std::string& set :
         {"cpg.model.file=" + file, "measured.file=" + file, std::string("measured.columns.m0/hinge.angle=goal"),
          std::string("measured.on=on"), std::string("actuator.u_max=5"), std::string("duration=6"),
          std::string("trace.period=0.005")})
      sets.push_back(set);
    return read_scenario(folder_ / "lift.yaml", sets, catalog());
  }
  static double largest(const Recording& record, const std::string& column) {
    double most = 0;
    const Table trace(record.trace);
    for (std::size_t k = 0; k < record.trace.rows(); ++k) most = std::max(most, std::abs(trace.at(k, column)));
    return most;
  }
  Folder folder_;
  Result made_;
};

TEST_F(Trajectories, TheBenchPlaysThemWithinItsRange) {
  make();
  EXPECT_TRUE(contains(made_.out,
                       "lift-sweep.csv, lift-sines.csv, lift-drop.csv, lift-slow.csv: goals of a joint for 6 s, 200 rows per "
                       "second, up to 1.57 rad and 10.79 rad/s\n"))
      << made_.out;
  EXPECT_TRUE(contains(made_.out, "\n  gaitlab identify lift.yaml LOGS.csv --to servo.yaml\n")) << made_.out;
  for (const std::string& name : kNames) {
    SCOPED_TRACE(name);
    const Recording record = run(bench(name));
    ASSERT_TRUE(record.outcome.done());
    EXPECT_LT(largest(record, "joint.0.angle"), kAmplitude) << "a released or fast arm stays within the amplitude";
    EXPECT_GT(largest(record, "joint.0.angle"), 0.5 * kAmplitude);
    if (name == "drop") {
      // Without torque the arm comes to rest within the band of the dry friction, 3 % of 0.52 N m of 0.25 kg at 0.1 m.
      EXPECT_LT(std::abs(end(record, "joint.0.angle")), 0.0156 / (0.25 * 9.80665 * 0.1));
      EXPECT_EQ(end(record, "joint.0.speed"), 0);
    }
  }
}

TEST_F(Trajectories, ReachTheirSpeedsAndAmplitudes) {
  for (const TrajectorySettings& of :
       {TrajectorySettings{}, TrajectorySettings{1, 12, 8, 500}, TrajectorySettings{0.3, 3, 4, 100}}) {
    const std::vector<Trajectory> all = trajectories(of);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Trajectory& one = all[i];
      SCOPED_TRACE(one.name);
      EXPECT_EQ(one.name, kNames[i]);
      ASSERT_EQ(one.goal.size(), static_cast<std::size_t>(of.duration * of.rate) + 1);
      double angle = 0, speed = 0;
      for (std::size_t k = 0; k < one.goal.size(); ++k) {
        EXPECT_NEAR(one.t[k], static_cast<double>(k) / of.rate, 1e-12);
        angle = std::max(angle, std::abs(one.goal[k]));
        if (k > 0) speed = std::max(speed, std::abs(one.goal[k] - one.goal[k - 1]) * of.rate);
      }
      EXPECT_EQ(one.goal[0], 0);
      EXPECT_LE(angle, of.amplitude * (1 + 1e-12));
      EXPECT_LE(speed, of.speed);
      // The speed of the sweep is largest where its cosine is 1, at most half a turn before the end, and there are at least
      // four turns.
      if (i == 0) {
        EXPECT_GT(speed, 0.85 * of.speed);
      }
      if (i == 1) {
        EXPECT_GT(speed, 0.45 * of.speed);
      }
      if (i >= 2) {
        EXPECT_NEAR(angle, of.amplitude, 1e-5);
      }
      EXPECT_EQ(std::ranges::count(one.on, false) > 0, i == 2);
      const CsvTable csv(trajectory_text(one));
      EXPECT_EQ(csv.names(), (std::vector<std::string>{"t", "goal", "on"}));
      EXPECT_NEAR(csv.column("goal").back(), one.goal.back(), 1e-6);
    }
  }
}

TEST_F(Trajectories, RefuseASweepThatIsTooShortOrTooFast) {
  const auto refused = [&](const std::string& options, const std::string& part) {
    const Result made = gaitlab("new log lift " + options, folder_ / "");
    EXPECT_EQ(made.code, 2);
    EXPECT_TRUE(contains(made.err, part)) << made.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "lift-sweep.csv"));
  };
  refused("--speed 1", "a speed of 1 rad/s is reached after 0.46 turns of the sweep; expected at least 2");
  refused("--speed 90 --amplitude 0.1", "the fastest turn of the sweep has 0.93 rows; expected at least 20");
  refused("--servo xl330-m28", "no servo 'xl330-m28'; did you mean 'xl330-m288'?");
  refused("--servo xl330-m288 --speed 3", "found --servo and --speed together; expected only one of them");
  folder_.write("lift-drop.csv", "mine");
  refused("", "lift-drop.csv: error: exists; nothing was written");
  EXPECT_EQ(read(folder_ / "lift-drop.csv"), "mine");
}

/// A drawn servo records the four trajectories at two gains, with an encoder of 12 bits.
TEST_F(Trajectories, LogsOfThemHaveTheNumbersOfTheServo) {
  make();
  const std::vector<std::pair<std::string, double>> numbers{{"stall_torque", 0.58},       {"no_load_speed", 9.6},
                                                            {"rotor_inertia", 0.0021},    {"dry_friction", 0.022},
                                                            {"viscous_friction", 0.0071}, {"load_friction", 0.19}};
  std::string table = "file,controller.P\n";
  for (const int gain : {200, 800}) {
    for (const std::string& name : kNames) {
      std::vector<std::string> sets{fmt::format("controller.P={}", gain), "actuator.stall_current=0",
                                    "actuator.efficiency=0.7"};
      for (const auto& [key, value] : numbers) sets.push_back(fmt::format("actuator.{}={}", key, value));
      const Scenario servo = bench(name, sets);
      const Recording record = run(servo);
      const Table trace(record.trace);
      const CsvTable goals(read(folder_ / ("lift-" + name + ".csv")));
      const std::vector<double> goal = goals.column("goal"), on = goals.column("on");
      std::string log = "t,goal,angle,on\n";
      constexpr double kTick = 2 * std::numbers::pi / 4096;  // an encoder of 12 bits
      for (std::size_t k = 0; k < goal.size(); ++k) {
        log += fmt::format("{},{},{},{}\n", record.trace.at(k, 0), goal[k],
                           kTick * std::round(trace.at(k, "joint.0.angle") / kTick), on[k]);
      }
      const std::string file = fmt::format("{}-{}.csv", name, gain);
      folder_.write(file, log);
      table += fmt::format("{},{}\n", file, gain);
    }
  }
  folder_.write("logs.csv", table);
  std::vector<BenchLog> logs =
      read_bench(folder_ / "lift.yaml", {"actuator.u_max=5", "measured.on=on"}, {folder_ / "logs.csv"}, catalog());
  check_logs(logs);
  std::vector<std::string> asked;
  for (const auto& [key, value] : numbers) asked.push_back("actuator." + key);
  const std::vector<Key> keys = fitted_keys(logs[0].scenario, asked);
  std::atomic<bool> stop = false;
  ErrorModels models(logs, keys, {Logged::angle}, 2, stop);
  const Identified made = identify::identify(models, {.seed = 1, .choose = false, .drawn = 0});
  // Ticks are 1e-3 of the motion, and errors of ten thousand rows average out: the differences are 0.02 % for line and inertia
  // and 0.3 % for frictions, which move the arm a tenth as much. The tolerance is three times that.
  for (std::size_t k = 0; k < numbers.size(); ++k)
    EXPECT_NEAR(made.keys[k].value, numbers[k].second, 0.01 * numbers[k].second) << numbers[k].first;
  // A tick is 1.5 mrad, and its mean error a quarter of that.
  EXPECT_LT(*mean_error(logs, made.after, Logged::angle, false), 0.5e-3);
}

}  // namespace
}  // namespace gaitlab::test
