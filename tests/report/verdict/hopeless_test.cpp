// Tests of hopeless runs: values and times of lost checks of incomplete recordings.
#include "report/verdict/hopeless.h"

#include <array>

#include "tests/report/verdict/checks/check_changes.h"

namespace gaitlab::test {
namespace {

/// The first 6 s of a run of 12 s whose set points have a period of 1 s. No motor is at a limit, and no joint is off its set
/// point or beyond its range.
const Case& half_run() {
  static const Case kMade = [] {
    Case made{shipped("caterpillar.yaml", {"duration=6", "physics.engine=articulated", "physics.estimate=off",
                                           "cpg.frequency=1", "cpg.amplitude=0.1"})};
    made.scenario.duration = 12;
    for (std::size_t row = 0; row <= made.last_tick(); ++row) {
      for (std::size_t j = 0; j < made.record.joints.size(); ++j) {
        for (const TickColumn column : {kVoltageLimited, kCurrentLimited, kErrorPeak}) made.tick(row, j, column) = 0;
      }
    }
    for (JointStatistics& joint : made.record.joints) joint.range_share = joint.range_worst = 0;
    return made;
  }();
  return kMade;
}

/// True if the check is lost after a change, for a margin of at least `least` against the scenario's limit or another one.
bool lost_after(const std::string& check, const Change& change, double least = 0, const std::string& limit = "") {
  Case made = half_run();
  change(made);
  const std::array needed{NeededMargin{"evidence", "margin.evidence", 0},
                          NeededMargin{check, "margin." + check + limit, least}};
  const LostCheck lost = lost_check(needed, made.scenario, made.record);
  EXPECT_TRUE(lost.check.empty() || lost.check == check) << lost.check;
  return !lost.check.empty();
}

/// Change of a row of ticks at time t, s.
Change error_at_time(double t, double error) {
  return [=](Case& made) {
    std::size_t row = 0;
    while (made.time(row) < t) ++row;
    made.tick(row, kChanged, kErrorPeak) = error;
  };
}

/// Lowers the robot by 1 m in the row at time t, s.
Change falls_at(double t) {
  return [=](Case& made) {
    std::size_t row = 0;
    while (made.time(row) < t) ++row;
    made.pose("base.z", row) -= 1;
  };
}

Change unchanged() {
  return [](Case&) {};
}

TEST(Hopeless, NoCheckOfASoundRun) {
  for (const CheckKind& kind : check_kinds()) EXPECT_FALSE(lost_after(kind.id, unchanged())) << kind.id;
}

/// The limit is 1 % of the time.
TEST(Hopeless, AShareBeyondFiveTimesItsLimit) {
  EXPECT_FALSE(lost_after("voltage", rate(kVoltageLimited, 0.049)));
  EXPECT_TRUE(lost_after("voltage", rate(kVoltageLimited, 0.051)));
  EXPECT_TRUE(lost_after("current", rate(kCurrentLimited, 0.051)));
  EXPECT_FALSE(lost_after("voltage", [](Case& made) { grow(made, kVoltageLimited, 1, 0, 1.9); })) << "in the first two periods";
  EXPECT_FALSE(lost_after("stops", joint(&JointStatistics::range_worst, 0.049)));
  EXPECT_TRUE(lost_after("stops", joint(&JointStatistics::range_worst, 0.051)));
}

TEST(Hopeless, AShareThatTheRestOfALongRunCanReduceIsNotLost) {
  const auto of_minutes = [](double share) {
    return [=](Case& made) {
      made.scenario.duration = 600;
      rate(kVoltageLimited, share)(made);
    };
  };
  EXPECT_FALSE(lost_after("voltage", of_minutes(0.5)));
}

/// The check fails beyond 0.2 rad, twice limits.tracking_error.
TEST(Hopeless, APeakBeyondOneAndAHalfTimesItsLimit) {
  EXPECT_FALSE(lost_after("tracking", error_at_time(5, 0.299)));
  EXPECT_TRUE(lost_after("tracking", error_at_time(5, 0.301)));
  EXPECT_FALSE(lost_after("tracking", error_at_time(1.5, 9))) << "in the first two periods";
}

/// Poses of the last period and second are compared; earlier ones were compared in earlier calls.
TEST(Hopeless, AnExtremeBeyondItsLimit) {
  EXPECT_TRUE(lost_after("fall", falls_at(5.5)));
  EXPECT_TRUE(lost_after("in_ground", falls_at(5.5)));
  EXPECT_FALSE(lost_after("fall", falls_at(1.5)));
  EXPECT_FALSE(lost_after("upright", falls_at(5.5))) << "a robot may roll";
}

TEST(Hopeless, TheMarginThatAStudyNeeds) {
  EXPECT_FALSE(lost_after("tracking", error_at_time(5, 0.7), 0, "[0.5]"));
  EXPECT_TRUE(lost_after("tracking", error_at_time(5, 0.76), 0, "[0.5]"));
  EXPECT_FALSE(lost_after("tracking", error_at_time(5, 0.14), 0.5));
  EXPECT_TRUE(lost_after("tracking", error_at_time(5, 0.16), 0.5)) << "the half of the limit";
  EXPECT_FALSE(lost_after("tracking", error_at_time(5, 0.59), -1));
}

/// Two periods of 4 s have not passed after 4 s, and no period is known without a stated one.
TEST(Hopeless, NothingBeforeTwoPeriods) {
  Case made = walk();
  made.scenario.duration = 12;
  falls_at(3)(made);
  const std::array needed{NeededMargin{"fall", "margin.fall", 0}};
  EXPECT_TRUE(lost_check(needed, made.scenario, made.record).check.empty());
}

}  // namespace
}  // namespace gaitlab::test
