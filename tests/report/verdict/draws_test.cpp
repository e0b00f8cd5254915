// Draws that cannot begin or are stopped, and their tables in damaged files.
#include "report/verdict/draws.h"

#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

struct DrawnWalk {
  explicit DrawnWalk(const std::vector<std::string>& sets) : scenario(of(sets)), record(run(scenario)) {}
  static Scenario of(std::vector<std::string> sets) {
    sets.insert(sets.begin(), {"physics.engine=articulated", "duration=0.06", "tolerances={R: 0.3, Kt: 0.3}"});
    return shipped("caterpillar.yaml", sets);
  }
  Drawn draw(const std::vector<Scenario>& others, bool stop = false) {
    std::atomic<bool> stopped = stop;
    return draws(scenario, {record, summary, judged}, others, {}, stopped);
  }
  Scenario scenario;
  Recording record;
  Summary summary = summarise(scenario, record, 0);
  Verdict judged = verdict(scenario, record, summary, overlaps(scenario, record));
};

// A motor with a small resistance and a large Kt makes the explicit step unstable, which is an error before the first step.
TEST(DrawsOfARun, OneThatCannotBeginIsARowWithItsReason) {
  const std::vector<std::string> explicit_step{"physics.integrator=rk4", "physics.step=2.5e-5"};
  DrawnWalk walk(explicit_step);
  const auto with = [&](const char* set) {
    std::vector<std::string> sets = explicit_step;
    sets.insert(sets.end(), {"seed=2", set});
    return DrawnWalk::of(sets);
  };
  const Drawn made = walk.draw({with("as_built={R: 0.1}"), with("as_built={R: 1}")});
  ASSERT_EQ(made.refused.size(), 1U);
  EXPECT_TRUE(contains(made.refused[0], "seed 2: step 2.5e-05 s is too long")) << made.refused[0];
  walk.record.draws = made.table;
  const std::vector<Draw> all = draws_of(walk.record, walk.scenario);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1].word, Word::failed);
  EXPECT_NE(all[2].word, Word::failed);
  EXPECT_TRUE(contains(draws_text(all, true), "; failed in 1; ")) << draws_text(all, true);
}

TEST(DrawsOfARun, StoppedOnesAreLeftOut) {
  DrawnWalk walk({});
  walk.record.draws = walk.draw({DrawnWalk::of({"seed=2"}), DrawnWalk::of({"seed=3"})}, true).table;
  const std::vector<Draw> all = draws_of(walk.record, walk.scenario);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].seed, 1);
}

TEST(DrawsOfARun, ATableOfADamagedFileIsReadAsFarAsItGoes) {
  DrawnWalk walk({});
  const Trace sound = walk.draw({DrawnWalk::of({"seed=2"})}).table;
  ASSERT_EQ(sound.rows(), 2U);
  for (const double number : {std::nan(""), -1.0, 1e300, 0.5}) {
    walk.record.draws = sound;
    std::ranges::fill(walk.record.draws.values, number);
    for (const Draw& draw : draws_of(walk.record, walk.scenario)) {
      EXPECT_EQ(draw.seed, 1) << number;
      EXPECT_TRUE(draw.failing.empty()) << number;
    }
  }
  walk.record.draws = Trace{{{"other", "", ""}}, {1, 2}};
  EXPECT_EQ(draws_of(walk.record, walk.scenario).size(), 2U);
  EXPECT_EQ(draws_text(draws_of(walk.record, walk.scenario), true), "feasible in 0 of 2 robots; not judged in 2");
}

TEST(DrawsOfARun, ALongTableHasThoseThatAreNotFeasible) {
  std::vector<Draw> all(50);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].seed = static_cast<std::int64_t>(k);
    all[k].word = k == 7 ? Word::infeasible : Word::feasible;
  }
  all[7].failing = {{"voltage", "m5/active"}};
  const std::string text = draws_table(all, 40);
  EXPECT_TRUE(contains(text, "7  infeasible")) << text;
  EXPECT_TRUE(contains(text, "voltage of m5/active\n  and 49 more (verdict.json)\n")) << text;
  EXPECT_EQ(std::ranges::count(draws_table(all, 50), '\n'), 51);
}

}  // namespace
}  // namespace gaitlab::test
