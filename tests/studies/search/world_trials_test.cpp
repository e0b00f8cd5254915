// Tests of the verification in worlds: conditions and share of a point, the order of points, and the constraint of robust
// studies.
#include "studies/search/world_trials.h"

#include <gtest/gtest.h>

#include "app/study/verification_text.h"
#include "studies/plan/worlds.h"
#include "tests/studies/search/searched_study.h"

namespace gaitlab::test {
namespace {

using studies::Job;
using studies::Row;
using studies::Verification;

/// The entry `as run` of every point.
std::vector<Verification> own_runs(SearchedStudy& made) {
  made.write();
  std::vector<Verification> all;
  for (const studies::PointResult& point : results(made.journal).points)
    all.push_back({point.first_run, studies::TrialKind::as_run, "", {point.score.objectives[0]}, 0, Word::feasible, ""});
  return all;
}

std::vector<Verification> tried_in_worlds(SearchedStudy& made, const std::function<Row(const Job&)>& answer) {
  const std::vector<Verification> tried = own_runs(made);
  std::atomic<bool> stop = false;
  return studies::in_worlds(*made.study.plan, made.journal, results(made.journal), tried, answering(answer), {}, stop).value();
}

bool has_set(const Job& job, const std::string& set) { return std::ranges::find(job.sets, set) != job.sets.end(); }

/// Rows that are feasible, except those with one of these settings.
std::function<Row(const Job&)> falling(const SearchedStudy& made, const std::vector<std::string>& sets, double speed = 1) {
  return [=, &made](const Job& job) {
    Row row = made.study.done(job.row, "speed", speed);
    if (std::ranges::none_of(sets, [&](const std::string& set) { return has_set(job, set); })) return row;
    row.verdict = Word::infeasible;
    row.cause = {"voltage", "m1/passive"};
    return row;
  };
}

TEST(InWorlds, CountsWhereAPointStands) {
  SearchedStudy made({{"0.6", 1}});
  std::vector<std::vector<std::string>> sets;
  const auto answer = falling(made, {"as_built.supply=0.9", "seed=3"});
  const std::vector<Verification> all = tried_in_worlds(made, [&](const Job& job) {
    EXPECT_FALSE(job.estimate);
    EXPECT_TRUE(has_set(job, "cpg.frequency=0.6"));
    EXPECT_TRUE(has_set(job, "actuator.efficiency_model=directional"));
    return answer(job);
  });
  ASSERT_EQ(all.size(), 1 + 16 + 1) << "as run, the worlds of a dc_motor, their share";
  const studies::WorldCount count = studies::counted_worlds(all, 0);
  EXPECT_EQ(count.of, 16U);
  EXPECT_EQ(count.stood, 14U);
  EXPECT_EQ(count.fell_drawn, 1U);
  EXPECT_EQ(count.drawn, 7U);
  EXPECT_EQ(count.falls.at(0).check, "voltage");
  EXPECT_EQ(count.falls.at(0).reason, "voltage of m1/passive");
  EXPECT_EQ(app::falls_text(count), "falls by supply -10 % (6.66 V): voltage of m1/passive; and in 1 of 7 draws");
  EXPECT_TRUE(all.back().kind == studies::TrialKind::worlds);
  EXPECT_EQ(all.back().reason, "");
  EXPECT_EQ(studies::verified(all), std::vector<std::uint64_t>{0});
}

/// Three quarters of 16 are 12.
TEST(InWorlds, TheShareDecides) {
  const std::vector<std::string> four{"as_built.R=0.95", "as_built.R=1.05", "as_built.Kt=1.05", "as_built.mass=1.03"};
  SearchedStudy made({{"0.6", 1}});
  EXPECT_EQ(tried_in_worlds(made, falling(made, four)).back().reason, "");
  std::vector<std::string> five = four;
  five.emplace_back("seed=2");
  const std::vector<Verification> all = tried_in_worlds(made, falling(made, five));
  EXPECT_EQ(all.back().reason, "stands in 11 of 16 worlds; 12 are needed");
  EXPECT_TRUE(studies::verified(all).empty());
  SearchedStudy lenient({{"0.6", 1}}, "verify: {share: 0.65}\n");
  EXPECT_EQ(tried_in_worlds(lenient, falling(lenient, five)).back().reason, "") << "10.4 of 16, thus 11";
  EXPECT_EQ(studies::needed(0.75, 16), 12U);
  EXPECT_EQ(studies::needed(0.75, 11), 9U);
  EXPECT_EQ(studies::needed(0.07, 100), 7U);
  EXPECT_EQ(studies::needed(0, 16), 0U);
}

/// A point falls because of a failed run, a broken constraint or a verdict, but not because of a changed objective.
TEST(InWorlds, WhatAFallIs) {
  const auto reason = [](const std::string& lines, const std::function<void(Row&, const SearchedStudy&)>& change) {
    SearchedStudy made({{"0.6", 1}}, lines);
    const std::vector<Verification> all = tried_in_worlds(made, [&](const Job& job) {
      Row row = made.study.done(job.row, "speed", 1);
      if (has_set(job, "as_built.R=1.05")) change(row, made);
      return row;
    });
    const studies::WorldCount count = studies::counted_worlds(all, 0);
    return count.falls.empty() ? "" : count.falls.front().name + ": " + count.falls.front().reason;
  };
  const auto speed = [](double value) {
    return [value](Row& row, const SearchedStudy& made) { row.quantities[made.study.column("speed")] = value; };
  };
  EXPECT_EQ(reason("", speed(0.2)), "");
  EXPECT_EQ(reason("constraints: [speed >= 0.5]\n", speed(0.2)), "R +5 % (4.51 ohm): speed >= 0.5 (0.2)");
  EXPECT_EQ(reason("",
                   [](Row& row, const SearchedStudy&) {
                     row.outcome = "diverged";
                     row.message = "at step 3";
                     row.score.reset();
                   }),
            "R +5 % (4.51 ohm): diverged: at step 3");
  const auto not_judged = [](double evidence) {
    return [evidence](Row& row, const SearchedStudy& made) {
      row.verdict = Word::not_judged;
      row.quantities[made.study.column("margin.evidence")] = evidence;
    };
  };
  EXPECT_EQ(reason("", not_judged(-1)), "R +5 % (4.51 ohm): not judged");
  EXPECT_EQ(reason("", not_judged(1)), "") << "without guards, for lack of ratings";
}

/// A margin that a guard requires is a reserve that worlds may use up.
TEST(InWorlds, UseUpTheReserve) {
  const auto stood = [](double margin) {
    SearchedStudy made({{"0.6", 1}}, "", "cpg.frequency: {low: 0.5, high: 1.5}", "guards: {voltage: {margin: 0.2}}\n");
    const std::size_t column = made.study.column("margin.voltage");
    for (Row& row : made.rows) row.quantities[column] = 0.2;
    for (Row& row : made.rows) row.score = made.study.plan->scorer().score(row.quantities, row.verdict);
    const std::vector<Verification> all = tried_in_worlds(made, [&](const Job& job) {
      Row row = made.study.done(job.row, "speed", 1);
      row.quantities[column] = margin;
      row.score = made.study.plan->scorer().score(row.quantities, row.verdict);
      EXPECT_GT(row.score->violation, 0) << "as a run of the search";
      return row;
    });
    return studies::counted_worlds(all, 0).stood;
  };
  EXPECT_EQ(stood(0.01), 16U);
  EXPECT_EQ(stood(-0.01), 0U);
}

TEST(InWorlds, OnlyPointsThatStandAreRun) {
  SearchedStudy made({{"0.6", 1}, {"0.9", 5}});
  std::vector<Verification> tried = own_runs(made);
  tried[1].reason = "why";
  std::atomic<bool> stop = false;
  std::size_t runs = 0;
  const auto answer = falling(made, {});
  const auto all =
      studies::in_worlds(*made.study.plan, made.journal, results(made.journal), tried, answering([&](const Job& job) {
        ++runs;
        return answer(job);
      }),
                         {}, stop);
  EXPECT_EQ(runs, 16U);
  EXPECT_EQ(all.value().back().reason, "why") << "rejected points are last";
  stop = true;
  EXPECT_FALSE(studies::in_worlds(*made.study.plan, made.journal, results(made.journal), tried, answering(answer), {}, stop)
                   .has_value());
}

/// Each world has one run, regardless of the number of replicates.
TEST(InWorlds, TakesTheFirstReplicate) {
  SearchedStudy made({{"0.6", 1}}, "replicates: {count: 3}\n");
  std::size_t runs = 0;
  const auto answer = falling(made, {});
  tried_in_worlds(made, [&](const Job& job) {
    EXPECT_EQ(job.row.replicate, 0U);
    ++runs;
    return answer(job);
  });
  EXPECT_EQ(runs, 16U);
}

TEST(RankedByShare, ByShareThenByValue) {
  std::vector<Verification> tried;
  const auto add = [&](std::uint64_t run, double value, std::size_t falls, const std::string& rejected = "", double limit = 0) {
    tried.push_back({run, studies::TrialKind::as_run, "", {value}, 0, Word::feasible, ""});
    if (limit > 0) tried.push_back({run, studies::TrialKind::limit, "", {limit}, 0, Word::feasible, ""});
    for (std::size_t k = 0; k < 4; ++k)
      tried.push_back({run, studies::TrialKind::world, std::to_string(k), {value}, 0, Word::feasible, k < falls ? "why" : ""});
    tried.push_back({run, studies::TrialKind::worlds, "", {value}, 0, Word::feasible, rejected});
  };
  add(1, 9, 3, "why");
  add(2, 8, 1);
  add(3, 7, 0);
  add(4, 6, 0, "", 7.5);
  add(5, 5, 4, "why");
  const auto order = [&](bool maximize) {
    std::vector<std::uint64_t> runs;
    for (const Verification& v : studies::ranked_by_share(tried, maximize)) {
      if (runs.empty() || runs.back() != v.run) runs.push_back(v.run);
    }
    return runs;
  };
  EXPECT_EQ(order(true), (std::vector<std::uint64_t>{4, 3, 2, 1, 5}));
  EXPECT_EQ(order(false), (std::vector<std::uint64_t>{3, 4, 2, 1, 5}));
}

/// The text on a point follows from its journal alone.
TEST(VerificationText, NamesTheWorldsInWhichAPointFalls) {
  SearchedStudy made({{"0.6", 0.0646}});
  made.write();
  std::vector<Verification> all{
      {0, studies::TrialKind::as_run, "", {0.0646}, 0, Word::feasible, ""},
      {0, studies::TrialKind::half_step, "", {0.0654}, 0, Word::feasible, ""},
      {0, studies::TrialKind::other_engine, "bullet", {0.06615}, 0, Word::feasible, ""},
      {0, studies::TrialKind::limit, "", {0.0662}, 0, Word::feasible, ""},
      {0, studies::TrialKind::world, "supply -10 % (6.66 V)", {0.06}, 0, Word::infeasible, "voltage of m5/passive", "voltage"},
      {0, studies::TrialKind::world, "mass +3 % (3.3 kg)", {0.055}, 0, Word::feasible, ""},
      {0, studies::TrialKind::drawn_world, "draw 1 (seed 2)", {0.06}, 0, Word::infeasible, "heat of m5/passive", "heat"},
      {0, studies::TrialKind::worlds, "", {0.0662}, 0, Word::feasible, ""}};
  made.journal.write(all);
  const std::string ways =
      "as run 0.0646, half step 0.0654, bullet 0.06615, limit 0.0662, 0.055 to 0.06 in the worlds)\n"
      "  cpg.frequency 0.6\n"
      "  the gait stands; the study's step was too long: 0.0662 m/s\n"
      "  falls by supply -10 % (6.66 V): voltage of m5/passive; and in 1 of 1 draw\n"
      "  the worlds have directional gears, but the runs have the paper's, so that a run with another friction or supply can "
      "end differently from its world\n";
  EXPECT_EQ(app::verification_text(made.journal),
            "verification of the best points (speed, m/s):\nrun 0 verified, stands in 1 of 3 worlds (" + ways);
  all.back().reason = "stands in 1 of 3 worlds; 3 are needed";
  made.journal.write(all);
  EXPECT_EQ(app::verification_text(made.journal),
            "verification of the best points (speed, m/s):\nrun 0 not verified, stands in "
            "1 of 3 worlds; 3 are needed (" +
                ways);
  EXPECT_EQ(
      app::nearest_text(made.journal),
      "run 0 is nearest: it stands in 1 of 3 worlds; 3 are needed; falls by supply -10 % (6.66 V): voltage of m5/passive; "
      "and in 1 of 1 draw; to search gaits with a reserve, take a guard with a margin, `guards: {voltage: {margin: 0.1}}`, or "
      "`robust: true`");
}

}  // namespace
}  // namespace gaitlab::test
