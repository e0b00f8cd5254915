// The table of checks: every check below, near, at and beyond its limit, its margin, and the word that comes of it.
#include <cmath>
#include <functional>
#include <limits>

#include "report/analysis/motors.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {
namespace {

constexpr double kTableRounding = 1e-9;  // of quotients of numbers near 1

using Change = std::function<void(Case&)>;

/// A check of the gait after a change.
Check changed(const char* id, const Change& change, Case made = gait()) {
  change(made);
  return made.check(id);
}

Word word_after(const Change& change) {
  Case made = gait();
  change(made);
  return made.judged().word;
}

/// The last tick of joint 5, of a column that holds largest magnitudes.
Change tick(TickColumn column, double value) {
  return [=](Case& made) { made.tick(made.last_tick(), 5, column) = value; };
}

Change joint(double JointStatistics::*member, double value) {
  return [=](Case& made) { made.record.joints[4].*member = value; };
}

/// A row: by what the number is changed, and what then comes of it.
struct Row {
  const char* id;
  std::function<Change(double)> change;
  double limit;  ///< beyond it the check fails, or warns where it never fails
  double warns;  ///< beyond it the check warns
};

std::vector<Row> table() {
  const double no_load = 7.4 / (0.00395 * 594);  // u_max / (Ks n)
  const Limits limits;
  return {
      {"tracking", [](double v) { return tick(kErrorPeak, v); }, 2 * limits.tracking_error, limits.tracking_error},
      {"speed", [](double v) { return tick(kSpeedPeak, v); }, no_load, limits.warn_share * no_load},
      {"stops", [](double v) { return joint(&JointStatistics::range_worst, v); }, limits.beyond_range, 0},
      {"voltage",
       [](double v) {
         return [v](Case& made) {  // a share of every tick, so that no stretch is long
           made.scenario.limits.saturated_periods = 1e6;
           made.record.tally.estimated = false;  // else 1e-4 beside the limit is too close
           const std::size_t columns = made.record.ticks.columns.size();
           for (std::size_t k = 1; k <= made.last_tick(); ++k)
             made.tick(k, 5, kVoltageLimited) = v * made.record.ticks.values[k * columns];
         };
       },
       limits.saturated_share, 0},
      {"envelope", [](double v) { return tick(kEnvelopePeak, v); }, limits.warn_share, limits.warn_share},
      {"setpoints", [](double v) { return joint(&JointStatistics::setpoint_outside, v); }, 0, 0},
      {"start", [](double v) { return joint(&JointStatistics::start_jump, v); }, limits.start_jump, limits.start_jump},
      {"ledger",
       [](double v) {
         return [v](Case& made) {
           made.record.ledger.copper += made.record.ledger.residual() - v * made.record.ledger.electrical;
         };
       },
       limits.energy_residual, limits.energy_residual},
  };
}

TEST(CheckTable, BelowAtAndBeyondEachLimit) {
  for (const Row& row : table()) {
    SCOPED_TRACE(row.id);
    const auto at = [&](double value) { return changed(row.id, row.change(value)); };
    const double tiny = 1e-4 * (row.limit > 0 ? row.limit : 1);
    const Check beyond = at(row.limit + tiny);
    EXPECT_EQ(beyond.status, beyond.can_fail ? CheckStatus::fail : CheckStatus::warn) << beyond.text;
    EXPECT_LT(beyond.margin, 0) << beyond.text;
    if (row.limit == 0) continue;
    EXPECT_NEAR(at(1.5 * row.limit).margin, -0.5, 1e-6) << at(1.5 * row.limit).text;
    const Check below = at(row.limit - tiny);
    EXPECT_GT(below.margin, 0) << below.text;
    EXPECT_EQ(below.status, row.warns < row.limit ? CheckStatus::warn : CheckStatus::pass) << below.text;
    if (row.warns <= 0) continue;
    EXPECT_EQ(at(row.warns * (1 - 1e-4)).status, CheckStatus::pass) << at(row.warns * (1 - 1e-4)).text;
  }
}

/// The margin is continuous across the limit, and the worst joint is the one with the least.
TEST(CheckTable, WorstIsTheLeastMargin) {
  Case made = gait();
  made.record.joints[4].range_worst = 0.009;    // 90 % of the angle
  made.record.joints[6].range_share = 0.00999;  // 99.9 % of the time
  made.record.joints[6].range_worst = 0.001;
  EXPECT_EQ(made.check("stops").worst, made.scenario.robot->joints[6].name);
  EXPECT_NEAR(made.check("stops").margin, 0.001, kTableRounding);
  EXPECT_EQ(made.check("stops").unit, "") << "the share decides";
  EXPECT_NEAR(made.check("stops").margin_of(0.018), 0.001, kTableRounding) << "another angle leaves the time";
  made.record.joints[4].range_worst = 0.02;
  EXPECT_EQ(made.check("stops").worst, made.scenario.robot->joints[4].name);
  EXPECT_NEAR(made.check("stops").margin, -1, kTableRounding);
  EXPECT_EQ(made.check("stops").unit, "rad");
}

TEST(CheckTable, TightestIsTheLeastMarginOfThoseThatFail) {
  const Verdict made = gait().judged();
  const Check* const tightest = made.tightest();
  ASSERT_NE(tightest, nullptr);
  for (const Check& check : made.checks) {
    if (!check.can_fail || std::isnan(check.margin) || check.limit == 0) continue;
    EXPECT_GE(check.margin, tightest->margin) << check.id;
    EXPECT_EQ(check.margin < 0, check.status == CheckStatus::fail) << check.id;
  }
  Case close = gait();
  tick(kErrorPeak, 0.199)(close);
  EXPECT_EQ(close.judged().tightest()->id, "tracking");
  EXPECT_NEAR(close.judged().tightest()->margin, 0.005, kTableRounding);
}

/// A rating within the error of the torque is too close to be judged, either way; one that fails beyond it is not.
TEST(CheckTable, TooCloseWithinTheErrorOfTheTorque) {
  const std::vector<JudgedJoint> whole = summarise(gait().scenario, gait().record, 0).judged.whole;
  double peak = 0;
  for (const JudgedJoint& one : whole) peak = std::max(peak, one.torque_peak);
  const auto with = [&](double rating) {
    Case made;
    made.scenario = shipped("caterpillar.yaml",
                            {"duration=12", "physics.engine=articulated", fmt::format("actuator.gear_torque_peak={}", rating)});
    made.record = gait().record;
    made.record.tally.estimated = true;
    made.record.tally.torque_peak.assign(whole.size(), 1.0);
    made.record.tally.torque_error.assign(whole.size(), 0.03);
    return made;
  };
  for (const double share : {0.98, 1.02}) {
    const Case made = with(peak * share);
    EXPECT_EQ(made.status("gear_peak"), CheckStatus::too_close) << made.check("gear_peak").text;
    EXPECT_EQ(made.judged().word, Word::not_judged);
    EXPECT_TRUE(contains(made.judged().why(), " of the limit")) << made.judged().why();
    EXPECT_TRUE(contains(made.check("gear_peak").remedy, "take physics.accuracy: ")) << made.check("gear_peak").remedy;
  }
  EXPECT_EQ(with(peak * 0.96).status("gear_peak"), CheckStatus::fail);
  EXPECT_EQ(with(peak * 0.96).judged().word, Word::infeasible);
  EXPECT_EQ(with(peak * 1.04).status("gear_peak"), CheckStatus::warn);
  EXPECT_EQ(with(peak * 1.04).judged().word, Word::feasible) << with(peak * 1.04).judged().why();
}

TEST(CheckTable, WordsOfFailuresAndOfMissingEvidence) {
  EXPECT_EQ(word_after([](Case&) {}), Word::feasible);
  EXPECT_EQ(word_after(tick(kErrorPeak, 0.21)), Word::infeasible);
  EXPECT_EQ(word_after([](Case& made) { made.record.outcome = {Ended::diverged, "diverged at step 3"}; }), Word::failed);
  EXPECT_EQ(word_after([](Case& made) { made.record.tally.coarse = 0.11 * made.record.simulated; }), Word::not_judged);
  EXPECT_EQ(word_after([](Case& made) { made.record.tally.coarse = 0.09 * made.record.simulated; }), Word::feasible);
  const auto off = [](double error) {
    return [error](Case& made) {
      made.record.tally.estimated = true;
      made.record.tally.torque_peak.assign(made.record.joints.size(), 1.0);
      made.record.tally.torque_error.assign(made.record.joints.size(), error);
    };
  };
  EXPECT_EQ(word_after(off(0.051)), Word::not_judged);
  EXPECT_EQ(word_after(off(0.049)), Word::feasible);
  EXPECT_EQ(word_after([&](Case& made) {
              off(0.051)(made);
              made.scenario.limits.torque_error = 0.06;
            }),
            Word::feasible);
  // What no time undoes is said of a run that is too short, too; what time could undo is not.
  Case brief = walk();
  brief.record.joints[4].range_worst = 0.02;
  EXPECT_EQ(brief.judged().word, Word::infeasible);
  brief = walk();
  brief.tick(brief.last_tick(), 5, kErrorPeak) = 3;
  EXPECT_EQ(brief.judged().word, Word::not_judged);
  // Nothing can be said of a run whose numbers are not to be trusted.
  brief.record.joints[4].range_worst = 0.02;
  brief.record.tally.coarse = brief.record.simulated;
  EXPECT_EQ(brief.judged().word, Word::not_judged);
}

/// Every check comes with what a reader and a search need of it.
TEST(CheckTable, EachIsWhole) {
  const Verdict made = gait().judged();
  ASSERT_EQ(made.checks.size(), check_kinds().size());
  for (const Check& check : made.checks) {
    EXPECT_FALSE(check.text.empty()) << check.id;
    EXPECT_FALSE(check.definition.empty()) << check.id;
    const bool judged = check.status != CheckStatus::not_judged;
    EXPECT_TRUE(judged || std::isnan(check.margin)) << check.id;
    if (!judged || !check.can_fail || check.id == "outcome") continue;
    EXPECT_FALSE(std::isnan(check.margin)) << check.id;
    EXPECT_FALSE(check.source.empty()) << check.id;
  }
}

}  // namespace
}  // namespace gaitlab::test
