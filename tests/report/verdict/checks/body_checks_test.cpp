// Tests of the checks `fall`, `upright` and `in_ground` on all kinds of ground, at and near their limits.
#include <cmath>
#include <numbers>

#include "core/model/kinematics.h"
#include "core/simulation/start.h"
#include "report/analysis/fall.h"
#include "report/analysis/states.h"
#include "report/analysis/upright.h"
#include "report/verdict/verdict.h"
#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

constexpr double kBodyRounding = 1e-9;  // m, rad; more than the rounding errors of numbers near 1
constexpr double kPlateau = 0.1;        // height of the level grounds, m

/// Level grounds and their heights. All have the height kPlateau, except the plane with the height 0.
const std::vector<std::pair<std::string, double>> kLevelGrounds{
    {"{type: plane}", 0},
    {"{type: boxes, boxes: [{center: [0, 0, 0.05], size: [2, 2, 0.1]}]}", kPlateau},
    {"{type: heightfield, heightfield: {values: [[0, 0], [0, 0]], spacing: 2, origin: [-1, -1, 0.1]}}", kPlateau},
};

/// Run of a module at rest. Tests change its recording.
struct Still {
  Scenario scenario;
  Recording record;

  explicit Still(const std::string& ground, const std::vector<std::string>& sets = {})
      : scenario(gaitlab::test::scenario("gaitlab: 1\nrobot: {modules: mtran, position: [0.2, 0.1]}\ncontact: {on: all}\n"
                                         "physics: {engine: articulated}\nduration: 0.3\nground: " +
                                             ground + "\n",
                                         sets)),
        record(run(scenario)) {}

  [[nodiscard]] Check check(const std::string& id) const {
    const Verdict made = verdict(scenario, record, summarise(scenario, record, 0), overlaps(scenario, record));
    return *std::ranges::find(made.checks, id, &Check::id);
  }
  double& pose(const std::string& column, std::size_t row) {
    return record.poses.values.at(row * record.poses.columns.size() + record.poses.find(column));
  }
  void move(const std::string& column, double by, std::size_t from) {
    for (std::size_t row = from; row < record.poses.rows(); ++row) pose(column, row) += by;
  }
  /// Sets the orientation to a rotation about x in all rows from row `from` on.
  void turn(double angle, std::size_t from) {
    for (std::size_t row = from; row < record.poses.rows(); ++row) {
      pose("base.qw", row) = std::cos(angle / 2);
      pose("base.qx", row) = std::sin(angle / 2);
      pose("base.qy", row) = pose("base.qz", row) = 0;
    }
  }
};

constexpr std::size_t kRow = 7;

/// Run of a module that stands on its end, 0.065 m high, and from row `from` on lies at `height` above the ground.
Still lying(const std::string& ground, double height, std::size_t from, double level) {
  Still made(ground, {"robot.orientation=[0, 1.5707963267948966, 0]"});
  made.turn(0, from);
  for (std::size_t row = from; row < made.record.poses.rows(); ++row) made.pose("base.z", row) = level + height;
  return made;
}

/// The limit of a fall is a share of the initial height above the ground, for any height of the ground. The time of the check
/// is the first tick below the limit.
TEST(FallCheck, IsOfTheHeightAboveTheGround) {
  constexpr double kStanding = 0.065;  // m
  for (const auto& [ground, level] : kLevelGrounds) {
    const auto status = [&, &ground = ground, level = level](double share, double limit) {
      Still made = lying(ground, share * kStanding, kRow, level);
      made.scenario.limits.height = limit;
      return made.check("fall").status;
    };
    EXPECT_EQ(status(0.5 + kBodyRounding, 0.5), CheckStatus::pass) << ground;
    EXPECT_EQ(status(0.5 - kBodyRounding, 0.5), CheckStatus::fail) << ground;
    EXPECT_EQ(status(0.7 + kBodyRounding, 0.7), CheckStatus::pass) << ground;
    EXPECT_EQ(status(0.7 - kBodyRounding, 0.7), CheckStatus::fail) << ground;
    Still fallen = lying(ground, 0.75 * kStanding, kRow, level);
    fallen.scenario.limits.height = 0.8;
    EXPECT_NEAR(standing_height(fallen.scenario), kStanding, kBodyRounding) << ground;
    EXPECT_NEAR(heights(fallen.scenario, fallen.record).front(), kStanding, kBodyRounding) << ground;
    fallen.move("base.z", -0.1 * kStanding, kRow + 2);
    const Check check = fallen.check("fall");
    EXPECT_EQ(check.status, CheckStatus::fail) << ground;
    EXPECT_EQ(check.from, fallen.pose("t", kRow)) << "first, not lowest: " << ground;
    EXPECT_EQ(check.to, fallen.record.simulated) << "it does not rise again";
    EXPECT_TRUE(check.text.ends_with(", and does not rise again")) << check.text;
    EXPECT_NEAR(check.value, 0.65, kBodyRounding) << ground;
    EXPECT_EQ(check.first, check.from);
  }
}

TEST(FallCheck, ComparesWithThePoseOnTheGround) {
  const double standing = standing_height(Still("{type: plane}").scenario);
  const Still dropped("{type: plane}", {"robot.position=[0.2, 0.1, 0.1]", "duration=0.5"});
  EXPECT_NEAR(standing_height(dropped.scenario), standing, kBodyRounding);
  EXPECT_EQ(dropped.check("fall").status, CheckStatus::pass) << dropped.check("fall").text;
}

TEST(FallCheck, IsOfFloatingBasesAboveAGround) {
  EXPECT_EQ(Still("{type: none}").check("fall").status, CheckStatus::not_judged);
  Still fixed("{type: plane}", {"robot.base=fixed", "robot.position=[0, 0, 1]"});
  EXPECT_EQ(fixed.check("fall").status, CheckStatus::not_judged);
  Still rows("{type: plane}");
  rows.record.poses = {};
  rows.record.trace = rows.record.rest = {};
  EXPECT_EQ(rows.check("fall").status, CheckStatus::not_judged);
  EXPECT_TRUE(contains(rows.check("fall").text, "no poses"));
}

/// Heights refer to the ground below a contact element, not to walls beside it or roofs above it.
TEST(FallCheck, KnowsWallsAndRoofs) {
  // The module extends 0.065 m to the front, so that its front face is 0.1 mm inside the wall.
  const Still wall("{type: boxes, boxes: [{center: [0.3149, 0.1, 0.5], size: [0.1, 1, 1]}]}",
                   {"robot.position=[0.2, 0.1, 0.0325]"});
  EXPECT_NEAR(heights(wall.scenario, wall.record).front(), 0.0325, kBodyRounding) << "the wall is 1 m high";
  const Still roof("{type: boxes, boxes: [{center: [0.2, 0.1, 0.5], size: [1, 1, 0.1]}]}",
                   {"robot.position=[0.2, 0.1, 0.0325]"});
  EXPECT_NEAR(heights(roof.scenario, roof.record).front(), 0.0325, kBodyRounding);
  EXPECT_EQ(roof.check("fall").status, CheckStatus::pass);
}

/// On a step, the ground's height is the mean below all contact elements, not that below the centre of mass.
TEST(FallCheck, CountsTheStepsBelowTheElements) {
  // Half of the module, and not its centre at x = 0.2, is above a box of the height kPlateau, on which it lies.
  const Still step("{type: boxes, boxes: [{center: [0.701, 0.1, 0.05], size: [1, 1, 0.1]}]}");
  EXPECT_NEAR(heights(step.scenario, step.record).front(), 0.0325 + kPlateau / 2, kBodyRounding);
  EXPECT_NEAR(standing_height(step.scenario), 0.0325 + kPlateau / 2, kBodyRounding);
}

TEST(UprightCheck, FailsBelowTheHorizontal) {
  constexpr double kHalf = std::numbers::pi / 2;
  const Still still("{type: none}", {"actuator.type=none", "physics.gravity=[0, 0, 0]"});
  struct Turned {
    double angle;
    CheckStatus status;
  };
  for (const auto& [angle, status] : {Turned{1.04, CheckStatus::pass},
                                      {1.05, CheckStatus::warn},  // limits.tilt is pi / 3
                                      {kHalf - kBodyRounding, CheckStatus::warn},
                                      {kHalf + kBodyRounding, CheckStatus::fail},
                                      {3, CheckStatus::fail},
                                      {-3, CheckStatus::fail}}) {
    Still turned = still;
    turned.turn(angle, kRow);
    const Check check = turned.check("upright");
    EXPECT_EQ(check.status, status) << angle;
    EXPECT_NEAR(check.value, std::abs(angle), 1e-7) << "the acos of a double";
    EXPECT_EQ(check.from, turned.pose("t", kRow));
    EXPECT_EQ(check.limit, kHalf);
    EXPECT_NEAR(check.margin, (kHalf - std::abs(angle)) / kHalf, 1e-7);
  }
  Still set = still;
  set.scenario.limits.tilt = 1.3;
  set.turn(1.2, kRow);
  EXPECT_EQ(set.check("upright").status, CheckStatus::pass);
  set.scenario.limits.tilt = 4;
  set.turn(1.6, kRow);
  EXPECT_EQ(set.check("upright").status, CheckStatus::fail) << "the key moves the warning alone";
}

/// In a wave, the end of a chain turns beyond the horizontal, but the mean of the bodies does not. The base is at 2 rad, the
/// others at 2 - q and 2 - 2 q. If the chain bends the other way, the mean is also beyond the horizontal. The outer bodies of
/// the module have equal masses, and the middle is light.
TEST(UprightCheck, IsNotOfTheEndOfAChainAlone) {
  const Still still("{type: none}", {"actuator.type=none", "physics.gravity=[0, 0, 0]"});
  const auto bent = [&](double hinge) {
    Still made = still;
    for (std::size_t row = kRow; row < made.record.poses.rows(); ++row) {
      made.pose("base.qw", row) = std::cos(1.0);
      made.pose("base.qy", row) = std::sin(1.0);
      made.pose("base.qx", row) = made.pose("base.qz", row) = 0;
      made.pose("joint.0.angle", row) = made.pose("joint.1.angle", row) = hinge;
    }
    return made.check("upright");
  };
  const Check wave = bent(-1);
  EXPECT_EQ(wave.status, CheckStatus::pass) << wave.text;
  EXPECT_NEAR(wave.value, 1, 0.02) << "the mean of 2, 1 and 0";
  EXPECT_EQ(bent(1).status, CheckStatus::fail);
  EXPECT_NEAR(bent(1).value, 2, 1e-7) << "the base tilts less than the mean";
}

/// The tilt refers to the start. A robot that lies on its side at the start is upright in this pose.
TEST(UprightCheck, IsOfTheStart) {
  const Still side("{type: plane}", {"robot.orientation=[1.7, 0.3, 2]"});
  EXPECT_LT(upright(side.scenario, side.record, {}, 0)->tilt, 1.8);
  Still lies("{type: plane}", {"robot.orientation=[1.5707963267948966, 0, 1]", "duration=0.1"});
  EXPECT_EQ(lies.check("upright").status, CheckStatus::pass);
  EXPECT_LT(lies.check("upright").value, 0.01);
  Still fixed("{type: plane}", {"robot.base=fixed", "robot.position=[0, 0, 1]"});
  EXPECT_EQ(fixed.check("upright").status, CheckStatus::not_judged);
}

/// Result of `upright` for a given angle over time. Rows are 0.01 s apart over 4 s; periods of 1 s follow the first second.
/// `lean` is a constant sideways inclination after the start, rad.
Upright turned_by(const std::function<double(double)>& angle, std::size_t periods = 3, double set_points = 0, double from = 1,
                  double lean = 0) {
  static const Still still("{type: none}", {"actuator.type=none", "physics.gravity=[0, 0, 0]"});
  Recording record = still.record;
  Trace& poses = record.poses;
  const std::vector<double> first(poses.values.begin(),
                                  poses.values.begin() + static_cast<std::ptrdiff_t>(poses.columns.size()));
  poses.values.clear();
  for (int row = 0; row <= 400; ++row) {
    std::vector<double> values = first;
    values[poses.find("t")] = 0.01 * row;
    const Quat turned =
        Eigen::AngleAxisd(angle(0.01 * row), Vec3::UnitX()) * Eigen::AngleAxisd(row > 0 ? lean : 0, Vec3::UnitY());
    for (const auto& [column, value] :
         {std::pair{"base.qw", turned.w()}, {"base.qx", turned.x()}, {"base.qy", turned.y()}, {"base.qz", turned.z()}})
      values[poses.find(column)] = value;
    poses.values.insert(poses.values.end(), values.begin(), values.end());
  }
  Judged judged;
  judged.from = from;
  judged.to = 4;
  judged.periods = periods;
  return *upright(still.scenario, record, judged, set_points);
}

TEST(UprightCheck, IsNotOfWhatRolls) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto rolls = [](double t) { return kTurn * t; };
  const auto sways = [](double t) { return -kTurn * t + 2 * std::sin(kTurn * t); };
  const auto slips = [](double t) { return 0.51 * kTurn * t; };  // 0.51 turns per period, rounded to one turn
  EXPECT_TRUE(turned_by(rolls).rolls);
  EXPECT_TRUE(turned_by(sways).rolls);
  EXPECT_TRUE(turned_by(slips).rolls);
  const auto slow = [](double t) { return 0.49 * kTurn * t; };
  const auto nods = [](double t) { return 0.9 * (1 - std::cos(kTurn * t)); };                    // up to 1.8 rad and back
  const auto lies = [](double t) { return t < 0.2 ? 0.0 : 3.0; };                                // lies on its back
  const auto rocks = [](double t) { return t < 0.2 ? 0.0 : 1.57 + 0.7 * std::sin(kTurn * t); };  // rocks on its side
  const auto topples = [](double t) { return t < 3.4 ? 0.2 * std::sin(t) : 2.5; };               // falls in the last period
  const auto tumbles = [](double t) { return t < 1 ? kTurn * t : 0.0; };                         // one turn onto its feet
  const auto stops = [](double t) { return t < 3 ? kTurn * t : 0.0; };                           // no turn in the last period
  for (const auto& [name, angle] : std::vector<std::pair<std::string, std::function<double(double)>>>{{"slow", slow},
                                                                                                      {"nods", nods},
                                                                                                      {"lies", lies},
                                                                                                      {"rocks", rocks},
                                                                                                      {"topples", topples},
                                                                                                      {"tumbles", tumbles},
                                                                                                      {"stops", stops}}) {
    EXPECT_TRUE(turned_by(angle).over) << name;
    EXPECT_FALSE(turned_by(angle).rolls) << name;
  }
  EXPECT_NEAR(*turned_by(rolls).over, 0.26, 1e-9);
  EXPECT_NEAR(*turned_by(topples).over, 3.4, 1e-9);
  // Without a limit cycle, the last period of the set points is judged. If the set points do not repeat, the halves of the
  // window are compared.
  EXPECT_TRUE(turned_by(rolls, 0, 1).rolls);
  EXPECT_FALSE(turned_by(lies, 0, 1).rolls);
  EXPECT_TRUE(turned_by(rolls, 0, 0).rolls);
  EXPECT_FALSE(turned_by(topples, 0, 0).rolls);
  EXPECT_FALSE(turned_by(tumbles, 0, 0, 0).rolls) << "a whole turn in the first half alone";
  const auto last = [](double t) { return t < 3 ? 0.0 : kTurn * t; };
  const auto back = [](double t) { return t < 2 ? 0.0 : t < 3 ? -kTurn * t : kTurn * t; };
  EXPECT_TRUE(turned_by(last, 0, 1).rolls) << "one period of the set points";
  EXPECT_TRUE(turned_by(back, 0, 1).rolls) << "that period alone";
  // An inclined robot rolls if its upward axis passes within 45 degrees of the upward and the downward vertical.
  for (const double cosine : {0.72, 0.9}) EXPECT_TRUE(turned_by(rolls, 3, 0, 1, std::acos(cosine)).rolls) << cosine;
  EXPECT_FALSE(turned_by(rolls, 3, 0, 1, std::acos(0.7)).rolls);
}

/// A run that ends less than a period after the robot first turns over does not show if the robot rolls, and is not judged. A
/// run of three periods is always judged.
TEST(UprightCheck, IsNotJudgedBeforeItCanBe) {
  const auto status = [](const char* duration, double over) {
    Still made("{type: none}", {"cpg.type=sine", "cpg.frequency=5", "cpg.amplitude=0.1", "physics.gravity=[0, 0, 0]",
                                std::string("duration=") + duration});
    std::size_t row = 0;
    while (made.pose("t", row) < over - 1e-9) ++row;
    made.turn(3, row);
    return made.check("upright").status;
  };
  EXPECT_EQ(status("0.45", 0.3), CheckStatus::not_judged);
  EXPECT_EQ(status("0.45", 0.15), CheckStatus::fail) << "it lies there for more than a period";
  EXPECT_EQ(status("0.75", 0.6), CheckStatus::fail);
}

/// The limit of the depth in the ground is the same on every kind of ground.
TEST(InGroundCheck, IsOfEveryGround) {
  for (const auto& [ground, level] : kLevelGrounds) {
    Still still(ground);
    EXPECT_EQ(still.check("in_ground").status, CheckStatus::pass) << ground;
    EXPECT_EQ(still.check("in_ground").value, 0) << ground;
    const auto at = [&, level = level](double depth) {
      Still sunk = still;
      for (std::size_t row = kRow; row < sunk.record.poses.rows(); ++row) {
        for (const char* column : {"base.qw", "base.qx", "base.qy", "base.qz"}) sunk.pose(column, row) = sunk.pose(column, 0);
        for (std::size_t j = 0; j < sunk.scenario.robot->joints.size(); ++j)
          sunk.record.poses.values[row * sunk.record.poses.columns.size() + 8 + j] = 0;
        sunk.pose("base.z", row) = level + 0.0325 - depth;
      }
      return sunk;
    };
    EXPECT_EQ(at(0.005 - kBodyRounding).check("in_ground").status, CheckStatus::pass) << ground;
    EXPECT_EQ(at(0.005 + kBodyRounding).check("in_ground").status, CheckStatus::fail) << ground;
    const Still deep = at(0.02);
    const Check check = deep.check("in_ground");
    EXPECT_NEAR(check.value, 0.02, kBodyRounding) << ground;
    EXPECT_EQ(check.from, Still(deep).pose("t", kRow)) << ground;
    EXPECT_TRUE(contains(check.text, " goes 20 mm into the ground")) << check.text;
  }
  const Check none = Still("{type: none}").check("in_ground");
  EXPECT_EQ(none.status, CheckStatus::not_judged);
  EXPECT_EQ(none.text, "judged only above a ground");
}

/// The depth in the ground is the shortest distance out of it, not the depth below its top. Near an edge this distance is
/// small.
TEST(InGroundCheck, IsTheWayOut) {
  // The module extends 0.065 m to the front, 3 mm deep into the side of a block that is 0.2 m high.
  const std::string block = "{type: boxes, boxes: [{center: [0.312, 0.1, 0.1], size: [0.1, 1, 0.2]}]}";
  const Still beside(block, {"robot.position=[0.2, 0.1, 0.0325]", "duration=0.015"});
  EXPECT_EQ(beside.check("in_ground").status, CheckStatus::pass);
  const Still deeper(block, {"robot.position=[0.207, 0.1, 0.0325]", "duration=0.015"});
  EXPECT_EQ(deeper.check("in_ground").status, CheckStatus::fail);
  EXPECT_NEAR(deeper.check("in_ground").value, 0.01, kBodyRounding);
}

// Scenarios for which the correct verdict is known by construction.

struct Known {
  Scenario scenario;
  Recording record = run(scenario);
  Summary summary = summarise(scenario, record, 0);
  Verdict judged = verdict(scenario, record, summary, overlaps(scenario, record));

  explicit Known(const std::string& name)
      : scenario(read_scenario(std::string(gaitlab::test::source_folder()) + "/tests/data/verdict/" + name + ".yaml", {},
                               catalog())) {}
  [[nodiscard]] const Check& check(const std::string& id) const { return *std::ranges::find(judged.checks, id, &Check::id); }
};

TEST(KnownTruth, ThrownOnItsBackIsNoGait) {
  const Known thrown("V3-thrown-on-its-back");
  const Check& check = thrown.check("upright");
  EXPECT_EQ(check.status, CheckStatus::fail) << check.text;
  EXPECT_GT(check.value, 3);
  // The robot rotates at 12.8 rad/s and completes a quarter turn in pi / 2 / 12.8 = 0.123 s. The tolerance is two control
  // periods.
  EXPECT_NEAR(check.from, 0.123, 0.03);
  EXPECT_EQ(thrown.judged.word, Word::infeasible);
}

/// Compares the depth of a buried body with an independent function, which uses round half cylinders instead of prisms of 24
/// sides.
void expect_buried(const Known& buried, double level) {
  constexpr double kPrism = 0.009 * 0.0325;  // largest distance of the prism from the cylinder, 0.9 % of the radius, m
  const Check& check = buried.check("in_ground");
  ASSERT_EQ(check.status, CheckStatus::fail) << check.text;
  const States states = States::at_ticks(buried.record, *buried.scenario.robot);
  Kinematics k(*buried.scenario.robot);
  double deepest = 0;
  double first = -1;
  for (std::size_t row = 0; row < states.size(); ++row) {
    k.update(*buried.scenario.robot, states(row));
    const double depth = level - lowest_point(*buried.scenario.robot, k, {});
    deepest = std::max(deepest, depth);
    if (first < 0 && depth > buried.scenario.limits.sink) first = states.time(row);
  }
  EXPECT_NEAR(check.value, deepest, kPrism);
  EXPECT_EQ(check.first, first);
  EXPECT_EQ(buried.judged.word, Word::infeasible);
}

TEST(KnownTruth, InsideABox) { expect_buried(Known("V4-inside-a-box"), 0.2); }

TEST(KnownTruth, UnderAHeightfield) { expect_buried(Known("V4-under-a-heightfield"), 0); }

TEST(KnownTruth, StartsAboveTheGround) {
  const Known dropped("V11-starts-above-the-ground");
  EXPECT_EQ(dropped.check("fall").status, CheckStatus::pass) << dropped.check("fall").text;
  EXPECT_NE(dropped.judged.word, Word::infeasible) << dropped.judged.why();
}

TEST(KnownTruth, DownAStep) {
  const Known slid("V12-down-a-step");
  EXPECT_EQ(slid.check("fall").status, CheckStatus::pass) << slid.check("fall").text;
  EXPECT_EQ(slid.check("in_ground").status, CheckStatus::pass) << slid.check("in_ground").text;
  EXPECT_NE(slid.judged.word, Word::infeasible) << slid.judged.why();
}

}  // namespace
}  // namespace gaitlab::test
