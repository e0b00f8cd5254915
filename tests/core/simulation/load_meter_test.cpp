// Paths, slip, stability margin and loads of docks, for motions and contacts given by hand.
#include "core/simulation/load_meter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/model/docking.h"
#include "tests/random_robots.h"

namespace gaitlab {
namespace {

constexpr double kSingle = 1.2e-7;  // the spacing of single precision at 1, in which rows are

/// A robot of three modules that is moved and touched by hand.
class LoadedRobot {
 public:
  explicit LoadedRobot(Loads wanted = Loads::recorded) {
    test::RandomRobots random(8);
    scenario_.robot = std::make_shared<const Robot>(random.robot_of(3));
    scenario_.contact.on = ContactSet::all;
    elements_ = contact_elements(*scenario_.robot, ContactSet::all);
    meter_ = std::make_unique<LoadMeter>(scenario_, elements_, wanted);
    row_.resize(meter_->columns().size());
  }
  [[nodiscard]] const Robot& robot() const { return *scenario_.robot; }
  [[nodiscard]] const std::vector<ContactElement>& elements() const { return elements_; }
  [[nodiscard]] double weight() const { return robot().mass * 9.81; }
  LoadMeter& meter() { return *meter_; }
  RobotState& state() { return meter_->sample().state; }
  /// Moves the robot to its state; contacts stay as they are.
  void place() { meter_->sample().forward_kinematics(robot()); }
  /// Centre of an element, world.
  [[nodiscard]] Vec3 centre(std::size_t element) {
    return meter_->sample().kinematics.point(elements_[element].link, elements_[element].centre);
  }
  /// The ground bears an element by this share of the weight, below its centre.
  void bear(std::size_t element, double share, const Vec3& along = Vec3::Zero()) {
    const double fn = share * weight();
    meter_->sample().contacts[element] = {
        .force = Vec3(0, 0, fn) + along, .fn = fn, .point = centre(element) - Vec3(0, 0, elements_[element].radius)};
  }
  void measure() { meter_->measure(row_); }
  [[nodiscard]] double operator[](const std::string& column) const {
    const auto at = std::ranges::find(meter_->columns(), column, &Column::name);
    EXPECT_NE(at, meter_->columns().end()) << column;
    return row_.at(static_cast<std::size_t>(at - meter_->columns().begin()));
  }
  [[nodiscard]] bool has(const std::string& part) const {
    return std::ranges::any_of(meter_->columns(), [&](const Column& c) { return c.name.find(part) != std::string::npos; });
  }
  [[nodiscard]] std::string foot(std::size_t element, const std::string& quantity) const {
    return "foot." + robot().bodies[elements_[element].body].name + "." + quantity;
  }
  [[nodiscard]] const std::vector<double>& row() const { return row_; }

 private:
  Scenario scenario_;
  std::vector<ContactElement> elements_;
  std::unique_ptr<LoadMeter> meter_;
  std::vector<double> row_;
};

TEST(LoadMeter, PathIsTheHorizontalWayOfTheCentreOfMass) {
  LoadedRobot made;
  const std::vector<std::pair<Vec3, double>> way{
      {{5, 5, 5}, 0}, {{5.3, 5.4, 5.7}, 0.5}, {{5, 5, 5}, 1}, {{5, 5, 9}, 1}, {{4, 5, 5}, 2}};
  for (const auto& [position, path] : way) {
    made.state().position = position;
    made.place();
    made.measure();
    EXPECT_NEAR(made["path"], path, 2 * kSingle);
  }
}

/// One contact point carries the whole weight. It lands, is dragged, lifted and moved through the air.
TEST(LoadMeter, SlipIsTheWayUnderLoad) {
  LoadedRobot made;
  const std::string slid = made.foot(0, "slid");
  const auto move = [&](const Vec3& by, double share) {
    made.state().position += by;
    made.place();
    made.bear(0, share);
    made.measure();
  };
  move({0, 0, 0}, 0);
  move({0.2, 0, 0}, 1);
  EXPECT_NEAR(made["slip"], 0.1, kSingle) << "lands: half of the load on the way";
  EXPECT_NEAR(made[slid], 0.1, kSingle);
  move({0.3, 0.4, -0.001}, 1);
  EXPECT_NEAR(made["slip"], 0.6, kSingle);
  EXPECT_NEAR(made[slid], 0.6, kSingle);
  move({-0.3, -0.4, 0}, 1);
  EXPECT_NEAR(made["slip"], 1.1, 2 * kSingle) << "a way, not a displacement";
  move({0, 0.2, 0}, 0);
  EXPECT_NEAR(made["slip"], 1.2, 2 * kSingle) << "is lifted";
  EXPECT_NEAR(made[slid], 1.2, 2 * kSingle);
  move({0, 7, 0}, 0);
  EXPECT_NEAR(made["slip"], 1.2, 2 * kSingle) << "in the air";
  EXPECT_NEAR(made[slid], 1.2, 2 * kSingle);
}

TEST(LoadMeter, AFewThousandthsOfTheWeightSlideNoFoot) {
  for (const double share : {0.004, 0.006}) {
    LoadedRobot made;
    made.place();
    made.bear(0, share);
    made.measure();
    made.state().position.x() += 1;
    made.place();
    made.bear(0, share);
    made.measure();
    EXPECT_NEAR(made[made.foot(0, "slid")], share > 0.005 ? 1 : 0, kSingle);
    EXPECT_NEAR(made["slip"], share, kSingle) << "they count by their load";
  }
}

/// If a sphere of radius r rolls by an angle a, the material point that touched moves along a cycloid by r (a - sin a).
TEST(LoadMeter, ARollingSphereSlidesByItsCycloid) {
  LoadedRobot made;
  const auto& elements = made.elements();
  const auto round = std::ranges::find_if(elements, [](const ContactElement& e) { return e.radius > 0; });
  ASSERT_NE(round, elements.end());
  const auto e = static_cast<std::size_t>(round - elements.begin());
  made.place();
  made.bear(e, 1);
  made.measure();
  constexpr double kAngle = 0.3;
  const Vec3 before = made.centre(e);
  made.state().orientation = Quat(Eigen::AngleAxisd(kAngle, Vec3::UnitY()));
  made.place();
  made.state().position += before + Vec3(round->radius * kAngle, 0, 0) - made.centre(e);
  made.place();
  made.bear(e, 1);
  made.measure();
  EXPECT_NEAR(made["slip"], round->radius * (kAngle - std::sin(kAngle)), kSingle * round->radius);
}

/// A sphere turns about the y axis by an angle a, with its centre fixed, so that another of its points touches. The point that
/// touched before has moved by r sin a along x.
TEST(LoadMeter, TheWayIsThatOfThePointThatTouchedBefore) {
  LoadedRobot made;
  const auto& elements = made.elements();
  const auto round = std::ranges::find_if(elements, [](const ContactElement& e) { return e.radius > 0; });
  ASSERT_NE(round, elements.end());
  const auto e = static_cast<std::size_t>(round - elements.begin());
  made.place();
  made.bear(e, 1);
  made.measure();
  constexpr double kAngle = 0.3;
  const Vec3 before = made.centre(e);
  made.state().orientation = Quat(Eigen::AngleAxisd(kAngle, Vec3::UnitY()));
  made.place();
  made.state().position += before - made.centre(e);
  made.place();
  made.bear(e, 1);
  made.meter().sample().contacts[e].point = before + Vec3(round->radius, 0, 0);
  made.measure();
  EXPECT_NEAR(made["slip"], round->radius * std::sin(kAngle), kSingle * round->radius);
}

/// The robot turns about the vertical through one element of a foot. Another element moves along a chord.
TEST(LoadMeter, AFootSlidesByTheMeanOfItsElementsWeightedByLoad) {
  LoadedRobot made;
  made.place();
  std::size_t axis = 0;
  std::size_t far = 1;
  const auto& all = made.elements();
  const auto distance = [&] { return (made.centre(axis) - made.centre(far)).head<2>().norm(); };
  while (far < all.size() && (all[axis].body != all[far].body || distance() < 0.01)) {
    if (++far < all.size()) continue;
    far = ++axis + 1;
  }
  ASSERT_LT(far, all.size());
  const double arm = distance();
  const Vec3 point = made.centre(axis);
  made.bear(axis, 0.6, {3, 0, 0});
  made.bear(far, 0.2, {0, 5, 0});
  made.measure();
  EXPECT_NEAR(made[made.foot(axis, "fx")], 3, 3 * kSingle);
  EXPECT_NEAR(made[made.foot(axis, "fy")], 5, 5 * kSingle);
  EXPECT_NEAR(made[made.foot(axis, "fz")], 0.8 * made.weight(), made.weight() * kSingle);
  EXPECT_NEAR(made[made.foot(axis, "x")], 0.75 * point.x() + 0.25 * made.centre(far).x(), kSingle) << "three quarters";
  EXPECT_EQ(made["slip"], 0);
  constexpr double kAngle = 0.4;
  made.state().orientation = Quat(Eigen::AngleAxisd(kAngle, Vec3::UnitZ()));
  made.place();
  made.state().position += point - made.centre(axis);
  made.place();
  made.bear(axis, 0.6);
  made.bear(far, 0.2);
  made.measure();
  const double chord = 2 * arm * std::sin(kAngle / 2);
  EXPECT_NEAR(made[made.foot(axis, "slid")], chord / 4, kSingle);
  EXPECT_NEAR(made["slip"], 0.2 * chord, kSingle);
}

TEST(LoadMeter, StabilityIsTheDistanceToTheEdgeOfTheLoadedPoints) {
  LoadedRobot made;
  made.place();
  const Vec3 com = made.meter().sample().sums.com;
  const auto bear_at = [&](std::size_t element, double share, double x, double y) {
    made.bear(element, share);
    made.meter().sample().contacts[element].point = com + Vec3(x, y, -1);
  };
  bear_at(0, 0.25, -0.1, -0.2);
  bear_at(1, 0.25, 0.3, -0.2);
  bear_at(2, 0.25, 0.3, 0.2);
  bear_at(3, 0.25, -0.1, 0.2);
  bear_at(4, 0.004, -9, 0);  // the load flickers
  made.measure();
  EXPECT_NEAR(made["stability"], 0.1, kSingle);
  for (const std::size_t lifted : {0U, 3U}) bear_at(lifted, 0, 0, 0);
  made.measure();
  EXPECT_NEAR(made["stability"], -0.3, kSingle) << "a line beside it";
}

/// At rest a dock bears the weight of all modules beyond it. The expected force along and across the faces, and the moment
/// about their origin, use the normal of the child's face; the meter uses that of the parent's face.
TEST(LoadMeter, ADockAtRestBearsTheWeightBehindIt) {
  LoadedRobot made;
  made.state().orientation = Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  for (double& angle : made.state().q) angle = 0.4;
  made.place();
  const Robot& robot = made.robot();
  Sample& sample = made.meter().sample();
  Acceleration none;
  none.joints.assign(robot.joints.size(), 0.0);
  sample.reactions.update(sample.kinematics, none, sample.gravity);
  ASSERT_TRUE(made.meter().want_reactions());
  made.measure();
  std::size_t leaves = 0;
  for (std::size_t m = 1; m < robot.modules.size(); ++m) {
    if (std::ranges::any_of(robot.modules, [&](const Module& other) { return other.parent == static_cast<int>(m); })) continue;
    ++leaves;
    const Module& module = robot.modules[m];
    const ModuleType& type = robot.types[module.type];
    const auto in_world = [&](std::size_t of_type) {
      const Body& body = robot.bodies[module.first_body + of_type];
      return Pose{sample.kinematics.R[body.link], sample.kinematics.p[body.link]} * body.in_link;
    };
    double mass = 0;
    Vec3 first_moment = Vec3::Zero();
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
      mass += type.bodies[b].mass;
      first_moment += type.bodies[b].mass * (in_world(b) * type.bodies[b].com);
    }
    const FaceType& face = *find_face(type, module.dock.child_face);
    const Vec3 normal = -(in_world(face.body).R * face.normal);
    const Vec3 weight(0, 0, -9.81 * mass);
    const Vec3 moment = -(first_moment / mass - in_world(face.body) * face.origin).cross(weight);
    const std::string dock = "dock." + std::to_string(m) + ".";
    const double force_rounding = kSingle * weight.norm();
    EXPECT_NEAR(made[dock + "tension"], weight.dot(normal), force_rounding) << "positive where it hangs below";
    EXPECT_NEAR(made[dock + "shear"], weight.cross(normal).norm(), force_rounding);
    EXPECT_NEAR(made[dock + "torsion"], moment.dot(normal), kSingle * moment.norm());
    EXPECT_NEAR(made[dock + "bending"], moment.cross(normal).norm(), kSingle * moment.norm());
  }
  EXPECT_GE(leaves, 1U);
}

/// These modules state no ratings of their connectors. A verdict therefore does not need the reactions of their docks, forces
/// and margin.
TEST(LoadMeter, LeavesOutColumnsThatNobodyJudges) {
  const LoadedRobot all;
  EXPECT_TRUE(all.has("dock."));
  EXPECT_TRUE(all.has(".fz"));
  EXPECT_TRUE(all.has("stability"));
  LoadedRobot judged(Loads::judged);
  EXPECT_FALSE(judged.has("dock."));
  EXPECT_FALSE(judged.has(".fz"));
  EXPECT_FALSE(judged.has("stability"));
  EXPECT_FALSE(judged.meter().want_reactions());
  judged.place();
  judged.bear(0, 1);
  judged.measure();
  judged.state().position.x() += 0.5;
  judged.place();
  judged.bear(0, 1);
  judged.measure();
  EXPECT_NEAR(judged[judged.foot(0, "slid")], 0.5, kSingle);
  EXPECT_NEAR(judged["slip"], 0.5, kSingle);
}

TEST(LoadMeter, DropsTheFeetThatNeverBoreALoad) {
  for (const Loads wanted : {Loads::recorded, Loads::judged}) {
    LoadedRobot made(wanted);
    const std::size_t last = made.elements().size() - 1;
    made.place();
    made.bear(last, 1);
    made.measure();
    Trace loads;
    loads.columns = made.meter().columns();
    loads.values.assign(made.row().begin(), made.row().end());
    made.meter().sample().contacts[last] = {};
    made.measure();
    loads.values.insert(loads.values.end(), made.row().begin(), made.row().end());
    const Trace whole = loads;
    made.meter().drop_idle_feet(loads);
    ASSERT_EQ(loads.rows(), 2U);
    const std::string kept = made.foot(last, "");
    for (const Column& column : whole.columns) {
      const std::size_t at = loads.find(column.name);
      EXPECT_EQ(at < loads.columns.size(), !column.name.starts_with("foot.") || column.name.starts_with(kept)) << column.name;
      for (std::size_t row = 0; row < 2 && at < loads.columns.size(); ++row) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(loads.at(row, at)),
                  std::bit_cast<std::uint64_t>(whole.at(row, whole.find(column.name))))
            << column.name;
      }
    }
  }
}

}  // namespace
}  // namespace gaitlab
