// Tests of the coupling rules with a hexapod: the joint that each joint follows, its lag, and the consistency of each rule.
#include "core/plugin/couplings.h"

#include <gtest/gtest.h>

#include <map>

#include "core/model/robot.h"
#include "core/robot_files/module_file.h"
#include "core/scenario/scenario.h"
#include "tests/folders.h"

namespace gaitlab {
namespace {

const RobotInfo& hexapod() {
  static const RobotInfo robot = [] {
    const std::string scenarios = std::string(gaitlab::test::source_folder()) + "/scenarios/";
    const ModuleType mtran = read_module_file(scenarios + "modules/mtran.yaml").type;
    std::vector<Dock> docks;
    const int rows[][5] = {{1, 1, 4, 0, 1}, {1, 2, 4, 1, 3}, {1, 3, 4, 2, 1}, {1, 4, 4, 3, 3}, {0, 5, 3, 0, 3},
                           {2, 6, 5, 0, 1}, {0, 7, 3, 2, 3}, {2, 8, 5, 2, 1}, {0, 9, 3, 4, 3}, {2, 10, 5, 4, 1}};
    for (const auto& r : rows) docks.push_back({r[0], r[1], r[2], r[3], r[4], SourceLocation{"hexapod.dat", 1, 1}});
    return info(assemble({mtran}, std::vector<std::size_t>(11, 0), docks));
  }();
  return robot;
}

std::map<std::int64_t, double> followed_by(CouplingRule rule, std::int64_t joint) {
  std::map<std::int64_t, double> from;
  for (const Coupling& c : couple(hexapod(), rule, 2, {0.5})) {
    if (c.to == joint) from[c.from] = c.phase_lag;
  }
  return from;
}

using Lags = std::map<std::int64_t, double>;

TEST(Couplings, ChainAndParent) {
  EXPECT_EQ(followed_by(CouplingRule::chain, 0), Lags{});
  EXPECT_EQ(followed_by(CouplingRule::chain, 12), (Lags{{11, 0.5}}));
  const std::int64_t hip = hexapod().modules[7].joints[0];  // middle left leg, docked to the passive block of module 2
  const std::int64_t spine = hexapod().joints[static_cast<std::size_t>(hip)].parent;
  EXPECT_EQ(hexapod().joints[static_cast<std::size_t>(spine)].module, 2);
  EXPECT_EQ(followed_by(CouplingRule::parent, hip), (Lags{{spine, 0.5}}));
}

TEST(Couplings, SiblingsHoldOneAnother) {
  const std::int64_t left = hexapod().modules[7].joints[0];
  const std::int64_t right = hexapod().modules[8].joints[0];
  const Lags from = followed_by(CouplingRule::siblings, right);
  ASSERT_TRUE(from.contains(left));
  EXPECT_EQ(from.at(left), 0);  // both joints lead their parent by equal phases
}

TEST(Couplings, TheRightLegsFollowTheLeftOnes) {
  for (const std::size_t leg : {5U, 7U, 9U}) {
    for (std::size_t k = 0; k < 2; ++k) {
      std::int64_t left = hexapod().modules[leg].joints[k];
      std::int64_t right = hexapod().modules[leg + 1].joints[k];
      if (hexapod().joints[static_cast<std::size_t>(left)].origin[1] < 0) std::swap(left, right);
      EXPECT_EQ(mirror_image(hexapod(), static_cast<std::size_t>(right)), left);
      EXPECT_EQ(mirror_image(hexapod(), static_cast<std::size_t>(left)), -1);
      EXPECT_EQ(followed_by(CouplingRule::mirror, right), (Lags{{left, 0.5}}));
      EXPECT_EQ(followed_by(CouplingRule::mirror, left).at(right), -0.5);
    }
  }
}

// A hinge without a motor is skipped: the joints after it follow the joint that the hinge would follow.
TEST(Couplings, PassOverJointsWithoutAMotor) {
  RobotInfo robot = hexapod();
  robot.joints[5].driven = false;
  for (const CouplingRule rule :
       {CouplingRule::chain, CouplingRule::parent, CouplingRule::siblings, CouplingRule::mirror, CouplingRule::all}) {
    bool seen = false;
    for (const Coupling& c : couple(robot, rule, 1, {0.5})) {
      EXPECT_TRUE(c.from != 5 && c.to != 5) << static_cast<int>(rule);
      seen = seen || (c.to == 6 && c.from == 4);
    }
    EXPECT_TRUE(seen || rule != CouplingRule::chain);
    if (rule == CouplingRule::all) {
      EXPECT_EQ(couple(robot, rule, 1, {0.5}).size(), 21U * 20U);
    }
    EXPECT_EQ(phases_of(couple(robot, rule, 1, {0.5}), 22).size(), 22U) << "no rule contradicts itself";
  }
  ASSERT_EQ(robot.joints[6].parent, 5);
  for (const Coupling& c : couple(robot, CouplingRule::parent, 1, {0.5})) {
    EXPECT_TRUE(c.to != 6 || c.from == 4);
  }
}

TEST(Couplings, AllPullTogetherAsHardAsOne) {
  double pull = 0;
  for (const Coupling& c : couple(hexapod(), CouplingRule::all, 2, {0.5})) {
    if (c.to == 5) pull += c.weight;
  }
  EXPECT_NEAR(pull, 2, 1e-14);  // rounding errors of a sum of 21 terms 2/21
  EXPECT_EQ(followed_by(CouplingRule::all, 5).at(2), 1.5);
}

TEST(Couplings, NoRuleContradictsItselfWhateverTheLags) {
  PerJoint lags{0.5, {}};
  for (std::size_t j = 0; j < hexapod().joints.size(); ++j) lags.each.push_back(0.1 * static_cast<double>(j * j % 7));
  for (const CouplingRule rule :
       {CouplingRule::chain, CouplingRule::parent, CouplingRule::siblings, CouplingRule::mirror, CouplingRule::all}) {
    const std::vector<Coupling> graph = couple(hexapod(), rule, 1, lags);
    EXPECT_EQ(phases_of(graph, hexapod().joints.size()).size(), hexapod().joints.size()) << static_cast<int>(rule);
  }
}

}  // namespace
}  // namespace gaitlab
