// Cases of checks that the table has no row for, and their margins.
#include <cmath>
#include <limits>

#include "report/analysis/motors.h"
#include "tests/report/verdict/check_changes.h"

namespace gaitlab::test {
namespace {

constexpr double kCaseRounding = 1e-9;  // of quotients of numbers near 1

CheckStatus status_after(const char* id, const Change& change) { return changed(id, change).status; }

TEST(CheckCases, OutcomeIsAnEndBeforeTheEnd) {
  EXPECT_EQ(status_after("outcome", [](Case&) {}), CheckStatus::pass);
  const Check early = changed("outcome", [](Case& made) { made.record.outcome = {Ended::diverged, "diverged at step 3"}; });
  EXPECT_EQ(early.status, CheckStatus::fail);
  EXPECT_EQ(early.limit, 12);
}

/// Nothing is asked for: a robot that neither goes nor turns is warned of, by a hundredth of its extent and 0.01 rad a period.
TEST(CheckCases, ProgressIsAWayOrATurn) {
  const auto status = [](double extents, double turn) {
    return status_after("progress", [=](Case& made) {
      goes(extents)(made);
      made.scenario.limits.progress = 0;
      const Judged judged = summarise(made.scenario, made.record, 0).judged;
      const double rate = turn * static_cast<double>(judged.periods) / (judged.to - judged.from);
      for (std::size_t row = 0; row < made.record.poses.rows(); ++row) {
        made.pose("base.qw", row) = std::cos(rate * made.pose("t", row) / 2);
        made.pose("base.qz", row) = std::sin(rate * made.pose("t", row) / 2);
        made.pose("base.qx", row) = made.pose("base.qy", row) = 0;
      }
    });
  };
  EXPECT_EQ(status(0.0101, 0), CheckStatus::pass);
  EXPECT_EQ(status(0.0099, 0), CheckStatus::warn);
  EXPECT_EQ(changed("progress", goes(1, true)).status, CheckStatus::fail) << "before the window";
  EXPECT_EQ(status(0, 0.0103), CheckStatus::pass) << "the window begins at a tick";
  EXPECT_EQ(status(0, -0.0103), CheckStatus::pass);
  EXPECT_EQ(status(0, 0.0097), CheckStatus::warn);
  // Without periods ten times that, in the whole window.
  const auto without = [](double extents) {
    return status_after("progress", [=](Case& made) {
      const double speed = extents * extent_of_gait() / (12 - left_out_start(12));
      for (std::size_t row = 0; row < made.record.poses.rows(); ++row) {
        made.pose("com.x", row) = speed * made.pose("t", row);
        made.pose("com.y", row) = 0;
        for (const char* column : {"base.qw", "base.qx", "base.qy", "base.qz"}) made.pose(column, row) = made.pose(column, 0);
      }
      made.also = [](Summary& summary, Overlaps&) {
        summary.judged.periods = 0;
        summary.judged.from = left_out_start(12);
      };
    });
  };
  EXPECT_EQ(without(0.102), CheckStatus::pass);
  EXPECT_EQ(without(0.098), CheckStatus::warn);
}

/// Gravity gives more than the motors, and the second half of the judged time is more than 1.2 times as fast as the first.
TEST(CheckCases, ProgressIsNoSlide) {
  const Judged judged = summarise(rated_gait().scenario, rated_gait().record, 0).judged;
  const double period = (judged.to - judged.from) / static_cast<double>(judged.periods);
  const auto slides_down = [&](double faster, double height, std::size_t periods = 2, double lacks = 0) {
    return changed("progress", [=](Case& made) {
      // Two whole periods up to the end; of three and more the middle is in both halves.
      made.also = [=](Summary& summary, Overlaps&) {
        summary.judged.periods = periods;
        summary.judged.from = judged.to - 2 * period;
        if (periods == 1) summary.judged.from = judged.to - judged.to / (2 - lacks);
      };
      const double half = judged.to - period;
      double driven = 0;
      for (const JointStatistics& one : made.record.joints) driven += one.shaft;
      const double weight = made.scenario.robot->mass * made.scenario.physics.gravity.norm();
      for (std::size_t row = 0; row < made.record.poses.rows(); ++row) {
        const double t = made.pose("t", row);
        made.pose("com.x", row) = t < half ? t : half + faster * (t - half);
        made.pose("com.y", row) = 0;
        made.pose("com.z", row) = -height * std::max(driven, 1e-3 * weight) / weight * (t - half + period) / (2 * period);
      }
    });
  };
  const Check slide = slides_down(1.22, 1.05);
  EXPECT_EQ(slide.status, CheckStatus::fail) << slide.text;
  EXPECT_NEAR(slide.value, 1.22, 0.01);
  EXPECT_EQ(slide.limit, 1.2);
  EXPECT_LT(slide.margin, 0);
  EXPECT_EQ(slides_down(1.18, 1.05).status, CheckStatus::pass);
  EXPECT_EQ(slides_down(1.22, 0.95).status, CheckStatus::pass);
  EXPECT_EQ(slides_down(0.8, 1.05).status, CheckStatus::pass);
  // A period alone is compared with the one before, which may lack a thousandth.
  EXPECT_EQ(slides_down(2, 1.7, 1, 0.9e-3).status, CheckStatus::fail);
  EXPECT_EQ(slides_down(2, 1.7, 1, 1.2e-3).status, CheckStatus::pass);
}

/// What a maker allows holds from the first step on, and what the motor reaches in the window.
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

/// A tick is airborne whose load is less than 5 % of the weight, of the ticks in the window.
TEST(CheckCases, AirborneIsATickWithoutLoad) {
  const auto with = [](double share, bool early = false) {
    return changed("airborne", [=](Case& made) {
      const double weight = made.scenario.robot->mass * made.scenario.physics.gravity.norm();
      const std::size_t rows = made.record.poses.rows();
      for (std::size_t row = 0; row < rows; ++row) made.pose("load", row) = weight;
      made.pose("load", early ? 1 : rows - 1) = share * weight;
    });
  };
  EXPECT_EQ(with(0.0499).status, CheckStatus::warn);
  EXPECT_LT(with(0.0499).margin, 0);
  EXPECT_EQ(with(0.0501).status, CheckStatus::pass);
  EXPECT_EQ(with(0, true).status, CheckStatus::pass) << "before the window";
}

TEST(CheckCases, StabilityIsOfTheWindow) {
  const auto least = [](std::size_t row) {
    return changed("stability",
                   [=](Case& made) {
                     for (std::size_t k = 0; k < made.record.loads.rows(); ++k)
                       made.load("stability", k) = k == row ? -0.03 : 0.02;
                   })
        .value;
  };
  EXPECT_EQ(least(1), 0.02);
  EXPECT_EQ(least(rated_gait().last_tick()), -0.03);
}

/// The edge of a field is on it; the time is that of the first tick beside it.
TEST(CheckCases, FieldEndsAtItsEdge) {
  const auto with = [](const char* column, double at) {
    return changed("field", [=](Case& made) {
      made.scenario.ground.kind = Ground::Kind::heightfield;
      made.scenario.ground.field = {Vec3(-1, -2, 0), 1, 3, std::vector<double>(15, 0.0)};  // to x = 1, y = 2
      for (std::size_t row = 0; row < made.record.poses.rows(); ++row) made.pose("com.x", row) = made.pose("com.y", row) = 0;
      made.pose(column, 1) = at;
      made.pose(column, 2) = at;
    });
  };
  for (const auto& [column, edge] : {std::pair{"com.x", 1.0}, {"com.x", -1.0}, {"com.y", 2.0}, {"com.y", -2.0}}) {
    EXPECT_EQ(with(column, edge).status, CheckStatus::pass) << column;
    EXPECT_EQ(with(column, 1.001 * edge).status, CheckStatus::warn) << column;
    EXPECT_EQ(with(column, 1.001 * edge).first, rated_gait().time(1)) << column;
  }
}

/// Shapes that are deeper in one another than limits.touch collide, by whatever angles they come there.
TEST(CheckCases, CollisionsAreDeeperThanATouch) {
  Scenario s = scenario(
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0]], position: [0, 0, 1]}\n"
      "duration: 0.001\nphysics: {engine: articulated}\nactuator: {type: none}\nground: {type: none}\n");
  const Recording record = run(s);
  const double usual = s.limits.touch;
  const auto depth = [&](double angle, double touch) {
    Recording bent = record;
    for (std::size_t row = 0; row < bent.poses.rows(); ++row) {
      for (std::size_t j = 0; j < s.robot->joints.size(); ++j)
        bent.poses.values[row * bent.poses.columns.size() + 8 + j] = angle;
    }
    s.limits.touch = touch;
    const Overlaps found = overlaps(s, bent);
    return found.collision ? found.collision->depth : 0;
  };
  double apart = 0.6;
  double deep = 1.2;
  while (deep - apart > 1e-6) {
    const double middle = (apart + deep) / 2;
    (depth(middle, 1e-6) > 5e-4 ? deep : apart) = middle;
  }
  const double angle = (apart + deep) / 2;
  EXPECT_NEAR(depth(angle, 1e-6), 5e-4, 1e-5);
  EXPECT_EQ(depth(angle - 1e-4, usual), 0);
  EXPECT_GT(depth(angle + 1e-4, usual), 5e-4);
  EXPECT_LT(depth(angle + 1e-4, 1e-6), 6.5e-4) << "else a limit a third larger is not noticed";
}

/// Of each kind of check the part that is worst, how many are beyond their limit, and which was first.
TEST(CheckCases, SaturationNamesItsJoints) {
  const auto with = [](double second, double fifth) {
    Case made = rated_gait();
    made.scenario.limits.saturated_periods = 1e6;
    for (std::size_t k = 0; k <= made.last_tick(); ++k) {
      made.tick(k, 2, kVoltageLimited) = second * std::max(0.0, made.time(k) - 9);
      made.tick(k, kJoint, kVoltageLimited) = fifth * std::max(0.0, made.time(k) - 10);
    }
    return made.check("voltage");
  };
  const std::vector<Joint>& joints = rated_gait().scenario.robot->joints;
  EXPECT_EQ(with(0.1, 0.2).worst, joints[kJoint].name);
  EXPECT_EQ(with(0.2, 0.1).worst, joints[2].name);
  EXPECT_EQ(with(0.2, 0.1).parts, 2U);
  EXPECT_EQ(with(0, 0.1).parts, 1U);
  EXPECT_EQ(with(0, 0).parts, 0U);
  EXPECT_EQ(with(0.1, 0.2).first_part, joints[2].name);
  EXPECT_NEAR(with(0.1, 0.2).first, 9, 0.016);
  EXPECT_TRUE(std::isnan(with(0, 0).first));
  EXPECT_EQ(with(0, 0).value, 0);
}

/// A row that is at the limit but for a thousandth is so all the while.
TEST(CheckCases, AStretchHasNoGaps) {
  const auto status = [](double part) {
    return status_after("current", [=](Case& made) {
      made.scenario.limits.saturated_share = 1;
      double sum = 0;
      for (std::size_t k = made.last_tick() - 5; k <= made.last_tick(); ++k)
        made.tick(k, kJoint, kCurrentLimited) = sum += part * (made.time(k) - made.time(k - 1));
    });
  };
  EXPECT_EQ(status(0.9995), CheckStatus::fail);
  EXPECT_EQ(status(0.99), CheckStatus::warn);
}

TEST(CheckCases, FirstIsWhenAPartWasBeyondItsLimitFirst) {
  Case made = rated_gait();
  const double later = made.time(20);
  made.tick(20, 2, kTorquePeak) = 5.1;
  made.tick(30, kJoint, kTorquePeak) = 6;
  made.tick(10, kJoint, kTorquePeak) = 4.9;
  EXPECT_EQ(made.check("gear_peak").first, later);
  EXPECT_EQ(made.check("gear_peak").first_part, made.scenario.robot->joints[2].name);
  EXPECT_EQ(made.check("gear_peak").worst, made.scenario.robot->joints[kJoint].name);
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

/// Loads below 1e-9 N are rounding.
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

/// Who goes less than 10 mm does not walk.
TEST(CheckCases, SlipIsOfAWay) {
  const auto status = [](double way) {
    return status_after("slip", [=](Case& made) {
      slides(0.1)(made);
      made.load("path", made.record.loads.rows() - 1) = way;
    });
  };
  EXPECT_EQ(status(0.0099), CheckStatus::not_judged);
  EXPECT_NE(status(0.0101), CheckStatus::not_judged);
}

/// The time of what lasts less than 0.1 s is said.
TEST(CheckCases, SentencesTellInstants) {
  Check made = changed("gear_peak", tick(kTorquePeak, 6));
  made.from = 3;
  made.to = 3.09;
  EXPECT_TRUE(contains(made.sentence(), ", at 3.00 s")) << made.sentence();
  made.to = 3.11;
  EXPECT_FALSE(contains(made.sentence(), ", at 3.00 s")) << made.sentence();
}

/// The margin is continuous across the limit, and the worst joint is the one with the least.
TEST(CheckCases, WorstIsTheLeastMargin) {
  Case made = gait();
  made.record.joints[4].range_worst = 0.009;    // 90 % of the angle
  made.record.joints[6].range_share = 0.00999;  // 99.9 % of the time
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

/// Every check comes with what a reader and a search need of it.
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
