// Tests of checks and their margins for cases that check_table_test.cpp does not contain.
#include <cmath>
#include <limits>

#include "report/analysis/motors.h"
#include "report/verdict/rolled.h"
#include "tests/report/verdict/checks/check_changes.h"

namespace gaitlab::test {
namespace {

constexpr double kCaseRounding = 1e-9;  // rounding errors of quotients of numbers near 1

CheckStatus status_after(const char* id, const Change& change) { return changed(id, change).status; }

TEST(CheckCases, OutcomeIsAnEndBeforeTheEnd) {
  EXPECT_EQ(status_after("outcome", [](Case&) {}), CheckStatus::pass);
  const Check early = changed("outcome", [](Case& made) { made.record.outcome = {Ended::diverged, "diverged at step 3"}; });
  EXPECT_EQ(early.status, CheckStatus::fail);
  EXPECT_EQ(early.limit, 12);
}

/// The rated speed applies to the whole run, and the speed without load only to the window. The smaller margin counts.
TEST(CheckCases, SpeedIsOfTheWorseLimit) {
  const double no_load = 7.4 / (0.00395 * 594);
  const auto with = [&](double early, double late, double rating = 5) {
    Case made = rated_gait();
    made.scenario = shipped("caterpillar.yaml",
                            {"duration=12", "physics.engine=articulated", fmt::format("actuator.speed_max={}", rating)});
    tick(kSpeedPeak, early, 1)(made);
    tick(kSpeedPeak, late)(made);
    return made.check("speed");
  };
  EXPECT_EQ(with(5.01, 0).status, CheckStatus::fail);
  EXPECT_EQ(with(5.01, 0).span, CheckSpan::whole_run);
  EXPECT_EQ(with(5.01, 0).limit, 5);
  EXPECT_EQ(with(5.01, 0).first, rated_gait().time(1));
  EXPECT_EQ(with(4.99, 0).status, CheckStatus::warn);
  EXPECT_EQ(with(3.99, 0).status, CheckStatus::pass);
  EXPECT_EQ(with(0, 1.01 * no_load).span, CheckSpan::window);
  EXPECT_EQ(with(0, 1.01 * no_load).status, CheckStatus::fail);
  EXPECT_EQ(with(0, 1.01 * no_load).first, rated_gait().time(rated_gait().last_tick()));
  EXPECT_EQ(with(0, 0.99 * no_load, 3.5).span, CheckSpan::window) << "99 % of one, 89 % of the other";
  EXPECT_EQ(with(0, 0.99 * no_load, 3).span, CheckSpan::whole_run);
  // Exceeding the rating before the window breaks the motor. If the load turns the motor faster than its speed without load,
  // the motor does not break.
  const auto brief = [&](double rating) {
    Case made = walk();
    made.known = Overlaps{made.scenario.robot->bodies.size()};
    made.scenario =
        shipped("caterpillar.yaml", {"duration=4", "physics.engine=articulated", fmt::format("actuator.speed_max={}", rating)});
    tick(kSpeedPeak, 6, kEarly)(made);
    return made.judged();
  };
  EXPECT_EQ(brief(5.9).word, Word::infeasible);
  EXPECT_EQ(brief(5.9).decided_by, "speed");
  EXPECT_TRUE(contains(brief(5.9).why(), "more than it is rated for")) << brief(5.9).why();
  EXPECT_EQ(brief(6.1).word, Word::not_judged);
}

TEST(CheckCases, SupplyGivesNothing) {
  const auto status = [](double millimetres, bool goes_away) {
    return status_after("supply", [=](Case& made) {
      const double lifted = 1e-3 * made.scenario.robot->mass * made.scenario.physics.gravity.norm();
      made.record.ledger.electrical = -millimetres * lifted;
      for (JointStatistics& one : made.record.joints) one.electrical = -millimetres * lifted;
      for (std::size_t row = 0; row < made.record.poses.rows() && !goes_away; ++row)
        made.pose("com.x", row) = made.pose("com.y", row) = 0;
    });
  };
  EXPECT_EQ(status(0.99, false), CheckStatus::pass) << "no way, no cost of transport";
  EXPECT_EQ(status(1.01, false), CheckStatus::warn);
  EXPECT_EQ(status(1e-9, true), CheckStatus::warn);
  EXPECT_EQ(status(-1, true), CheckStatus::pass);
}

/// A check of saturation reports the worst joint, the number of joints beyond the limit, and the first of them.
TEST(CheckCases, SaturationNamesItsJoints) {
  const auto with = [](double second, double fifth) {
    Case made = rated_gait();
    made.scenario.limits.saturated_periods = 1e6;
    for (std::size_t k = 0; k <= made.last_tick(); ++k) {
      made.tick(k, 2, kVoltageLimited) = second * std::max(0.0, made.time(k) - 9);
      made.tick(k, kChanged, kVoltageLimited) = fifth * std::max(0.0, made.time(k) - 10);
    }
    return made.check("voltage");
  };
  const std::vector<Joint>& joints = rated_gait().scenario.robot->joints;
  EXPECT_EQ(with(0.1, 0.2).worst, joints[kChanged].name);
  EXPECT_EQ(with(0.2, 0.1).worst, joints[2].name);
  EXPECT_EQ(with(0.2, 0.1).parts, 2U);
  EXPECT_EQ(with(0, 0.1).parts, 1U);
  EXPECT_EQ(with(0, 0).parts, 0U);
  EXPECT_EQ(with(0.1, 0.2).first_part, joints[2].name);
  EXPECT_NEAR(with(0.1, 0.2).first, 9, 0.016);
  EXPECT_TRUE(std::isnan(with(0, 0).first));
  EXPECT_EQ(with(0, 0).value, 0);
}

/// The worst of several joints with equal margins is the joint that is at its limit for the longer total time.
TEST(CheckCases, SaturationOfEqualStretches) {
  const auto worst = [](std::size_t longer, std::size_t other) {
    Case made = rated_gait();
    made.scenario.limits.saturated_share = 1;
    for (std::size_t k = 0; k <= made.last_tick(); ++k) {
      const double stretch = std::max(0.0, made.time(k) - 11.5);
      made.tick(k, other, kVoltageLimited) = stretch;
      made.tick(k, longer, kVoltageLimited) = stretch + std::min(0.2, std::max(0.0, made.time(k) - 10));
    }
    const Check check = made.check("voltage");
    EXPECT_NEAR(check.value, 0.5, 1e-9) << "sums of ticks";
    EXPECT_EQ(check.unit, "s");
    return check.worst;
  };
  const std::vector<Joint>& joints = rated_gait().scenario.robot->joints;
  EXPECT_EQ(worst(2, kChanged), joints[2].name);
  EXPECT_EQ(worst(kChanged, 2), joints[kChanged].name);
}

/// Recorded saturation counts also if the actuator of the scenario states no limit.
TEST(CheckCases, SaturationOfOtherActuators) {
  const auto with = [](double share) {
    return changed("current", [=](Case& made) {
      made.scenario = shipped("caterpillar.yaml", {"duration=12", "physics.engine=articulated", "actuator={type: torque}",
                                                   "controller={type: pid, unit: N m, Kp: 5}"});
      rate(kCurrentLimited, share)(made);
    });
  };
  EXPECT_EQ(with(0.02).status, CheckStatus::fail) << with(0.02).text;
  EXPECT_EQ(with(0).status, CheckStatus::not_judged) << with(0).text;
}

/// A row that is at the limit for all but a thousandth of its time counts as entirely at the limit.
TEST(CheckCases, AStretchHasNoGaps) {
  const auto status = [](double part) {
    return status_after("current", [=](Case& made) {
      made.scenario.limits.saturated_share = 1;
      double sum = 0;
      for (std::size_t k = made.last_tick() - 5; k <= made.last_tick(); ++k)
        made.tick(k, kChanged, kCurrentLimited) = sum += part * (made.time(k) - made.time(k - 1));
    });
  };
  EXPECT_EQ(status(0.9995), CheckStatus::fail);
  EXPECT_EQ(status(0.99), CheckStatus::warn);
}

TEST(CheckCases, FirstIsWhenAPartWasBeyondItsLimitFirst) {
  Case made = rated_gait();
  const double later = made.time(20);
  made.tick(20, 2, kTorquePeak) = 5.1;
  made.tick(30, kChanged, kTorquePeak) = 6;
  made.tick(10, kChanged, kTorquePeak) = 4.9;
  EXPECT_EQ(made.check("gear_peak").first, later);
  EXPECT_EQ(made.check("gear_peak").first_part, made.scenario.robot->joints[2].name);
  EXPECT_EQ(made.check("gear_peak").worst, made.scenario.robot->joints[kChanged].name);
  made.load("dock.2.shear", 20) = 810;
  made.load("dock.3.shear", 30) = -900;
  made.load("dock.3.shear", 10) = 790;
  made.load("dock.1.shear", 40) = 820;
  EXPECT_EQ(made.check("dock_shear").first, later);
  EXPECT_EQ(made.check("dock_shear").first_part, "m2");
  EXPECT_EQ(made.check("dock_shear").worst, "m3");
  EXPECT_EQ(made.check("dock_shear").parts, 3U);
  EXPECT_EQ(made.check("dock_shear").value, 900);
}

/// Loads of docks below 1e-9 N are rounding errors and count as 0.
TEST(CheckCases, DocksBearNothingBelowRounding) {
  const auto value = [](double tension) {
    return changed("dock_tension",
                   [=](Case& made) {
                     for (std::size_t row = 0; row < made.record.loads.rows(); ++row) {
                       for (std::size_t m = 1; m < made.scenario.robot->modules.size(); ++m)
                         made.load(fmt::format("dock.{}.tension", m), row) = tension;
                     }
                   })
        .value;
  };
  EXPECT_EQ(value(0.9e-9), 0);
  EXPECT_EQ(value(1.1e-9), 1.1e-9);
}

/// If an excess lasts less than 0.1 s, the sentence states its time.
TEST(CheckCases, SentencesTellInstants) {
  Check made = changed("gear_peak", tick(kTorquePeak, 6));
  made.from = 3;
  made.to = 3.09;
  EXPECT_TRUE(contains(made.sentence(), ", at 3.00 s")) << made.sentence();
  made.to = 3.11;
  EXPECT_FALSE(contains(made.sentence(), ", at 3.00 s")) << made.sentence();
}

/// The margin is continuous across the limit, and the worst joint is the joint with the least margin.
TEST(CheckCases, WorstIsTheLeastMargin) {
  Case made = gait();
  made.record.joints[4].range_worst = 0.009;    // 90 % of the permitted angle
  made.record.joints[6].range_share = 0.00999;  // 99.9 % of the permitted time
  made.record.joints[6].range_worst = 0.001;
  EXPECT_EQ(made.check("stops").worst, made.scenario.robot->joints[6].name);
  EXPECT_NEAR(made.check("stops").margin, 0.001, kCaseRounding);
  EXPECT_EQ(made.check("stops").unit, "") << "the share decides";
  EXPECT_NEAR(made.check("stops").margin_of(0.018), 0.001, kCaseRounding) << "another angle leaves the time";
  made.record.joints[4].range_worst = 0.02;
  EXPECT_EQ(made.check("stops").worst, made.scenario.robot->joints[4].name);
  EXPECT_NEAR(made.check("stops").margin, -1, kCaseRounding);
  EXPECT_EQ(made.check("stops").unit, "rad");
}

/// Hinges without a motor decide the check of stops where they fail by more than the joints with a motor, or where none of
/// these is beyond its range.
TEST(CheckCases, HingesWithoutMotorRestOnTheirStops) {
  const auto stops = [](double without, double with) {
    Case made = gait();
    rests_on_stop(without)(made);
    made.record.joints[4].range_worst = with;
    return made.check("stops");
  };
  const std::string hinge = gait().scenario.robot->joints[kChanged].name;
  const std::string driven = gait().scenario.robot->joints[4].name;
  EXPECT_EQ(stops(0, 0).worst, "");
  EXPECT_EQ(stops(0.04, 0).worst, hinge);
  EXPECT_EQ(stops(0.04, 0).parts, 0U);
  EXPECT_EQ(stops(0.04, 0).status, CheckStatus::pass);
  EXPECT_EQ(stops(0.06, 0).parts, 1U);
  EXPECT_EQ(stops(0.04, 0.005).worst, driven) << "of two that do not fail";
  EXPECT_EQ(stops(0.04, 0.02).worst, driven);
  EXPECT_EQ(stops(0.06, 0.03).worst, driven) << "200 % more than its limit, the hinge 20 %";
  EXPECT_EQ(stops(0.2, 0.03).worst, hinge) << "300 %";
  EXPECT_TRUE(contains(stops(0.2, 0.03).text, "1 hinge without a motor is pressed far beyond the stop"))
      << stops(0.2, 0.03).text;
}

TEST(CheckCases, TightestIsTheLeastMarginOfThoseThatFail) {
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
  EXPECT_NEAR(close.judged().tightest()->margin, 0.005, kCaseRounding);
}

/// The first of several failed checks with equal margins decides. A failed check of the robot as a whole precedes all others.
TEST(CheckCases, DecidedByTheFirstOfEqualMargins) {
  const auto with = [](bool falls) {
    Case made = rated_gait();
    tick(kTorquePeak, 10)(made);
    joint(&JointStatistics::range_worst, 0.02)(made);
    if (falls) sinks(0.49)(made);
    return made.judged();
  };
  EXPECT_EQ(with(false).failures().front()->margin, with(false).failures().back()->margin);
  EXPECT_EQ(with(false).decided_by, "gear_peak");
  EXPECT_EQ(with(true).decided_by, "fall");
}

/// A spread of margins makes a passed check `too close` if one of its margins is beyond the limit or unknown.
TEST(CheckCases, ASpreadMakesTooCloseWhatItBringsToTheOtherSide) {
  Case made = rated_gait();
  const auto with = [&](SpilledVector<double> margins) {
    made.record.spread = Trace{{{report::margin_column("voltage"), "", ""}}, std::move(margins)};
    return made.check("voltage");
  };
  EXPECT_EQ(with({0.5, 0.4, 0.3, 0.6}).status, CheckStatus::pass);
  const Check other_side = with({0.5, 0.4, -0.1, 0.6});
  EXPECT_EQ(other_side.status, CheckStatus::too_close);
  EXPECT_TRUE(contains(other_side.text, "in 4 rollouts that differ by next to nothing, the margin is -10 % to 60 %"))
      << other_side.text;
  const Check diverged = with({0.5, 0.4, std::nan(""), 0.6});
  EXPECT_EQ(diverged.status, CheckStatus::too_close);
  EXPECT_TRUE(contains(diverged.text, "in 4 rollouts that differ by next to nothing, this check cannot judge 1 of them"))
      << diverged.text;
}

TEST(CheckCases, EachIsWhole) {
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
