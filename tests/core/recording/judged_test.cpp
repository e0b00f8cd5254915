#include "core/recording/judged.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gaitlab {
namespace {

constexpr double kTick = 0.1;         // time between rows of ticks, s
constexpr double kLongPeriod = 1000;  // s, longer than any of the runs

/// Recording of two joints with a row of ticks every 0.1 s for 10 s. Joint 0 has 1 N m and joint 1 has 2 N m; individual
/// tests change other values.
Recording ticks_of_ten_seconds() {
  Recording r;
  r.simulated = 10;
  r.joints.resize(2);
  r.ticks.columns = tick_columns(2);
  for (int k = 0; k <= 100; ++k) {
    const double t = k * kTick;
    r.ticks.values.insert(r.ticks.values.end(), {t, 1,    0.01, 0,     1 * t, 0, 0,   0.5, 0.3,     0.2 * t, 3,  0.4,  //
                                                 2, 0.02, 0,    4 * t, 0,     0, 0.6, 0.4, 0.8 * t, 4,       0.8});
  }
  return r;
}

double& cell(Recording& r, int row, std::size_t joint, std::size_t which) {
  return r.ticks.values[static_cast<std::size_t>(row) * r.ticks.columns.size() + 1 + joint * kTickColumns + which];
}

/// Sets a joint at a limit from row `from` to row `to`.
void limit(Recording& r, std::size_t joint, std::size_t which, int from, int to) {
  for (int k = 0; k <= 100; ++k) cell(r, k, joint, which) = kTick * (std::clamp(k, from, to) - from);
}

MotionCycle cycle(double from, double period) { return {true, from, period, 0.001}; }

TEST(Judged, KnowsWhatAMotorGaveAndTook) {
  Recording r = ticks_of_ten_seconds();
  cell(r, 30, 1, kEnvelopePeak) = 0.9;
  cell(r, 40, 1, kSpeedPeak) = 7;
  cell(r, 2, 1, kSpeedPeak) = 9;  // before the window
  const JudgedJoint j = judge(r, cycle(1, 2.5), kLongPeriod).joints[1];
  EXPECT_EQ(j.envelope_peak, 0.9);
  EXPECT_DOUBLE_EQ(j.envelope_peak_time, 3);
  EXPECT_EQ(j.speed_peak, 7);
  EXPECT_DOUBLE_EQ(j.speed_peak_time, 4);
  EXPECT_NEAR(j.current_rms, std::sqrt(0.8), 1e-12);  // rounding errors of sums of about 10
  EXPECT_EQ(j.voltage_peak, 4);
  EXPECT_EQ(j.current_peak, 0.8);
}

TEST(Judged, LeavesOutTheFirstPeriod) {
  const Recording r = ticks_of_ten_seconds();
  const Judged early = judge(r, cycle(1, 2.5), kLongPeriod);  // 9 s contain three whole periods
  EXPECT_DOUBLE_EQ(early.from, 2.5);
  EXPECT_DOUBLE_EQ(early.to, 10);
  EXPECT_EQ(early.periods, 3U);
  const Judged late = judge(r, cycle(7, 2.5), kLongPeriod);  // a late start of the limit cycle does not delay the window
  EXPECT_DOUBLE_EQ(late.from, 2.5);
  EXPECT_EQ(late.periods, 3U);
  const Judged whole = judge(r, cycle(0, 2.5), kLongPeriod);
  EXPECT_DOUBLE_EQ(whole.from, 2.5);
  EXPECT_EQ(whole.periods, 3U);
  const Judged later = judge(r, cycle(0, 2.5), 0, 1.1);  // 8.9 s are three whole periods and a part of one
  EXPECT_DOUBLE_EQ(later.from, 5);
  EXPECT_EQ(later.periods, 2U);
}

/// The set points' period replaces the period of a limit cycle. A single period is not sufficient.
TEST(Judged, HoldsWholePeriodsOfTheSetPoints) {
  const Recording r = ticks_of_ten_seconds();
  EXPECT_DOUBLE_EQ(judge(r, {}, 3).from, 4);
  EXPECT_EQ(judge(r, {}, 3).periods, 0U);
  EXPECT_DOUBLE_EQ(judge(r, {}, 5).from, 5);
  EXPECT_DOUBLE_EQ(judge(r, {}, 6).from, 2);
  EXPECT_DOUBLE_EQ(judge(r, {}, 2, 5).from, 8);
}

/// The end of a run decides only how much more than one period is left out.
TEST(Judged, LeavesOutOneToTwoPeriods) {
  Recording r = ticks_of_ten_seconds();
  for (int tenth = 50; tenth < 100; ++tenth) {
    const double end = 0.1 * tenth;
    for (const double from : {0.0, 0.3, 0.89, 1.9, 4.0}) {
      r.simulated = end;
      const Judged j = judge(r, cycle(from, 2), kLongPeriod);
      EXPECT_GE(j.from, 2 * 0.999) << end << " " << from;
      EXPECT_LE(j.from, 4) << end << " " << from;
      EXPECT_NEAR(j.to - j.from, 2.0 * static_cast<double>(j.periods), 1e-9) << end << " " << from;
    }
  }
}

/// Peaks of a motor at its limit differ only by rounding errors. The time of the first peak counts.
TEST(Judged, RoundingIsNoPeak) {
  Recording r = ticks_of_ten_seconds();
  for (int k = 0; k <= 100; ++k) cell(r, k, 0, kTorquePeak) = 3 * (1 + 1e-16 * k);
  for (int k = 0; k <= 100; ++k) cell(r, k, 1, kTorquePeak) = 3 * (1 + 4e-16);
  const Judged j = judge(r, {}, kLongPeriod);
  EXPECT_EQ(Judged::strongest(j.joints), 0U);
  EXPECT_NEAR(j.joints[0].torque_peak_time, 2.1, 1e-9);
}

TEST(Judged, WithoutALimitCycleTheStartIsAFifthOrTwoSeconds) {
  Recording r = ticks_of_ten_seconds();
  EXPECT_DOUBLE_EQ(judge(r, {}, kLongPeriod).from, 2);
  EXPECT_EQ(judge(r, {}, kLongPeriod).periods, 0U);
  r.simulated = 5;
  EXPECT_DOUBLE_EQ(judge(r, {}, kLongPeriod).from, 1);
  r.simulated = 100;
  EXPECT_DOUBLE_EQ(judge(r, {}, kLongPeriod).from, 2);
}

/// If the set points do not repeat (keyframes that are played once), the whole run is judged.
TEST(Judged, WithoutSetPointsThatRepeatTheWholeRunCounts) {
  const Recording r = ticks_of_ten_seconds();
  const Judged whole = judge(r, {}, 0);
  EXPECT_DOUBLE_EQ(whole.from, 0);
  EXPECT_EQ(whole.first_row, 0U);
  EXPECT_EQ(whole.periods, 0U);
}

/// The first of the joints at a limit is the joint with the longest time at the limit. (All have equal peaks, and the joint
/// with the lowest number was once first.)
TEST(Judged, TheJointThatIsLongestAtALimitComesFirst) {
  Recording r = ticks_of_ten_seconds();
  for (int k = 0; k <= 100; ++k) cell(r, k, 0, 0) = cell(r, k, 1, kTorquePeak) = 2;
  EXPECT_EQ(judge(r, {}, kLongPeriod).order.front(), 1U) << "without limits: by RMS";
  EXPECT_EQ(Judged::limited(judge(r, {}, kLongPeriod).joints), 0U);
  limit(r, 0, kCurrentLimited, 50, 60);  // current limit for 1 s of 8 s
  const Judged j = judge(r, {}, kLongPeriod);
  EXPECT_EQ(j.order.front(), 0U);
  EXPECT_EQ(Judged::limited(j.joints), 1U);
  EXPECT_NEAR(j.joints[0].current_limited, 1.0 / 8, 1e-12);
  EXPECT_EQ(j.joints[0].voltage_limited, 0);
  limit(r, 1, kVoltageLimited, 20, 100);  // voltage limit in the whole window
  EXPECT_EQ(judge(r, {}, kLongPeriod).order.front(), 1U);
  EXPECT_NEAR(judge(r, {}, kLongPeriod).joints[1].limited(), 1, 1e-12);
}

TEST(Judged, NothingOfTheStartCounts) {
  Recording r = ticks_of_ten_seconds();
  cell(r, 3, 0, 0) = 50;
  cell(r, 3, 0, 1) = 5;
  limit(r, 0, kVoltageLimited, 1, 15);
  const Judged j = judge(r, {}, kLongPeriod);
  EXPECT_DOUBLE_EQ(j.joints[0].torque_peak, 1);
  EXPECT_DOUBLE_EQ(j.joints[0].error_peak, 0.01);
  EXPECT_EQ(Judged::limited(j.joints), 0U);
  EXPECT_EQ(Judged::limited(j.whole), 1U);
  EXPECT_DOUBLE_EQ(j.whole[0].torque_peak, 50);
  EXPECT_NEAR(j.joints[0].torque_rms, 1, 1e-12);
  EXPECT_NEAR(j.joints[1].torque_rms, 2, 1e-12);
}

TEST(Judged, PeaksHaveTheirTimesAndSayWhetherTheyAreTheLimit) {
  Recording r = ticks_of_ten_seconds();
  cell(r, 40, 0, 0) = 3;
  cell(r, 70, 0, 1) = 0.5;
  EXPECT_EQ(judge(r, {}, kLongPeriod).joints[0].peak_limit, MotorLimit::none);
  cell(r, 40, 0, kPeakLimit) = 2;  // at the limit for an instant without a duration
  EXPECT_EQ(Judged::limited(judge(r, {}, kLongPeriod).joints), 1U);
  const Judged j = judge(r, {}, kLongPeriod);
  EXPECT_DOUBLE_EQ(j.joints[0].torque_peak, 3);
  EXPECT_NEAR(j.joints[0].torque_peak_time, 4, 1e-12);
  EXPECT_EQ(j.joints[0].peak_limit, MotorLimit::current);
  EXPECT_EQ(j.joints[0].first_limit, MotorLimit::current);
  EXPECT_NEAR(j.joints[0].first_limit_time, 4, 1e-12);
  EXPECT_EQ(Judged::first(j.joints), 0U);
  EXPECT_DOUBLE_EQ(j.joints[0].error_peak, 0.5);
  EXPECT_NEAR(j.joints[0].error_peak_time, 7, 1e-12);
  EXPECT_EQ(Judged::farthest(j.joints), 0U);
  EXPECT_EQ(Judged::strongest(j.joints), 0U);
}

TEST(Judged, WithoutTicksThereAreJointsAllTheSame) {
  Recording r;
  r.joints.resize(3);
  const Judged j = judge(r, {}, kLongPeriod);
  EXPECT_EQ(j.joints.size(), 3U);
  EXPECT_EQ(j.order.size(), 3U);
  EXPECT_EQ(judge({}, {}, kLongPeriod).order.size(), 0U);
}

}  // namespace
}  // namespace gaitlab
