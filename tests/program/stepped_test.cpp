// Simulations that a caller steps: the bits of a run, restarts of single lanes, snapshots, ends, and no allocation.
#include "core/simulation/stepped.h"

#include <algorithm>
#include <random>

#include "core/model/kinematics.h"
#include "kit/episodes.h"
#include "tests/program/allocations.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const std::vector<std::string> kFast{"physics.engine=articulated", "physics.estimate=off", "duration=1.5"};

/// Set points that a run of the scenario gives at its control ticks, and its poses before each of them and at the end.
struct Walked {
  std::vector<std::vector<double>> setpoint, pose;
};

Walked walked(const Scenario& s) {
  const Recording record = run(s);
  const Trace& poses = record.poses;
  const std::size_t joints = s.robot->joints.size();
  Walked all;
  for (std::size_t k = 0; k < poses.rows(); ++k) {
    std::vector<double> row(joints), pose(7 + joints);
    for (std::size_t c = 0; c < pose.size(); ++c) pose[c] = poses.at(k, 1 + c);
    all.pose.push_back(pose);
    if (k == 0) continue;
    for (std::size_t j = 0; j < joints; ++j) row[j] = poses.at(k, 8 + joints + j);  // in force before this row
    all.setpoint.push_back(row);
  }
  return all;
}

std::vector<double> pose_of(const SteppedLanes& lanes, std::size_t lane, std::size_t joints) {
  RobotState state;
  state.q.resize(joints);
  state.qd.resize(joints);
  lanes.read(lane, state);
  std::vector<double> pose(state.position.data(), state.position.data() + 3);
  for (const double x : {state.orientation.w(), state.orientation.x(), state.orientation.y(), state.orientation.z()})
    pose.push_back(x);
  pose.insert(pose.end(), state.q.begin(), state.q.end());
  return pose;
}

class OfScenario : public testing::TestWithParam<const char*> {};

TEST_P(OfScenario, SetPointsOfARunGiveItsBits) {
  const Scenario s = shipped(GetParam(), kFast);
  const Walked expected = walked(s);
  const std::size_t joints = s.robot->joints.size();
  for (const std::size_t width : s.physics.engine->lanes) {
    SteppedLanes lanes(std::vector<Scenario>(width, s));
    // Each lane but the first starts anew after some ticks, and is then compared from its start.
    std::vector<std::size_t> begun(width, 0);
    for (std::size_t k = 0; k + 12 < expected.setpoint.size(); ++k) {
      std::vector<Action> actions(width);
      for (std::size_t l = 0; l < width; ++l) {
        if (l > 0 && k == 5 + 3 * l) {
          lanes.restart(l);
          begun[l] = k;
        }
        EXPECT_EQ(pose_of(lanes, l, joints), expected.pose[k - begun[l]]) << width << " lanes, lane " << l << ", tick " << k;
        actions[l].setpoint = expected.setpoint[k - begun[l]];
      }
      if (HasFailure()) return;
      lanes.tick(actions);
    }
  }
}

TEST_P(OfScenario, ASnapshotContinuesWithTheSameBits) {
  const Scenario s = shipped(GetParam(), kFast);
  const Walked expected = walked(s);
  const std::size_t joints = s.robot->joints.size();
  SteppedLanes one(std::vector<Scenario>{s});
  std::mt19937 random(7);
  std::vector<double> saved;
  std::size_t at = 0;
  const std::size_t when = 10 + random() % 30;
  for (std::size_t k = 0; k + 1 < expected.setpoint.size(); ++k) {
    if (k == when) {
      saved.resize(one.size(0));
      one.save(0, saved);
      at = k;
    }
    one.tick(std::vector<Action>{{expected.setpoint[k], {}, {}}});
  }
  SteppedLanes other(std::vector<Scenario>{s});
  other.load(0, saved);
  for (std::size_t k = at; k + 1 < expected.setpoint.size(); ++k) {
    EXPECT_EQ(pose_of(other, 0, joints), expected.pose[k]) << k;
    other.tick(std::vector<Action>{{expected.setpoint[k], {}, {}}});
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Stepped, OfScenario,
                         testing::Values("hexapod.yaml", "caterpillar.yaml", "rubble.yaml", "imported/dog-trot.yaml",
                                         "library/atron-drive.yaml"));

TEST(Stepped, ResidualsAndCommandsOfTheScenariosPluginsAreItsRun) {
  const Scenario s = shipped("hexapod.yaml", kFast);
  const Walked expected = walked(s);
  const std::size_t joints = s.robot->joints.size();
  const std::vector<double> zero(joints, 0.0);
  SteppedLanes own(std::vector<Scenario>{s});
  for (std::size_t k = 0; k + 1 < expected.setpoint.size(); ++k) {
    EXPECT_EQ(pose_of(own, 0, joints), expected.pose[k]) << k;
    own.tick(std::vector<Action>{{{}, zero, {}}});  // what the CPG gives, plus 0
    if (HasFailure()) return;
  }
}

TEST(Stepped, LanesEndAtTheirDurationAndStayUntilTheirRestart) {
  std::vector<Scenario> all(4, shipped("hexapod.yaml", kFast));
  for (std::size_t l = 0; l < 4; ++l) all[l].duration = 0.15 * static_cast<double>(l + 1);
  kit::Episodes episodes(all, {});
  const std::vector<double> zero(4 * episodes.action_columns().size(), 0.0);
  const auto rows = [&](std::size_t i) {
    const In truth = episodes.truth().subspan(i * episodes.true_columns().size(), episodes.true_columns().size());
    return std::vector<double>(truth.begin(), truth.end());
  };
  for (int k = 0; k < 10; ++k) episodes.step(zero);
  EXPECT_EQ(episodes.ended(0), "done");
  EXPECT_EQ(episodes.ended(1), "");
  const std::vector<double> last = rows(0);
  EXPECT_DOUBLE_EQ(last[19], 0.15);  // time
  for (int k = 0; k < 5; ++k) episodes.step(zero);
  EXPECT_EQ(rows(0), last);
  episodes.restart(std::vector<std::size_t>{0});
  EXPECT_EQ(episodes.ended(0), "");
  for (int k = 0; k < 10; ++k) episodes.step(zero);
  EXPECT_EQ(rows(0), last);
  EXPECT_EQ(episodes.ended(1), "done");
  EXPECT_EQ(episodes.ended(3), "");
}

TEST(Stepped, FaultsBeginAnewWithTheRestart) {
  std::vector<std::string> sets = kFast;
  sets.emplace_back("at=[{t: 0.3, fault: {joint: m0/active, kind: dead}}]");
  const Scenario s = shipped("hexapod.yaml", sets);
  SteppedLanes lanes(std::vector<Scenario>(4, s));
  const std::size_t joints = s.robot->joints.size();
  const std::vector<double> wanted(joints, 0.3);
  std::vector<std::vector<double>> first;
  for (int k = 0; k < 40; ++k) {
    first.push_back(pose_of(lanes, 1, joints));
    lanes.tick(std::vector<Action>(4, {wanted, {}, {}}));
  }
  lanes.restart(1);
  for (int k = 0; k < 40; ++k) {
    EXPECT_EQ(pose_of(lanes, 1, joints), first[static_cast<std::size_t>(k)]) << k;
    lanes.tick(std::vector<Action>(4, {wanted, {}, {}}));
    if (HasFailure()) return;
  }
}

TEST(Stepped, TheRecordOfSetPointsBeginsAnewWithTheRestart) {
  kit::Episodes episodes(std::vector<Scenario>(2, shipped("hexapod.yaml", kFast)), {.record = true});
  const std::size_t joints = episodes.scenario(0).robot->joints.size();
  const std::vector<double> first(2 * episodes.action_columns().size(), 0.1);
  const std::vector<double> later(first.size(), 0.2);
  for (int k = 0; k < 3; ++k) episodes.step(first);
  episodes.restart(std::vector<std::size_t>{0});
  for (int k = 0; k < 2; ++k) episodes.step(later);
  EXPECT_EQ(episodes.set_points(0), std::vector<double>(2 * joints, 0.2));
  EXPECT_EQ(episodes.set_points(1).size(), 5 * joints);
}

/// The hold of a stuck joint grows within a tick, as in a run.
TEST(Stepped, AJamIsThatOfTheRun) {
  for (const char* const step : {"auto", "5e-4"}) {
    std::vector<std::string> sets = kFast;
    sets.insert(sets.end(), {"duration=0.6", fmt::format("physics.step={}", step),
                             "at=[{t: 0.3, fault: {joint: m7/active, kind: stuck}}]"});
    const Scenario s = shipped("hexapod.yaml", sets);
    const Walked expected = walked(s);
    SteppedLanes lanes(std::vector<Scenario>{s});
    for (std::size_t k = 0; k + 1 < expected.setpoint.size(); ++k) {
      ASSERT_EQ(pose_of(lanes, 0, s.robot->joints.size()), expected.pose[k]) << step << ", tick " << k;
      lanes.tick(std::vector<Action>{{expected.setpoint[k], {}, {}}});
    }
  }
}

TEST(Stepped, ATickAllocatesNothing) {
  std::vector<std::string> sets = kFast;
  sets.emplace_back("sensors={imu: {type: imu, body: m0/active, gyro: {noise: 0.01}}, feet: {type: load}}");
  kit::Episodes episodes(std::vector<Scenario>(8, shipped("hexapod.yaml", sets)), {});
  std::vector<double> wanted(8 * episodes.action_columns().size(), 0.0);
  for (int k = 0; k < 5; ++k) episodes.step(wanted);
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = 0.01 * static_cast<double>(i % 7);
  const Allocations counted;
  for (int k = 0; k < 10; ++k) episodes.step(wanted);
  EXPECT_EQ(counted.count(), 0);
}

TEST(Stepped, ASnapshotOfEpisodesIsWholeOrRefused) {
  const auto make = [](const std::vector<std::string>& more = {}) {
    std::vector<std::string> sets = kFast;
    sets.insert(sets.end(), more.begin(), more.end());
    return kit::Episodes(std::vector<Scenario>(5, shipped("hexapod.yaml", sets)), {.record = true});
  };
  kit::Episodes one = make();
  const std::vector<double> wanted(5 * one.action_columns().size(), 0.1);
  for (int k = 0; k < 7; ++k) one.step(wanted);
  const std::string bytes = one.snapshot();
  for (int k = 0; k < 7; ++k) one.step(wanted);
  kit::Episodes other = make();
  other.restore(bytes);
  for (int k = 0; k < 7; ++k) other.step(wanted);
  EXPECT_EQ(one.snapshot(), other.snapshot());
  std::mt19937 random(3);
  const std::string before = other.snapshot();
  for (int k = 0; k < 200; ++k) {
    std::string damaged = bytes;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 + random() % 255);
    if (k % 4 == 0) damaged.resize(random() % damaged.size());
    EXPECT_THROW(other.restore(damaged), InputError);
  }
  EXPECT_EQ(other.snapshot(), before);
  EXPECT_THROW(make({"ground.friction=0.3"}).restore(bytes), InputError);
}

TEST(Stepped, EnvironmentsThatCannotShareAreRefusedByNumber) {
  std::vector<Scenario> all(3, shipped("hexapod.yaml", kFast));
  all[2] = shipped("hexapod.yaml", {"physics.engine=articulated", "physics.integrator=rk4", "physics.step=1e-4"});
  try {
    const kit::Episodes refused(all, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "overrides[2]: error: changes physics.integrator")) << error.what();
  }
}

}  // namespace
}  // namespace gaitlab::test
