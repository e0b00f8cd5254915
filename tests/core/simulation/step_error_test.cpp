// The estimate of the torque error agrees with numbers computed by hand.
#include "core/simulation/step_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace gaitlab {
namespace {

using Numbers = std::vector<double>;

/// SomeEstimate of the torque error with its buffers.
struct SomeEstimate {
  StateLayout layout;
  Numbers numbers;
  StepError error;

  SomeEstimate(StateLayout of, Numbers accuracy) : layout(of), numbers(StepError::size(of)), error(of, std::move(accuracy)) {
    error.bind(numbers);
  }
  void see(const Numbers& torque, double slope = 1) { error.see(torque, Numbers(torque.size(), slope)); }
  void compare(Companion which, const Numbers& torque, double t, double factor = 1, double weight = 1) {
    error.compare(which, torque, factor, weight, t);
  }
  [[nodiscard]] StepTally tally(std::size_t lane = 0) const {
    StepTally made;
    made.torque_error.resize(layout.joints);
    made.torque_peak.resize(layout.joints);
    error.put(lane, made);
    return made;
  }
};

TEST(StepError, IsAWeightedRmsTimesTheFactor) {
  SomeEstimate one({2, 1}, {0.5});
  one.see({3, -4});
  one.compare(Companion::twin, {1, -4}, 0.1, 2, 1);  // the differences are 4 and 0
  one.see({1, 0});
  one.compare(Companion::twin, {1, 3}, 0.2, 2, 3);  // the differences are 0 and 6
  const StepTally tally = one.tally();
  EXPECT_EQ(tally.torque_error, (Numbers{std::sqrt(16.0 / 4), std::sqrt(3 * 36.0 / 4)}));
  EXPECT_EQ(tally.torque_peak, (Numbers{3, 4}));
  EXPECT_EQ(tally.event.share, std::sqrt(27.0) / 4);
  EXPECT_EQ(tally.event.time, 0.1);
  EXPECT_EQ(tally.event.joint, 0U);
}

TEST(StepError, NeedsASlopeOrADifference) {
  SomeEstimate lanes({1, 3}, {0.1, 0.1, 0.1});
  lanes.error.see(Numbers{1, 1, 1}, Numbers{0, -1, 0});
  lanes.compare(Companion::coarse, {2, 1, 1}, 0.1);  // the coarse companion alone is not sufficient
  lanes.compare(Companion::twin, {1, 1, 2}, 0.1);
  EXPECT_FALSE(lanes.tally(0).estimated);
  EXPECT_TRUE(lanes.tally(1).estimated);
  EXPECT_TRUE(lanes.tally(2).estimated);
  EXPECT_EQ(lanes.tally(1).torque_error[0], 0);
  EXPECT_EQ(lanes.tally(2).torque_error[0], 1);
}

/// A joint stops in both rollouts, in the run a tenth of the interval earlier: the jump of 5 N m, for a tenth of the interval.
/// The difference at the comparison counts in an interval without a stop, and for a companion with another gravity.
TEST(StepError, AJumpAtAnotherTimeCountsForItsTime) {
  const StateLayout layout{1, 1};
  Numbers numbers(StepError::size(layout));
  StepError error(layout, {0.1}, {1});
  error.bind(numbers);
  const auto interval = [&](double run, double companion, double torque, double speed) {
    error.add(Numbers{run}, 1, 0);  // of the extrapolated steps
    error.add(Numbers{run + 1}, 0, 1);
    error.add(Companion::twin, Numbers{companion}, 1, 0);
    error.add(Companion::twin, Numbers{companion + 2}, 0, 1);  // a larger difference, which does not count
    error.see(Numbers{torque}, Numbers{1}, Numbers{speed});
    error.compare(Companion::twin, Numbers{torque + 0.25}, 2, 1, 0.1, Numbers{speed});
    error.compare(Companion::chaotic, Numbers{torque + 0.25}, 2, 1, 0.1, Numbers{speed});
  };
  const auto rms = [&] {
    StepTally made;
    made.torque_error.resize(1);
    made.torque_peak.resize(1);
    error.put(0, made);
    return made.torque_error[0];
  };
  interval(4, 4, 4, 1);
  EXPECT_DOUBLE_EQ(rms(), 2 * 0.25) << "the first interval has no beginning";
  interval(3, 3.5, -1, 0);
  EXPECT_DOUBLE_EQ(rms(), std::sqrt((0.25 + 2 * 5 * 0.5) / 2));
  interval(-1, -1, -1, 1);
  EXPECT_DOUBLE_EQ(rms(), std::sqrt((0.25 + 2 * 5 * 0.5 + 0.25) / 3)) << "to break away is no jump";
  StepTally tally;
  tally.torque_error.resize(1);
  tally.torque_peak.resize(1);
  error.put(0, tally);
  EXPECT_DOUBLE_EQ(tally.chaotic.share, 2 * 0.25 / 4);
}

TEST(StepError, AnEventIsBeyondThePeakOfTheWholeRun) {
  SomeEstimate one({1, 1}, {0.1});
  EXPECT_FALSE(one.tally().estimated);
  one.see({1});
  one.compare(Companion::twin, {1.25}, 1);
  EXPECT_EQ(one.tally().event.time, 1);
  one.see({10});  // the difference of a quarter becomes less than a tenth of the peak
  one.compare(Companion::twin, {10}, 2);
  EXPECT_LT(one.tally().event.time, 0);
  one.compare(Companion::twin, {12}, 3);
  one.compare(Companion::twin, {15}, 4);
  EXPECT_EQ(one.tally().event.time, 3) << "the first that lasts, not the largest";
}

TEST(StepError, ASmallPeakCountsAsAShareOfTheLargest) {
  SomeEstimate one({2, 1}, {0.1});
  one.see({100, 0.01});
  one.compare(Companion::twin, {100, 0.135}, 1);  // the difference 0.125 is below a tenth of 2 N m
  EXPECT_LT(one.tally().event.time, 0);
  EXPECT_NEAR(one.tally().event.share, 0.125 / 2, 1e-15);  // one rounding error of numbers of size 0.1
}

TEST(StepError, TheCompanionThatPartsFirstCounts) {
  SomeEstimate one({2, 1}, {0.1});
  one.see({1, 1});
  one.compare(Companion::coarse, {1, 2}, 1);
  one.compare(Companion::twin, {3, 1}, 2);
  EXPECT_EQ(one.tally().event.joint, 1U);
  EXPECT_EQ(one.tally().torque_error, (Numbers{2, 1}));
  EXPECT_LT(one.tally().chaotic.time, 0);

  SomeEstimate tie({2, 1}, {0.1});
  tie.see({1, 1});
  tie.compare(Companion::coarse, {1, 2}, 1);
  tie.compare(Companion::twin, {2, 1}, 1);
  EXPECT_EQ(tie.tally().event.joint, 0U) << "the finer one at equal times";
}

}  // namespace
}  // namespace gaitlab
