// Rollouts that are simulated side by side, in lanes and in threads, have the same results as each rollout alone.
#include "core/simulation/batch.h"

#include <atomic>
#include <mutex>
#include <optional>

#include "tests/labels.h"
#include "tests/program/bits.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongBatch("Batch.EndsEveryRolloutAsAlone", "long");

const std::vector<std::string> kCommon{"physics.engine=articulated", "physics.integrator=extrapolated", "physics.step=5e-4",
                                       "duration=0.45"};
// Settings of the rollouts. They change every section of the scenario. One rollout ends early, one diverges, one is at its
// current limit, and some have other control or trace ticks.
const std::vector<std::vector<std::string>> kOwn{
    {},
    {"ground.friction=0.3", "contact.stiffness=2e4", "contact.exponent=1.2"},
    {"actuator.i_max=0.1"},
    {"duration=0.21"},
    {"robot.on_ground=false", "robot.position=[99000, 0, 1]", "initial.base_velocity=[9999, 0, 0]", "ground.type=none"},
    {"controller.period=0.03", "trace.period=0.01"},
    {"cpg.frequency=0.6", "actuator.efficiency_model=directional"},
    {"physics.gravity=[0.5, 0, -9]", "initial.angles=0.1"},
    {"physics.integrator=implicit"},  // cannot share a lane group with the others
    {"controller.Kp=20", "actuator.rotor_inertia=1e-8"},
    {"ground.type=none"},
};

TEST(Batch, EndsEveryRolloutAsAlone) {
  const std::vector<Scenario> all = rollouts(kScenarios + "hexapod.yaml", kCommon, kOwn, catalog());
  std::vector<std::string> expected;
  expected.reserve(all.size());
  for (const Scenario& one : all) expected.push_back(alone(one));
  EXPECT_NE(expected[4].find("diverged"), std::string::npos) << expected[4];
  EXPECT_NE(expected[2], expected[0]);
  for (const std::size_t lanes : {1U, 4U, 8U}) {
    for (const int threads : {1, 2}) {
      std::mutex lock;
      std::vector<std::string> ends(all.size());
      run_batch(all, {threads, lanes}, [&](std::size_t i, Recording&& end) {
        const std::lock_guard hold(lock);
        EXPECT_TRUE(ends[i].empty()) << "told twice: " << i;
        ends[i] = bits(end, end.outcome.text());
      });
      for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(ends[i], expected[i]) << "rollout " << i << ", " << lanes << " lanes, " << threads << " threads";
      }
    }
  }
}

TEST(Batch, MixesRobotsOfOneStructureAndKeepsOthersApart) {
  const std::vector<std::string> common{"physics.engine=articulated", "duration=0.1"};
  std::vector<Scenario> all;
  for (const char* name : {"caterpillar.yaml", "hexapod.yaml", "rubble.yaml", "octopod.yaml", "caterpillar-equations.yaml"}) {
    all.push_back(shipped(name, common));
  }
  EXPECT_TRUE(can_share(all[0], all[4]));
  EXPECT_TRUE(can_share(all[1], all[2]));
  EXPECT_FALSE(can_share(all[0], all[1]));
  std::vector<std::string> ends(all.size());
  run_batch(all, {}, [&](std::size_t i, Recording&& end) { ends[i] = bits(end, end.outcome.text()); });
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(ends[i], alone(all[i])) << i;
}

TEST(Batch, TellsOfTheOthersBesideOneThatIsRefused) {
  // The integrator rk4 has a largest stable step. A motor with a tenth of the resistance requires a tenth of that step.
  const std::vector<std::vector<std::string>> own{{}, {"actuator.R=0.4"}, {}, {"ground.friction=0.7"}};
  const std::vector<Scenario> all = rollouts(
      kScenarios + "hexapod.yaml",
      {"physics.engine=articulated", "physics.integrator=rk4", "physics.step=2.5e-5", "duration=0.01"}, own, catalog());
  std::vector<std::string> ends(all.size());
  EXPECT_THROW(run_batch(all, {}, [&](std::size_t i, Recording&& end) { ends[i] = bits(end, end.outcome.text()); }),
               InputError);
  EXPECT_TRUE(ends[1].empty()) << ends[1];
  for (const std::size_t i : {0U, 2U, 3U}) EXPECT_EQ(ends[i], alone(all[i]));
}

/// Robots in step divide their steps together, which makes lanes worth their while.
TEST(Batch, PutsEqualFrequenciesSideBySide) {
  std::vector<std::vector<std::string>> own;
  for (int k = 0; k < 8; ++k) own.push_back({k % 2 == 0 ? "cpg.frequency=0.4" : "cpg.frequency=0.6"});
  const std::vector<Scenario> all = rollouts(
      kScenarios + "hexapod.yaml", {"physics.engine=articulated", "physics.estimate=off", "duration=0.01"}, own, catalog());
  std::size_t next = 0;
  std::vector<std::vector<std::size_t>> groups;
  const BatchStream stream{.next = [&]() -> std::optional<Rollout> {
                             if (next == all.size()) return {};
                             const std::size_t number = next++;
                             return Rollout{number, all[number]};
                           },
                           .begin =
                               [&](std::span<const Rollout> group) {
                                 groups.emplace_back();
                                 for (const Rollout& one : group) groups.back().push_back(one.number);
                               },
                           .end = [](std::vector<RolloutEnd>&&) {}};
  std::atomic<bool> stop = false;
  ASSERT_TRUE(run_pulled(stream, {1, 4}, Loads::left_out, stop));
  if (all[0].physics.engine->lanes.size() == 1) GTEST_SKIP() << "this processor has no lanes";
  EXPECT_EQ(groups, (std::vector<std::vector<std::size_t>>{{0, 2, 4, 6}, {1, 3, 5, 7}}));
}

TEST(Batch, RunsEveryEngine) {
  const std::vector<Scenario> all =
      rollouts(kScenarios + "pendulum.yaml", {"duration=0.05"}, std::vector<std::vector<std::string>>(3), catalog());
  std::vector<std::string> ends(all.size());
  run_batch(all, {.threads = 2}, [&](std::size_t i, Recording&& end) { ends[i] = bits(end, end.outcome.text()); });
  for (const std::string& end : ends) EXPECT_EQ(end, alone(all[0]));
}

TEST(Batch, TellsWhatIsWrongWithAllRollouts) {
  try {
    rollouts(kScenarios + "hexapod.yaml", {}, std::vector<std::vector<std::string>>{{"duration=-1"}, {}, {"cpg.typ=hopf"}},
             catalog());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 2U);
  }
}

}  // namespace
}  // namespace gaitlab::test
