// Tests of the verification of the best points: the points that are tried, the settings, and the reasons against a point.
#include "studies/search/verify.h"

#include <gtest/gtest.h>

#include "studies/search/candidates.h"
#include "studies/search/step_limit.h"
#include "studies/search/world_trials.h"
#include "tests/studies/search/searched_study.h"

namespace gaitlab::test {
namespace {

using studies::Job;
using studies::Results;
using studies::Row;
using studies::Verification;

using Values = std::vector<std::string>;

TEST(Candidates, AreTheBestThatAreApart) {
  SearchedStudy made({{"0.6", 1}, {"0.7", 5}, {"0.709", 4.9}, {"0.692", 4.8}, {"0.72", 4.5}, {"1.4", 3}, {"1.3", 2}});
  EXPECT_EQ(made.candidates(), (Values{"0.7", "0.72", "1.4"})) << "two niches, and the best 1 % from them";
  SearchedStudy few({{"0.6", 1}, {"0.7", 5}}, "verify: {best: 1}\n");
  EXPECT_EQ(few.candidates(), Values{"0.7"});
  SearchedStudy least({{"0.6", 1}, {"0.7", 5}}, "objective: {minimize: speed}\n");
  EXPECT_EQ(least.candidates(), (Values{"0.6", "0.7"}));
}

/// Points that are 10 % of the box apart precede better points close to them. The order remains that of the points.
TEST(Candidates, AreNichesFirst) {
  const std::vector<std::pair<std::string, double>> hills{{"0.7", 9},  {"0.72", 8}, {"0.75", 7}, {"1.2", 6},
                                                          {"1.25", 5}, {"0.9", 4},  {"1.4", 3}};
  SearchedStudy three(hills);
  EXPECT_EQ(three.candidates(), (Values{"0.7", "1.2", "0.9"}));
  EXPECT_EQ(three.candidates({0, 3, 5}), (Values{"0.72", "0.75", "1.4"})) << "the next round: a niche, then others";
  EXPECT_EQ(three.candidates({0, 1, 2, 3, 4, 5, 6}), Values{});
  SearchedStudy five(hills, "verify: {best: 5}\n");
  EXPECT_EQ(five.candidates(), (Values{"0.7", "0.72", "1.2", "0.9", "1.4"})) << "four niches, and the best of the others";
}

TEST(Candidates, AreKept) {
  SearchedStudy made({{"0.6", 1}, {"0.7", 5}, {"0.8", 4}, {"0.9", 3}}, "constraints: [speed <= 4.5]\n");
  made.rows[2].outcome = "diverged";
  made.rows[2].score.reset();
  EXPECT_EQ(made.candidates(), (Values{"0.9", "0.6"}));
}

/// For 0.1 to 10 Hz on a logarithmic scale, 1 % of the box is a factor of 100^0.01 = 1.047.
TEST(Candidates, AreApartInTheScaleOfTheirParameter) {
  SearchedStudy made({{"0.2", 5}, {"0.209", 4}, {"0.21", 3}, {"8", 2}, {"8.2", 1}}, "verify: {best: 9}\n",
                     "cpg.frequency: {low: 0.1, high: 10, scale: log}");
  EXPECT_EQ(made.candidates(), (Values{"0.2", "0.21", "8"}));
}

TEST(Candidates, WithOtherWordsAreApart) {
  SearchedStudy made({{"0.7", 5}}, "", "cpg.frequency: {low: 0.5, high: 1.5}, cpg.type: {values: [hopf, phase_oscillator]}");
  made.study.plan->add({"0.7", "phase_oscillator"});
  made.rows.push_back(made.study.done(made.study.plan->row(1), "speed", 4));
  EXPECT_EQ(made.candidates().size(), 2U);
}

/// A front of five points, of which three divide it evenly.
TEST(Candidates, OfAFrontAreItsEndsAndBetween) {
  SearchedStudy made({{"0.6", 1}, {"0.7", 2}, {"0.8", 3}, {"0.9", 4}, {"1", 5}, {"1.1", 0}},
                     "objective: [{maximize: speed}, {minimize: torque.peak}]\nmethod: {type: nsga2}\n");
  for (std::size_t k = 0; k < made.rows.size(); ++k) {
    Row& row = made.rows[k];
    row.quantities[made.study.column("torque.peak")] = k == 5 ? 9 : row.quantities[made.study.column("speed")];
    row.score = made.study.plan->scorer().score(row.quantities, row.verdict);
  }
  EXPECT_EQ(made.candidates(), (Values{"1", "0.8", "0.6"}));
}

/// The row of a job with the speed of its point times a factor.
std::function<Row(const Job&)> times(const SearchedStudy& made, double factor, const std::function<void(Row&)>& change = {}) {
  return [&made, factor, change](const Job& job) {
    const auto was = std::ranges::find(made.rows, job.row.point, &Row::point);
    Row row = made.study.done(job.row, "speed", factor * was->quantities[made.study.column("speed")]);
    if (change) change(row);
    return row;
  };
}

/// Reasons of the runs with half the step, point by point.
std::vector<std::string> reasons(SearchedStudy& made, double factor, const std::function<void(Row&)>& change = {}) {
  std::vector<std::string> all;
  for (const Verification& v : made.verify(times(made, factor, change))) {
    if (v.what() != "as run") all.push_back(v.reason);
  }
  return all;
}

TEST(Verify, RunsEachPointAgainInEachWay) {
  SearchedStudy made({{"0.6", 1}, {"0.7", 5}}, "verify: {engine: bullet}\n");
  std::vector<std::vector<std::string>> sets;
  const std::function<Row(const Job&)> same = times(made, 1);
  const std::vector<Verification> tried = made.verify([&](const Job& job) {
    EXPECT_TRUE(job.estimate) << "the best points have an estimate";
    sets.push_back(job.sets);
    return same(job);
  });
  ASSERT_EQ(sets.size(), 4U);
  EXPECT_EQ(sets[0], (Values{"cpg.frequency=0.6", "physics.accuracy=0.005"})) << "half of the default 0.01";
  EXPECT_EQ(sets[1].at(1), "physics.engine=bullet");
  EXPECT_EQ(sets[2].at(0), "cpg.frequency=0.7");
  ASSERT_EQ(tried.size(), 6U);
  const std::vector<std::string> what{"as run", "half step", "bullet", "as run", "half step", "bullet"};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(tried[k].what(), what[k]);
    EXPECT_EQ(tried[k].run, k / 3);
    EXPECT_EQ(tried[k].objectives, std::vector<double>{k < 3 ? 1.0 : 5.0});
    EXPECT_EQ(tried[k].verdict, Word::feasible);
    EXPECT_EQ(tried[k].reason, "");
  }
}

TEST(Verify, HalvesAStepThatIsGiven) {
  SearchedStudy made({{"0.6", 1}}, "set: [physics.integrator=rk4, physics.step=0.0005]\n");
  const std::function<Row(const Job&)> same = times(made, 1);
  made.verify([&](const Job& job) {
    EXPECT_EQ(job.sets.back(), "physics.step=0.00025");
    return same(job);
  });
}

TEST(Verify, RefusesALargerChange) {
  SearchedStudy made({{"0.6", 1}, {"0.7", -5}});
  const Values none{"", ""};
  EXPECT_EQ(reasons(made, 1.0199), none);
  EXPECT_EQ(reasons(made, 0.9801), none);
  EXPECT_EQ(reasons(made, 1.021), (Values{"speed is 1.021 instead of 1, beyond the 2 % of verify.change",
                                          "speed is -5.105 instead of -5, beyond the 2 % of verify.change"}));
  EXPECT_NE(reasons(made, -1), none);
  EXPECT_NE(reasons(made, std::nan("")), none) << "an unknown objective";
  SearchedStudy wider({{"0.6", 1}}, "verify: {change: 0.1}\n");
  EXPECT_EQ(reasons(wider, 1.09), Values{""});
}

/// Rows of a law whose error is proportional to the step: speed = limit * (1 - loss * step / 0.001). The other engine is at
/// `other` times the limit.
std::function<Row(const Job&)> of_first_order(const SearchedStudy& made, double limit, double loss, double other) {
  return [=, &made](const Job& job) {
    const auto has = [&](const std::string& set) { return std::ranges::find(job.sets, set) != job.sets.end(); };
    const double speed =
        has("physics.engine=bullet") ? other * limit : limit * (1 - loss * (has("physics.step=0.0005") ? 0.5 : 1));
    return made.study.done(job.row, "speed", speed);
  };
}

constexpr const char* kFixedStep = "set: [physics.integrator=implicit, physics.step=0.001]\nverify: {engine: bullet}\n";

TEST(StepLimit, IsExactForAnErrorOfItsOrder) {
  const auto value = [](double step, int order) { return 3 + 2 * std::pow(step, order); };
  for (const int order : {1, 2, 4}) {
    constexpr double kRounding = 1e-14;  // rounding errors of a few operations on numbers of 3 to 5
    EXPECT_NEAR(studies::step_limit(value(1, order), value(0.5, order), order), 3, kRounding) << order;
  }
}

/// As for dtto in steps of 1 ms, the speed is 2.4 % too low, and 1.2 % with half the step. The other engine is near the limit.
TEST(Verify, TakesTheLimitOfVanishingSteps) {
  SearchedStudy made({{"0.6", 1 - 0.024}}, kFixedStep);
  const std::vector<Verification> tried = made.verify(of_first_order(made, 1, 0.024, 1.001));
  ASSERT_EQ(tried.size(), 4U);
  for (const Verification& v : tried) EXPECT_EQ(v.reason, "") << v.what();
  EXPECT_TRUE(tried[3].kind == studies::TrialKind::limit) << tried[3].what();
  constexpr double kRounding = 1e-15;
  EXPECT_NEAR(tried[3].objectives.at(0), 1, kRounding) << "exact, as the error is of first order";
}

TEST(Verify, TakesALargeStepIfTheLimitAgrees) {
  SearchedStudy made({{"0.6", 1 - 0.1}}, kFixedStep);
  EXPECT_EQ(made.verify(of_first_order(made, 1, 0.1, 1.019)).size(), 4U);
  const std::vector<Verification> apart = made.verify(of_first_order(made, 1, 0.1, 1.021));
  ASSERT_EQ(apart.size(), 3U) << "the other engine is 2.1 % from the limit";
  EXPECT_EQ(apart[1].reason, "speed is 0.95 instead of 0.9, beyond the 2 % of verify.change");
  EXPECT_EQ(apart[2].reason, "speed is 1.021 instead of 0.9, beyond the 2 % of verify.change");
}

TEST(Verify, NeedsNoLimitWithoutAChange) {
  SearchedStudy made({{"0.6", 1 - 0.01}}, kFixedStep);
  EXPECT_EQ(made.verify(of_first_order(made, 1, 0.01, 1)).size(), 3U);
}

/// The limit of vanishing steps is not used if a run with finer steps breaks a constraint, or if the integrator chooses its
/// steps.
TEST(Verify, TheLimitNeedsGivenStepsAndLimitsKept) {
  SearchedStudy broken({{"0.6", 1 - 0.05}}, std::string(kFixedStep) + "constraints: [speed <= 0.97]\n");
  const std::vector<Verification> tried = broken.verify(of_first_order(broken, 1, 0.05, 1));
  ASSERT_EQ(tried.size(), 3U);
  EXPECT_NE(tried[1].reason, "");
  SearchedStudy adaptive({{"0.6", 1}}, "verify: {engine: bullet}\n");
  EXPECT_EQ(adaptive.verify(times(adaptive, 1.03)).size(), 3U);
}

TEST(Verify, RefusesARunThatFails) {
  SearchedStudy made({{"0.6", 1}});
  EXPECT_EQ(reasons(made, 1,
                    [](Row& row) {
                      row.outcome = "diverged";
                      row.message = "at step 3";
                      row.score.reset();
                    }),
            Values{"diverged: at step 3"});
}

TEST(Verify, RefusesABrokenConstraint) {
  SearchedStudy made({{"0.6", 1}}, "constraints: [speed <= 1.01]\nverify: {change: 0.5}\n");
  const std::vector<Verification> tried = made.verify(times(made, 1.2));
  EXPECT_EQ(tried.at(1).reason, "speed <= 1.01 (1.2)");
  EXPECT_NEAR(tried.at(1).violation, 0.19 / 1.01 / (1 + 0.19 / 1.01), 1e-15);
}

/// Also in a study without guards, the reason of a run in which the check `step` fails names the step, because a shorter step
/// may remove the cause.
TEST(Verify, NamesAStepThatWasTooLong) {
  SearchedStudy made({{"0.6", 1}});
  const std::size_t column = made.study.column("margin.step");
  for (const double margin : {0.5, -0.5}) {
    const Values found = reasons(made, 1, [&](Row& row) {
      row.verdict = Word::infeasible;
      row.message = "because";
      row.quantities[column] = margin;
    });
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found[0].starts_with("the verdict is infeasible: because")) << found[0];
    EXPECT_EQ(found[0].ends_with(
                  "; the step of this run was too long at times (check step), so that a shorter step may verify the point"),
              margin < 0)
        << found[0];
  }
}

/// Rows that are infeasible with too long steps in bullet: with its own step and, if `at_quarter`, also with a quarter of it.
std::function<Row(const Job&)> with_long_steps(const SearchedStudy& made, bool at_quarter, Values& steps) {
  return [&made, &steps, at_quarter](const Job& job) {
    const bool bullet = std::ranges::find(job.sets, "physics.engine=bullet") != job.sets.end();
    const bool quarter = bullet && job.sets.back() != "physics.step=auto";
    Row row = made.study.done(job.row, "speed", 1);
    if (bullet) steps.push_back(job.sets.back());
    if (!bullet || (quarter && !at_quarter)) return row;
    row.verdict = Word::infeasible;
    row.message = "because";
    row.quantities[made.study.column("margin.step")] = quarter ? 0.5 : -0.5;
    return row;
  };
}

/// The own step of bullet is 2.5e-5 s for dtto. A spike of one long step says nothing about the gait.
TEST(Verify, RepeatsTheOtherEngineWithAQuarterOfAStepThatWasTooLong) {
  SearchedStudy made({{"0.6", 1}}, "verify: {engine: bullet}\n");
  Values steps;
  const std::vector<Verification> tried = made.verify(with_long_steps(made, false, steps));
  EXPECT_EQ(steps, (Values{"physics.step=auto", "physics.step=6.25e-06"}));
  ASSERT_EQ(tried.size(), 4U);
  EXPECT_EQ(tried[2].what(), "bullet");
  EXPECT_EQ(tried[2].reason, "") << "its repetition counts";
  EXPECT_EQ(tried[3].what(), "bullet at a quarter of its step");
  EXPECT_EQ(tried[3].reason, "");
  EXPECT_TRUE(tried[3].kind == studies::TrialKind::quarter_step);
  EXPECT_EQ(studies::verified(tried), std::vector<std::uint64_t>{0});
}

TEST(Verify, RefusesWhatAQuarterOfTheStepConfirms) {
  SearchedStudy made({{"0.6", 1}}, "verify: {engine: bullet}\n");
  Values steps;
  const std::vector<Verification> tried = made.verify(with_long_steps(made, true, steps));
  ASSERT_EQ(tried.size(), 4U);
  EXPECT_EQ(tried[3].reason, "the verdict is infeasible: because");
  EXPECT_TRUE(studies::verified(tried).empty());
}

/// A run in the other engine is not repeated if it verifies its point, or if it fails with steps that are short enough.
TEST(Verify, RepeatsNothingElse) {
  for (const auto& [verdict, margin] : {std::pair{Word::feasible, -0.5}, {Word::infeasible, 0.5}}) {
    SearchedStudy made({{"0.6", 1}}, "verify: {engine: bullet}\n");
    const std::vector<Verification> tried = made.verify([&, word = verdict, step = margin](const Job& job) {
      Row row = made.study.done(job.row, "speed", 1);
      row.verdict = word;
      row.quantities[made.study.column("margin.step")] = step;
      return row;
    });
    EXPECT_EQ(tried.size(), 3U) << name_of(verdict);
  }
}

TEST(Verify, RefusesAVerdictThatSpeaksAgainstIt) {
  SearchedStudy made({{"0.6", 1}});
  const std::size_t column = made.study.column("margin.evidence");
  const auto with = [&](Word verdict, double evidence) {
    return reasons(made, 1, [&](Row& row) {
      row.verdict = verdict;
      row.message = "because";
      row.quantities[column] = evidence;
    });
  };
  EXPECT_EQ(with(Word::feasible, 1), Values{""});
  EXPECT_EQ(with(Word::infeasible, 1), Values{"the verdict is infeasible: because"});
  EXPECT_EQ(with(Word::not_judged, 1), Values{""}) << "for lack of ratings, not of evidence";
  EXPECT_EQ(with(Word::not_judged, -0.1), Values{"not judged: because"});
}

TEST(Verify, RefusesAPointWhoseOwnRunIsInfeasible) {
  SearchedStudy made({{"0.6", 1}, {"0.7", 5}});
  made.rows[1].verdict = Word::infeasible;
  made.rows[1].message = "because";
  const std::vector<Verification> tried = made.verify(times(made, 1));
  ASSERT_EQ(tried.size(), 4U);
  EXPECT_EQ(tried[2].what(), "as run");
  EXPECT_EQ(tried[2].reason, "the verdict is infeasible: because");
  EXPECT_EQ(studies::verified(tried), std::vector<std::uint64_t>{0});
}

/// The replicates of a point are combined, by default into the worst.
TEST(Verify, CombinesReplicates) {
  SearchedStudy made({{"0.6", 1}}, "replicates: {count: 2}\n");
  const std::vector<Verification> tried = made.verify([&](const Job& job) {
    EXPECT_EQ(job.sets.size(), 3U) << "frequency, seed, accuracy";
    return made.study.done(job.row, "speed", job.row.replicate == 0 ? 1 : 0.5);
  });
  EXPECT_EQ(tried.at(1).objectives, std::vector<double>{0.5});
  EXPECT_EQ(tried.at(1).reason, "speed is 0.5 instead of 1, beyond the 2 % of verify.change");
}

TEST(Verify, GivesNothingWhenItIsStopped) {
  SearchedStudy made({{"0.6", 1}});
  made.write();
  std::atomic<bool> stop = true;
  const Results found = results(made.journal);
  EXPECT_FALSE(studies::verify(*made.study.plan, made.journal, found, {0}, answering(times(made, 1)), {}, stop).has_value());
}

TEST(Verified, PassedInEveryWay) {
  using enum studies::TrialKind;
  const auto tried = [](std::uint64_t run, studies::TrialKind kind, const std::string& reason) {
    return Verification{run, kind, "", {}, 0, Word::feasible, reason};
  };
  EXPECT_EQ(studies::verified({tried(8, as_run, ""), tried(8, half_step, ""), tried(2, as_run, ""), tried(2, half_step, "why"),
                               tried(5, as_run, "why"), tried(5, half_step, ""), tried(1, as_run, "")}),
            (std::vector<std::uint64_t>{8, 1}))
      << "in their order";
  EXPECT_TRUE(studies::verified({}).empty());
  EXPECT_EQ(studies::verified({tried(8, as_run, ""), tried(8, world, "why"), tried(8, worlds, "")}),
            std::vector<std::uint64_t>{8})
      << "a single world rejects nothing";
  EXPECT_TRUE(studies::verified({tried(8, as_run, ""), tried(8, worlds, "why")}).empty());
}

}  // namespace
}  // namespace gaitlab::test
