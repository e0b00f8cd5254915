// Tests of engine `articulated` alone: the recursion with resistances of joints and points agrees with dense matrices.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <functional>

#include "core/dynamics/mass_matrix.h"
#include "core/simulation/plant.h"
#include "physics_articulated/eigen.h"
#include "physics_articulated/engine.h"
#include "physics_articulated/kernel.h"
#include "tests/random_robots.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

using articulated::vec;

/// The generalised components, of 6 + joints, that exist with this base.
Eigen::VectorXd kept(const std::vector<double>& all, Base base) {
  const auto entries = base_entries(base);
  Eigen::VectorXd some(static_cast<Eigen::Index>(entries.size() + all.size() - 6));
  Eigen::Index at = 0;
  for (const std::size_t e : entries) some[at++] = all[e];
  for (std::size_t j = 6; j < all.size(); ++j) some[at++] = all[j];
  return some;
}

/// Jacobian of a link's point, d(velocity of the point) / d(generalised velocity), column by column from the kinematics.
Eigen::MatrixXd jacobian(const Robot& robot, const RobotState& state, Base base, std::size_t link, const Vec3& point) {
  const std::size_t size = 6 + robot.joints.size();
  std::vector<Eigen::VectorXd> rows(3);
  std::vector<std::vector<double>> columns(3, std::vector<double>(size));
  Kinematics k(robot);
  for (std::size_t i = 0; i < size; ++i) {
    RobotState unit = state;
    unit.velocity = unit.angular_velocity = Vec3::Zero();
    std::fill(unit.qd.begin(), unit.qd.end(), 0.0);
    (i < 3   ? unit.velocity[static_cast<Eigen::Index>(i)]
     : i < 6 ? unit.angular_velocity[static_cast<Eigen::Index>(i - 3)]
             : unit.qd[i - 6]) = 1;
    k.update(robot, unit);
    const Vec3 v = k.velocity(link, point);
    for (std::size_t a = 0; a < 3; ++a) columns[a][i] = v[static_cast<Eigen::Index>(a)];
  }
  Eigen::MatrixXd J(3, kept(columns[0], base).size());
  for (Eigen::Index a = 0; a < 3; ++a) J.row(a) = kept(columns[static_cast<std::size_t>(a)], base).transpose();
  return J;
}

struct Solved {
  double error = 0, respond_error = 0;  ///< relative to the largest acceleration
};

/// Errors of the recursion relative to the dense system for a random robot, with resistances of size `resist` on joints and
/// points.
Solved solve(RandomRobots& random, Base base, double resist) {
  const Robot robot = random.robot();
  const RobotState state = random.state(robot, base);
  const Vec3 gravity = random.vector(10);
  const articulated::Tree<double> tree = articulated::tree(robot, base, {});
  articulated::TreeBody<double> body(tree, vec(gravity));
  std::vector<double> x(StateLayout::kAngles + 2 * robot.joints.size());
  StateLayout{robot.joints.size(), 1}.write(state, 0, x);
  for (std::size_t e = 3; e < 7; ++e) x[e] *= 1.3;  // the quaternion need not have the length 1
  using Load = articulated::TreeBody<double>::Load;
  std::vector<std::pair<std::size_t, std::function<void(Load)>>> loads;
  body.forward_kinematics(x);

  Kinematics k(robot);
  k.update(robot, state);
  MassMatrix mass(robot, base);
  mass.update(k);
  Eigen::MatrixXd matrix = mass.matrix();
  std::vector<double> torque, diagonal;
  const auto first = matrix.rows() - static_cast<Eigen::Index>(robot.joints.size());
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    torque.push_back(random.uniform(-1, 1));
    diagonal.push_back(resist * random.uniform(0, 1e-2));
    matrix(first + static_cast<Eigen::Index>(j), first + static_cast<Eigen::Index>(j)) += diagonal.back();
  }
  std::vector<BodyWrench> wrenches;
  for (int i = 0; i < 4; ++i) {
    const BodyWrench w{random.below(robot.bodies.size()), state.position + random.vector(1), random.vector(5), Vec3::Zero()};
    wrenches.push_back(w);
    const std::size_t link = robot.bodies[w.body].link;
    loads.emplace_back(link, [=](Load load) { load.add_force(vec(w.point - state.position), vec(w.force)); });
    const Mat3 root = Vec3(random.uniform(0, 1), random.uniform(0, 1), 0).asDiagonal() * random.rotation();
    const Mat3 G = resist * root.transpose() * root;  // positive semidefinite and singular, like sliding friction
    loads.emplace_back(link, [=](Load load) { load.add_resistance(vec(w.point - state.position), articulated::sym(G)); });
    const Eigen::MatrixXd J = jacobian(robot, state, base, link, w.point);
    matrix += J.transpose() * G * J;
  }
  std::vector<double> a(6 + robot.joints.size());
  body.solve(torque, diagonal, a, [&](std::size_t link, Load load) {
    for (const auto& [at, act] : loads) {
      if (at == link) act(load);
    }
  });

  Acceleration none;
  none.joints.assign(robot.joints.size(), 0.0);
  InverseDynamics at_rest(robot);
  at_rest.update(k, none, gravity, wrenches);
  std::vector<double> all(6, 0.0);
  all.insert(all.end(), torque.begin(), torque.end());
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  const Eigen::VectorXd dense = factor.solve(kept(all, base) - generalised_force(at_rest, base));
  Solved result;
  result.error = (kept(a, base) - dense).norm() / dense.lpNorm<Eigen::Infinity>();

  for (double& f : all) f = random.uniform(-1, 1);
  body.respond(all, a);
  const Eigen::VectorXd response = factor.solve(kept(all, base));
  result.respond_error = (kept(a, base) - response).norm() / response.lpNorm<Eigen::Infinity>();
  return result;
}

class ArticulatedBody : public testing::TestWithParam<Base> {};
INSTANTIATE_TEST_SUITE_P(EveryBase, ArticulatedBody, testing::Values(Base::floating, Base::planar, Base::fixed));

TEST_P(ArticulatedBody, SolvesWhatDenseMatricesSay) {
  RandomRobots random(21);
  for (const double resist :
       {0.0, 1.0, 1e3}) {  // no resistance, resistance as large as the masses, and as large as friction at long steps
    Solved worst;
    for (int i = 0; i < 40; ++i) {
      const Solved one = solve(random, GetParam(), resist);
      worst = {std::max(worst.error, one.error), std::max(worst.respond_error, one.respond_error)};
    }
    validate_below({"property.articulated.dense",
                    "engine articulated: recursion with resistances against the dense system, 360 random assemblies",
                    "composite rigid bodies, Newton-Euler, Cholesky", ""},
                   worst.error, 1e-9, "rounding times the condition of M, 1e-16 * 1e5, and as much again");
    EXPECT_LT(worst.respond_error, 1e-9);
  }
}

/// Block of 1 kg that slides or sticks on a plane. The tests compare the velocity after one step with its closed form. In the
/// steps, the contact sticks, slides, or changes from one to the other.
class BlockOnPlane : public testing::Test {
 protected:
  BlockOnPlane() {
    ModuleType type;
    type.name = "block";
    type.bodies = {{"block", 1, Vec3::Zero(), 0.01 * Mat3::Identity()}};
    settings.robot = std::make_shared<const Robot>(assemble({type}, {0}, {}));
    settings.gravity = {0, 0, -10};
    ContactElement point;
    settings.contacts = {point};
    settings.law.cd = 0;
    settings.integrator = "implicit";
  }
  /// Velocity after one step of h from `speed` along x, at the depth that carries the weight.
  [[nodiscard]] double after(double speed, double h) const {
    Catalog catalog;
    register_articulated(catalog);
    const std::unique_ptr<Plant> plant = catalog.engine("articulated")->make(settings);
    std::vector<double> x(StateLayout::kAngles);
    x[StateLayout::kPosition + 2] = -1e-3;
    x[StateLayout::kOrientation] = 1;
    x[StateLayout::kVelocity] = speed;
    std::vector<double> history(plant->history());
    plant->bind(x, history);
    plant->advance({}, h);
    EXPECT_EQ(x[StateLayout::kVelocity + 1], 0);
    return x[StateLayout::kVelocity];
  }
  PlantSettings settings;
  static constexpr double kRound = 1e-14;  // rounding errors of some operations with numbers of 1
};

TEST_F(BlockOnPlane, SticksByBackwardEuler) {
  // With f Fn / v_lim = 800 N s/m, the speed after a step is v / (1 + 800 h).
  EXPECT_NEAR(after(0.005, 1e-2), 0.005 / 9, kRound);
}
TEST_F(BlockOnPlane, SlidesUnderConstantFriction) { EXPECT_NEAR(after(1, 1e-2), 1 - 8 * 1e-2, kRound); }
TEST_F(BlockOnPlane, ComesToRestWithoutTurningBack) {
  // Sliding in the whole step would give 0.015 - 0.08. The contact sticks at the end, which gives v / (1 + 800 h).
  EXPECT_NEAR(after(0.015, 1e-2), 0.015 / 9, kRound);
  // With the shorter step, sliding alone would end at 0.015 - 8 h = 0.007, below v_lim, so that the contact also sticks.
  EXPECT_NEAR(after(0.015, 1e-3), 0.015 / 1.8, kRound);
}
TEST_F(BlockOnPlane, StartsToSlideWithinAStep) {
  settings.gravity = {20, 0, -10};
  // Sticking would give (0 + 20 h) / 9 = 0.0222, above v_lim. The block slides, which gives (20 - 8) h.
  EXPECT_NEAR(after(0, 1e-2), 0.12, kRound);
}

TEST(ArticulatedEngine, RegistersWithItsDefaults) {
  Catalog catalog;
  register_articulated(catalog);
  const Engine* engine = catalog.engine("articulated");
  ASSERT_NE(engine, nullptr);
  EXPECT_EQ(engine->integrator_names(), (std::vector<std::string>{"adaptive", "implicit", "extrapolated", "rk4"}));
  EXPECT_EQ(engine->adaptive()->name, "adaptive");
  EXPECT_EQ(engine->fixed().name, "implicit");
  EXPECT_EQ(engine->step, 5e-4);
  EXPECT_TRUE(engine->rotor_inertia);
  EXPECT_THROW(
      {
        PlantSettings settings;
        settings.robot = std::make_shared<const Robot>();
        settings.integrator = "euler";
        engine->make(settings);
      },
      std::invalid_argument);
}

}  // namespace
}  // namespace gaitlab::test
