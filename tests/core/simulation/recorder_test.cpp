// Tests of the rows that a recorder adds and of the rows that it omits.
#include "core/simulation/recorder.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/random_robots.h"

namespace gaitlab {
namespace {

/// Scenario with a control tick every 15 ms, and its recorder.
struct Recorded {
  explicit Recorded(Records wanted = {}) {
    scenario.robot = std::make_shared<const Robot>(test::RandomRobots(3).robot_of(2));
    scenario.duration = 1;
    scenario.trace.columns = {"base.*"};
    sample = std::make_unique<Sample>(*scenario.robot, 0, 0);
    recorder = std::make_unique<Recorder>(scenario, contacts, nullptr, "", *sample, wanted);
  }
  Scenario scenario;
  std::vector<ContactElement> contacts;
  std::unique_ptr<Sample> sample;
  std::unique_ptr<Recorder> recorder;
};

TEST(RecorderRows, AreThoseOfTheTrace) {
  Recorded made;
  made.sample->t = 0.5;
  made.recorder->add_row();
  const Trace& trace = made.recorder->recording.trace;
  ASSERT_EQ(trace.rows(), 1U);
  EXPECT_EQ(trace.at(0, 0), 0.5);
  EXPECT_EQ(made.recorder->rows_needed().columns,
            static_cast<double>(trace.columns.size() + made.recorder->recording.rest.columns.size()));
}

TEST(RecorderRows, AreNoneWhereTheyAreNotWanted) {
  const Recorded made({Loads::left_out, false});
  EXPECT_FALSE(made.recorder->has_rows());
  EXPECT_EQ(made.recorder->rows_needed().columns, 0);
}

TEST(RecorderTicks, HaveOneRowAtATime) {
  Recorded made;
  EXPECT_TRUE(made.recorder->add_tick(0, false));
  EXPECT_FALSE(made.recorder->add_tick(0, true)) << "a run that ends at a tick";
  EXPECT_TRUE(made.recorder->add_tick(0.015, true));
  EXPECT_EQ(made.recorder->recording.ticks.rows(), 2U);
  EXPECT_FALSE(made.recorder->loads_due()) << "nobody wants loads";
}

TEST(RecorderTicks, BecomeHalfAsManyWhenTheyAreTooMany) {
  Recorded made;
  Recorder& recorder = *made.recorder;
  for (std::size_t k = 0; k <= kMostTickRows; ++k, ++recorder.recording.control_ticks) {
    ASSERT_TRUE(recorder.tick_due());
    ASSERT_TRUE(recorder.add_tick(0.015 * static_cast<double>(k), false));
  }
  EXPECT_EQ(recorder.recording.ticks.rows(), kMostTickRows + 1);
  EXPECT_FALSE(recorder.add_tick(0.015 * (kMostTickRows + 1), false)) << "an odd tick";
  EXPECT_EQ(recorder.recording.ticks.rows(), kMostTickRows / 2 + 1);
  EXPECT_FALSE(recorder.tick_due());
}

/// The centre of mass moves 1 mm to and fro at every tick. If only every second tick has a row, it is at the same place in all
/// rows.
TEST(RecorderLoads, CountTheTicksWithoutARow) {
  Recorded made({Loads::judged, false});
  Recorder& recorder = *made.recorder;
  constexpr std::size_t kTicks = 2 * kMostTickRows + 11;
  for (std::size_t k = 0; k < kTicks; ++k, ++recorder.recording.control_ticks) {
    recorder.tick_due() ? static_cast<void>(recorder.add_tick(0.015 * static_cast<double>(k), false)) : recorder.skip_tick();
    ASSERT_TRUE(recorder.loads_due());
    recorder.loads().sample().sums.com = {k % 2 == 0 ? 0 : 1e-3, 0, 0};
    recorder.add_loads();
    recorder.leave_out_loads();
  }
  const Trace& loads = recorder.recording.loads;
  EXPECT_EQ(loads.rows(), recorder.recording.ticks.rows());
  EXPECT_LE(loads.rows(), kMostTickRows + 1);
  constexpr std::size_t kLast = (kTicks - 1) / 4 * 4;  // the last tick with a row
  EXPECT_NEAR(loads.at(loads.rows() - 1, loads.columns.find("path")), 1e-3 * static_cast<double>(kLast), 1e-5)
      << "single precision, 6e-8 * 40 m";
}

TEST(RecorderPoses, HoldStateSetPointsAndLoad) {
  Recorded made;
  Sample& s = *made.sample;
  s.state.position = {1, 2, 3};
  s.state.q.assign(s.state.q.size(), 0.25);
  s.setpoint.assign(s.setpoint.size(), 0.5);
  s.contacts = {{.fn = 2}, {.fn = 5}};
  made.recorder->add_pose(0.1, s);
  const Trace& poses = made.recorder->recording.poses;
  ASSERT_EQ(poses.rows(), 1U);
  EXPECT_EQ(poses.at(0, 3), 3);
  EXPECT_EQ(poses.at(0, 8), 0.25);
  EXPECT_EQ(poses.at(0, poses.columns.size() - 1), 7);
}

}  // namespace
}  // namespace gaitlab
