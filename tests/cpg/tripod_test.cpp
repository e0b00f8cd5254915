// Tests of legs and of the gaits of legged robots: set points of tripod, which never jump, and feet of `legs`, which keep their
// ways.
#include "cpg/tripod.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "core/model/kinematics.h"
#include "core/model/legs.h"
#include "core/model/robot.h"
#include "core/robot_files/module_file.h"
#include "core/scenario/scenario.h"
#include "core/settings/node.h"
#include "cpg/legs.h"
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

// --- legs -------------------------------------------------------------------------------------------------------------------

/// A quadruped: a trunk with four legs of three hinges (abduction about x, hip and knee about y), on spheres. With `mirrored`
/// the axes of hip and knee on the right are -y. A `tail` has the hinges of a leg and a longer last link.
/// Knees that bend `both_ways` are stretched in the middle of their range.
Robot quadruped(bool mirrored = false, bool tail = false, bool both_ways = false) {
  std::string bodies = "{trunk: {mass: 5, inertia: [0.02, 0.06, 0.07, 0, 0, 0], shape: [{box: [0.4, 0.1, 0.1]}]}";
  std::string hinges;
  const auto leg = [&](const std::string& name, double x, double y, double z, bool turned, double last) {
    for (const char* const part : {"hip", "thigh"})
      bodies += ", " + name + part + ": {mass: 0.4, inertia: [0.001, 0.001, 0.001, 0, 0, 0]}";
    bodies += ", " + name +
              "calf: {mass: 0.2, inertia: [0.001, 0.001, 0.001, 0, 0, 0], shape: [{sphere: 0.02, origin: [0, 0, " +
              std::to_string(-last) + "]}]}";
    const auto hinge = [&](const char* joint, const std::string& parent, const char* child, const std::string& rest) {
      hinges += (hinges.empty() ? "{name: " : ", {name: ") + name + joint + ", parent: " + parent + ", child: " + name + child +
                ", " + rest + "}";
    };
    const std::string axis = turned ? "axis: [0, -1, 0], range: " : "axis: [0, 1, 0], range: ";
    hinge("roll", "trunk", "hip",
          "origin: [" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) +
              "], axis: [1, 0, 0], range: [-0.8, 0.8]");
    hinge("pitch", name + "hip", "thigh",
          "origin: [0, " + std::to_string(y < 0 ? -0.05 : 0.05) + ", 0], " + axis + (turned ? "[-3, 1.5]" : "[-1.5, 3]"));
    hinge("knee", name + "thigh", "calf",
          "origin: [0, 0, -0.2], " + axis +
              (both_ways ? "[-2.6, 2.6]"
               : turned  ? "[0.6, 2.6]"
                         : "[-2.6, -0.6]"));
  };
  leg("a", 0.2, 0.1, 0, false, 0.2);
  leg("b", 0.2, -0.1, 0, mirrored, 0.2);
  leg("c", -0.2, 0.1, 0, false, 0.2);
  leg("d", -0.2, -0.1, 0, mirrored, 0.2);
  if (tail) leg("t", -0.3, 0, 0.3, false, 0.25);
  Problems problems;
  const Node document = parse_yaml(
      "{gaitlab_module: 1, name: dog, bodies: " + bodies + "}, hinges: [" + hinges + "], contacts: {all: shapes}}", "dog.yaml");
  const ModuleType type = read_module(document, true, problems);
  problems.raise();
  return assemble({type}, {0}, {});
}

std::vector<std::string> names_of(const std::vector<Leg>& legs) {
  std::vector<std::string> names;
  for (const Leg& leg : legs) names.push_back(leg.name);
  return names;
}
using Names = std::vector<std::string>;

TEST(LegsOf, RobotsHaveNamesFromFrontToRear) {
  EXPECT_EQ(names_of(info(quadruped()).legs), (Names{"front_left", "front_right", "rear_left", "rear_right"}));
  const RobotInfo hexapod = robot_of(kHexapod);
  EXPECT_EQ(names_of(hexapod.legs),
            (Names{"front_left", "front_right", "middle_left", "middle_right", "rear_left", "rear_right"}));
  std::vector<std::int64_t> modules;
  for (const Leg& leg : hexapod.legs) {
    EXPECT_EQ(leg.joints.size(), 2U);
    modules.push_back(hexapod.bodies[static_cast<std::size_t>(leg.bodies.back())].module);
  }
  EXPECT_EQ(modules, (std::vector<std::int64_t>{9, 10, 7, 8, 5, 6}));
}

TEST(LegsOf, TheYawOfTheStartChangesNothing) {
  const Robot robot = quadruped();
  const std::vector<double> zero(robot.joints.size(), 0.0);
  const std::vector<Leg> straight = legs_of(robot, zero, Mat3::Identity());
  for (const double yaw : {0.7, 1.6, 3.1, -2.0}) {
    const std::vector<Leg> turned = legs_of(robot, zero, rpy({0, 0, yaw}));
    EXPECT_EQ(names_of(turned), names_of(straight));
    for (std::size_t l = 0; l < turned.size(); ++l) EXPECT_EQ(turned[l].joints, straight[l].joints);
  }
}

TEST(LegsOf, ASnakeAndATwoArmedRobotOnTheGroundHaveNone) {
  EXPECT_TRUE(robot_of({{1, 1, 4, 0, 0}, {1, 2, 4, 1, 0}, {1, 3, 4, 2, 0}}).legs.empty());
  EXPECT_TRUE(robot_of({{1, 1, 4, 0, 0}, {4, 2, 1, 0, 0}}).legs.empty()) << "module 0 in the middle";
}

TEST(LegsOf, ALegInTheAirIsOneOfItsKind) {
  const Robot robot = quadruped();
  std::vector<double> q(robot.joints.size(), 0.0);
  const std::vector<Leg> all = legs_of(robot, q, Mat3::Identity());
  for (const std::int64_t joint : all[1].joints) q[static_cast<std::size_t>(joint)] = 0.7;
  EXPECT_EQ(names_of(legs_of(robot, q, Mat3::Identity())), names_of(all));
}

TEST(LegsOf, ATailWithTheHingesOfALegIsNone) {
  EXPECT_EQ(names_of(info(quadruped(false, true)).legs), (Names{"front_left", "front_right", "rear_left", "rear_right"}));
}

/// Stated legs have their own names, and the order and sides of the legs that would be found.
TEST(LegsOf, StatedLegsReplaceThoseThatAreFound) {
  Robot robot = quadruped(false, true);
  const auto body = [&](const std::string& name) {
    const auto at = std::ranges::find(robot.bodies, "m0/" + name, &Body::name);
    return static_cast<std::size_t>(at - robot.bodies.begin());
  };
  const std::vector<double> zero(robot.joints.size(), 0.0);
  const auto legs = [&] { return legs_of(robot, zero, Mat3::Identity()); };
  const std::vector<Leg> found = legs();
  robot.stated_legs = {{"tail", body("tcalf")}, {"right", body("bcalf")}, {"left", body("acalf")}};
  const std::vector<Leg> stated = legs();
  EXPECT_EQ(names_of(stated), (Names{"left", "right", "tail"}));
  EXPECT_EQ(stated[0].joints, found[0].joints);
  EXPECT_EQ(stated[1].joints, found[1].joints);
  EXPECT_EQ(stated[0].foot, found[0].foot);
  EXPECT_EQ(stated[0].side, 1);
  EXPECT_EQ(stated[1].side, -1);
  EXPECT_EQ(stated[2].side, 0);
  robot.stated_legs = {{"only", body("bcalf")}};
  EXPECT_EQ(names_of(legs()), (Names{"only"}));
  EXPECT_EQ(legs()[0].foot, found[1].foot);
  robot.stated_legs->clear();
  EXPECT_TRUE(legs().empty());
}

TEST(LegsOf, MoreThanThreeOnASideAreNumbered) {
  // A spine of five modules with a leg on each side of modules 0 to 4: octopod.yaml and one pair more.
  std::vector<std::array<int, 5>> rows;
  for (int m = 1; m < 9; ++m) rows.push_back({1, m, 4, m - 1, m % 2 == 1 ? 1 : 3});
  for (int m = 0; m < 9; m += 2) {
    rows.push_back({0, 9 + m, 3, m, 3});
    rows.push_back({2, 10 + m, 5, m, 1});
  }
  const Names names = names_of(robot_of(rows).legs);
  EXPECT_EQ(names, (Names{"front_left", "front_right", "2nd_left", "2nd_right", "3rd_left", "3rd_right", "4th_left",
                          "4th_right", "rear_left", "rear_right"}));
}

/// World position of a foot's centre in the frame of the base, by the kinematics of the engines, not by that of the gait.
Vec3 foot_at(const Robot& robot, const Leg& leg, const std::vector<double>& q) {
  RobotState state;
  state.q = q;
  state.qd.assign(q.size(), 0);
  Kinematics k(robot);
  k.place(robot, state);
  const auto link = robot.joints[static_cast<std::size_t>(leg.tip)].link;
  return k.point(link, {0, 0, -0.2});
}

/// In stance, every foot moves as the ground does under a body with the speeds of the settings: x' = -v - turn x (x - c).
TEST(Legs, FeetOnTheGroundMoveAgainstTheBody) {
  const Robot robot = quadruped();
  const RobotInfo known = info(robot);
  for (const Gait gait :
       {Gait::trot, Gait::pace, Gait::bound, Gait::walk, Gait::crawl, Gait::wave, Gait::ripple, Gait::gallop}) {
    Legs::Settings s;
    s.frequency = 2;
    s.model.gait = gait;
    s.model.speed = 0.2;
    s.model.side = 0.05;
    s.model.turn = 0.3;
    s.model.lean = 0;
    const Legs made(known, s);
    const double duty = duty_of(gait, known.legs);
    const std::vector<double> phases = phases_of(gait, known.legs);
    std::vector<double> q(robot.joints.size());
    made.output(0, {}, q);
    Vec3 middle = Vec3::Zero();
    for (const Leg& leg : known.legs) middle += foot_at(robot, leg, q) / 4;
    for (std::size_t l = 0; l < known.legs.size(); ++l) {
      double lowest = 1, highest = -1;
      for (int n = 0; n < 64; ++n) {
        const double share = (n + 0.5) / 64;                      // of the cycle of this leg
        const double t = (10 + share - phases[l]) / s.frequency;  // the ramp has ended
        constexpr double kStep = 1e-3;                            // s
        made.output(t, {}, q);
        const Vec3 x = foot_at(robot, known.legs[l], q);
        lowest = std::min(lowest, x.z());
        highest = std::max(highest, x.z());
        if (share > duty - 0.02 || share < 0.02) continue;
        made.output(t + kStep, {}, q);
        const Vec3 speed = (foot_at(robot, known.legs[l], q) - x) / kStep;
        const Vec3 ground = -Vec3(0.2, 0.05, 0) - Vec3(0, 0, 0.3).cross(x - middle);
        // Set points are linear between 128 samples, so that the foot is on the chord of its way: off by 0.4 mm/s at most.
        EXPECT_LT((speed - ground).norm(), 0.001) << kGaitNames[static_cast<std::size_t>(gait)] << " leg " << l << " " << share;
        EXPECT_LT(std::abs(x.z() - lowest), 1e-5);
      }
      // Lift: a tenth of the height of the stance. The 64 points miss the highest by up to 0.3 mm.
      EXPECT_NEAR(highest - lowest, 0.1 * (0.1 / 2 + 0.4) * 0.75, 0.001);
    }
  }
}

/// Leads of six and four legs, as the manual names them: waves go from rear to front, and sides are half a cycle apart.
TEST(Legs, PhasesAreThoseOfTheManual) {
  const RobotInfo six = robot_of(kHexapod);  // front, middle, rear; left and right in turn
  const RobotInfo four = info(quadruped());
  using Phases = std::vector<double>;
  const auto expect = [](const RobotInfo& robot, Gait gait, const Phases& expected) {
    const Phases found = phases_of(gait, robot.legs);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t l = 0; l < found.size(); ++l)
      EXPECT_NEAR(found[l], expected[l], 1e-12) << kGaitNames[static_cast<std::size_t>(gait)] << ", " << robot.legs[l].name;
  };
  // A lead of 0.75 is a delay of 0.25 behind the leg to the rear.
  expect(six, Gait::ripple, {0.5, 0, 0.75, 0.25, 0, 0.5});
  expect(six, Gait::wave, {2.0 / 3, 1.0 / 6, 5.0 / 6, 1.0 / 3, 0, 0.5});
  expect(six, Gait::tripod, {0, 0.5, 0.5, 0, 0, 0.5});
  expect(four, Gait::ripple, {0.75, 0.25, 0, 0.5});
  expect(four, Gait::walk, {0.75, 0.25, 0, 0.5});
  expect(four, Gait::trot, {0, 0.5, 0.5, 0});
  expect(four, Gait::pace, {0, 0.5, 0, 0.5});
  expect(four, Gait::bound, {0, 0, 0.5, 0.5});
  expect(four, Gait::gallop, {0, 0.1, 0.5, 0.6});
}

TEST(Legs, StartsInItsStanceAndRepeats) {
  const Robot robot = quadruped();
  const RobotInfo known = info(robot);
  Legs::Settings s;
  s.model.stride = 0.1;
  const Legs made(known, s);
  std::vector<double> q(robot.joints.size()), later(robot.joints.size());
  made.output(0, {}, q);
  for (std::size_t j = 0; j < q.size(); ++j) {
    EXPECT_GE(q[j], known.joints[j].lo + 0.149) << known.joints[j].name;
    EXPECT_LE(q[j], known.joints[j].hi - 0.149) << known.joints[j].name;
  }
  double low = 1, high = -1;
  for (const Leg& leg : known.legs) {
    low = std::min(low, foot_at(robot, leg, q).z());
    high = std::max(high, foot_at(robot, leg, q).z());
  }
  EXPECT_LT(high - low, 1e-4) << "all feet are on one plane";
  RobotInfo stated = known;  // the angles of the start are the stance
  stated.start_stated = true;
  for (std::size_t j = 0; j < q.size(); ++j) stated.joints[j].start = q[j] + (j == 0 ? 0.05 : 0);
  Legs(stated, s).output(0, {}, later);
  for (std::size_t j = 0; j < q.size(); ++j) EXPECT_EQ(later[j], stated.joints[j].start);
  made.output(3.21, {}, q);
  made.output(4.21, {}, later);  // a period of 1 s later
  for (std::size_t j = 0; j < q.size(); ++j) EXPECT_NEAR(later[j], q[j], 1e-9);
}

/// Legs whose hinges turn about -y on the right have the angles of equal legs, with the other sign.
TEST(Legs, MirroredAxesBendAlike) {
  Legs::Settings s;
  s.model.stride = 0.1;
  const RobotInfo known = info(quadruped(false, false, true));
  const RobotInfo turned = info(quadruped(true, false, true));
  std::vector<double> q(known.joints.size()), mirrored(q.size());
  for (const double t : {0.0, 2.3}) {
    Legs(known, s).output(t, {}, q);
    Legs(turned, s).output(t, {}, mirrored);
    for (std::size_t j = 0; j < q.size(); ++j) {
      const bool other = turned.joints[j].axis[1] < -0.5;
      // Both are solutions to 1e-3 of the norm of the Jacobian, from other starts.
      EXPECT_NEAR(mirrored[j], other ? -q[j] : q[j], 2e-3) << known.joints[j].name << " at " << t;
    }
  }
}

TEST(Legs, RefusesWhatCannotWalk) {
  const RobotInfo known = info(quadruped());
  Legs::Settings s;
  s.model.stride = 0.1;
  s.model.speed = 0.1;
  EXPECT_THROW(Legs(known, s), SettingError);
  s.model.speed = 0;
  s.model.stride = 10;
  EXPECT_THROW(Legs(known, s), SettingError) << "feet cannot move 5 m";
  RobotInfo stated = known;
  stated.start_stated = true;
  s.model.stride = 0.1;
  s.model.stance = 0.7;
  EXPECT_THROW(Legs(stated, s), SettingError) << "the stance is that of the start";
  RobotInfo five = known;
  five.legs.push_back(five.legs[0]);
  EXPECT_THROW(phases_of(Gait::trot, five.legs), std::invalid_argument);
  EXPECT_NO_THROW(phases_of(Gait::wave, five.legs));
  RobotInfo none = known;
  none.legs.clear();
  EXPECT_THROW(Legs(none, {}), std::invalid_argument);
}

}  // namespace
}  // namespace gaitlab::cpg
