// Tests of the set points of the tripod gait: continuous for every duty factor and any number of legs.
#include "cpg/tripod.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "core/model/robot.h"
#include "core/robot_files/module_file.h"
#include "core/scenario/scenario.h"
#include "tests/folders.h"

namespace gaitlab::cpg {
namespace {

RobotInfo robot_of(const std::vector<std::array<int, 5>>& rows) {
  std::vector<Dock> docks;
  for (const auto& r : rows) docks.push_back({r[0], r[1], r[2], r[3], r[4], SourceLocation{"robot.dat", 1, 1}});
  const ModuleType mtran = read_module_file(std::string(gaitlab::test::source_folder()) + "/scenarios/modules/mtran.yaml").type;
  return info(assemble({mtran}, std::vector<std::size_t>(rows.size() + 1, 0), docks));
}

const std::vector<std::array<int, 5>> kHexapod = {{1, 1, 4, 0, 1}, {1, 2, 4, 1, 3}, {1, 3, 4, 2, 1}, {1, 4, 4, 3, 3},
                                                  {0, 5, 3, 0, 3}, {2, 6, 5, 0, 1}, {0, 7, 3, 2, 3}, {2, 8, 5, 2, 1},
                                                  {0, 9, 3, 4, 3}, {2, 10, 5, 4, 1}};
const std::vector<std::array<int, 5>> kQuadruped = {{1, 1, 4, 0, 1}, {1, 2, 4, 1, 3}, {0, 3, 3, 0, 3},
                                                    {2, 4, 5, 0, 1}, {0, 5, 3, 2, 3}, {2, 6, 5, 2, 1}};

std::vector<double> setpoints(const Tripod& gait, std::size_t joints, double t) {
  std::vector<double> q(joints);
  gait.output(t, {}, q);
  return q;
}

TEST(Tripod, SetPointsNeverJump) {
  for (const auto& rows : {kHexapod, kQuadruped}) {
    const RobotInfo robot = robot_of(rows);
    for (const auto order : {Tripod::Order::alternate, Tripod::Order::wave}) {
      for (const double duty : {0.5, 0.75, 0.95}) {
        Tripod::Settings settings;
        settings.model.order = order;
        settings.model.duty_factor = duty;
        settings.model.ramp = 0;
        const Tripod gait(robot, settings);
        // The largest speed is that of the swing, A pi / Ts, plus three tilts below pi / 4 within a fifth of the swing. In a
        // tick of 0.1 ms this is a tenth of the jumps of 0.15 rad that an earlier version had.
        const double swing = 2 * (1 - duty);
        const double fastest = (0.4 * std::numbers::pi + 3 * std::numbers::pi / 4 / 0.2) / swing;
        constexpr double kTick = 1e-4;
        std::vector<double> before = setpoints(gait, robot.joints.size(), 0);
        for (int k = 1; k <= 20000; ++k) {
          const std::vector<double> now = setpoints(gait, robot.joints.size(), kTick * k);
          for (std::size_t j = 0; j < now.size(); ++j) {
            ASSERT_LT(std::abs(now[j] - before[j]), fastest * kTick)
                << rows.size() << " docks, order " << static_cast<int>(order) << ", duty " << duty << ", joint " << j
                << ", t = " << kTick * k;
          }
          before = now;
        }
      }
    }
  }
}

TEST(Tripod, AlternatingWithHalfTheTimeOnTheGroundIsTheGaitThatWasTried) {
  const RobotInfo robot = robot_of(kHexapod);
  const Tripod gait(robot, {});
  // During stance the hip moves from +A to -A, and the ankle is -hip + d sin^2(pi u). During swing the ankle is -hip. Legs 6, 7
  // and 10 stand first; at t = 2.3 s, u = 0.3.
  const std::vector<double> q = setpoints(gait, robot.joints.size(), 2.3);
  const double lift = 0.4 * std::pow(std::sin(0.3 * std::numbers::pi), 2);
  for (const std::size_t m : {6U, 7U, 10U}) {
    EXPECT_NEAR(q[2 * m], 0.4 * (1 - 2 * 0.3), 1e-12);
    EXPECT_NEAR(q[2 * m + 1], -q[2 * m] + lift, 1e-12);
  }
  for (const std::size_t m : {5U, 8U, 9U}) {
    EXPECT_NEAR(q[2 * m], -0.4 * std::cos(0.3 * std::numbers::pi), 1e-12);
    EXPECT_NEAR(q[2 * m + 1], -q[2 * m], 1e-12);
  }
}

TEST(Tripod, AHingeAboutTheOppositeAxisTurnsTheOtherWay) {
  const RobotInfo robot = robot_of(kHexapod);
  const std::vector<double> q = setpoints(Tripod(robot, {}), robot.joints.size(), 2.3);
  for (std::size_t turned = 0; turned < q.size(); ++turned) {
    RobotInfo other = robot;
    for (double& along : other.joints[turned].axis) along = -along;
    const std::vector<double> found = setpoints(Tripod(other, {}), robot.joints.size(), 2.3);
    for (std::size_t j = 0; j < q.size(); ++j) EXPECT_EQ(found[j], j == turned ? -q[j] : q[j]) << robot.joints[j].name;
  }
}

TEST(Tripod, ASideDockOnALegIsItsKnee) {
  std::vector<std::array<int, 5>> rows = kHexapod;
  rows.push_back({0, 11, 5, 5, 0});  // module 11, docked sideways to leg 5
  const std::vector<Leg> legs = find_legs(robot_of(rows));
  EXPECT_EQ(legs.size(), 6U);
}

TEST(Tripod, AKneeNumberedBelowItsHipIsAKnee) {
  // A leg has two modules in a row and a third module docked sideways to the second. The second robot has the same legs with
  // reversed numbers.
  std::vector<std::array<int, 5>> rows = kQuadruped;
  rows.push_back({1, 7, 4, 3, 0});
  rows.push_back({0, 8, 5, 7, 0});
  const std::vector<Leg> legs = find_legs(robot_of(rows));
  ASSERT_EQ(legs.size(), 4U);
  for (auto& row : rows) {
    for (const std::size_t i : {1U, 3U}) row[i] = row[i] == 0 ? 0 : 9 - row[i];
  }
  const std::vector<Leg> turned = find_legs(robot_of(rows));
  ASSERT_EQ(turned.size(), 4U);
  for (std::size_t i = 0; i < legs.size(); ++i) {
    EXPECT_EQ(turned[i].modules.size(), legs[i].modules.size()) << i;
    EXPECT_EQ(turned[i].modules.front(), 9 - legs[i].modules.front()) << i;
    EXPECT_EQ(turned[i].left, legs[i].left) << i;
    EXPECT_EQ(turned[i].x, legs[i].x) << i;
    EXPECT_EQ(turned[i].length, legs[i].length) << i;
  }
}

}  // namespace
}  // namespace gaitlab::cpg
