// Inverse dynamics and mass matrix agree with kinetic energy, momentum, each other, statics, and a chain computed by hand.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/dynamics/mass_matrix.h"
#include "core/dynamics/mobility.h"
#include "tests/random_robots.h"

namespace gaitlab::test {
namespace {

constexpr int kRobots = 30;
// Rounding errors of sums of some hundred terms, 1.1e-16 of the largest term each.
constexpr double kDynamicsRounding = 1e-13;

Kinematics moved(const Robot& robot, const RobotState& state) {
  Kinematics k(robot);
  k.update(robot, state);
  return k;
}

/// Generalised velocity of a state, in the order of the mass matrix.
Eigen::VectorXd generalised(const Vec3& linear, const Vec3& angular, const std::vector<double>& joints, Base base) {
  const auto entries = base_entries(base);
  Eigen::VectorXd v(static_cast<Eigen::Index>(entries.size() + joints.size()));
  Eigen::Index at = 0;
  for (const std::size_t i : entries) {
    v[at++] = i < 3 ? linear[static_cast<Eigen::Index>(i)] : angular[static_cast<Eigen::Index>(i - 3)];
  }
  for (const double x : joints) v[at++] = x;
  return v;
}

class EveryBase : public testing::TestWithParam<Base> {};
INSTANTIATE_TEST_SUITE_P(Dynamics, EveryBase, testing::Values(Base::floating, Base::planar, Base::fixed));

TEST_P(EveryBase, MassMatrixGivesKineticEnergyAndMomentum) {
  RandomRobots random(1);
  for (int i = 0; i < kRobots; ++i) {
    const Robot robot = random.robot();
    const RobotState state = random.state(robot, GetParam());
    const Kinematics k = moved(robot, state);
    MassMatrix mass(robot, GetParam());
    mass.update(k);
    const Eigen::VectorXd v = generalised(state.velocity, state.angular_velocity, state.qd, GetParam());
    const Sums s = sums(robot, k, Vec3::Zero());
    EXPECT_NEAR(0.5 * v.dot(mass.matrix() * v), s.kinetic, kDynamicsRounding * s.kinetic);
    if (GetParam() != Base::floating) continue;
    const Eigen::VectorXd momentum = mass.matrix() * v;
    const Vec3 angular = s.angular_momentum - state.position.cross(s.momentum);
    EXPECT_LT((momentum.head<3>() - s.momentum).norm(), kDynamicsRounding * robot.mass * 10);
    EXPECT_LT((momentum.segment<3>(3) - angular).norm(), kDynamicsRounding * robot.mass * 10);
  }
}

TEST_P(EveryBase, MassMatrixAndBiasMakeTheInverseDynamics) {
  RandomRobots random(2);
  for (int i = 0; i < kRobots; ++i) {
    const Robot robot = random.robot();
    const Kinematics k = moved(robot, random.state(robot, GetParam()));
    const Vec3 gravity = random.vector(10);
    const BodyWrench pull{random.below(robot.bodies.size()), random.vector(1), random.vector(5), random.vector(1)};
    const Acceleration a = random.acceleration(robot, GetParam());
    Acceleration none;
    none.joints.assign(robot.joints.size(), 0.0);
    MassMatrix mass(robot, GetParam());
    mass.update(k);
    InverseDynamics dynamics(robot);
    dynamics.update(k, none, gravity, {&pull, 1});
    const Eigen::VectorXd bias = generalised_force(dynamics, GetParam());
    dynamics.update(k, a, gravity, {&pull, 1});
    const Eigen::VectorXd force = generalised_force(dynamics, GetParam());
    const Eigen::VectorXd sum = mass.matrix() * generalised(a.linear, a.angular, a.joints, GetParam()) + bias;
    EXPECT_LT((sum - force).norm(), kDynamicsRounding * (1 + force.norm()));
  }
}

/// Jacobian of the origin of a link and of its rotation, column by column from the velocities of Kinematics.
Eigen::MatrixXd jacobian(const Robot& robot, RobotState state, std::size_t link, Base base) {
  const auto columns = static_cast<Eigen::Index>(base_entries(base).size() + robot.joints.size());
  Eigen::MatrixXd J(6, columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    state.velocity = state.angular_velocity = Vec3::Zero();
    state.qd.assign(robot.joints.size(), 0.0);
    const auto at = static_cast<std::size_t>(c);
    if (at < base_entries(base).size()) {
      const std::size_t entry = base_entries(base)[at];
      (entry < 3 ? state.velocity : state.angular_velocity)[static_cast<Eigen::Index>(entry % 3)] = 1;
    } else {
      state.qd[at - base_entries(base).size()] = 1;
    }
    const Kinematics k = moved(robot, state);
    J.col(c) << k.v[link], k.omega[link];
  }
  return J;
}

/// The recursion gives J M^-1 J^T and the diagonal of M^-1 of the mass matrix, which it does not form.
TEST_P(EveryBase, MobilityIsThatOfTheMassMatrix) {
  constexpr double kRounding = 1e-10;  // 1e-16, times the condition of M, up to 1e6
  RandomRobots random(5);
  for (int i = 0; i < kRobots; ++i) {
    const Robot robot = random.robot();
    const RobotState state = random.state(robot, GetParam());
    const Kinematics k = moved(robot, state);
    std::vector<double> armature(robot.joints.size());
    for (double& one : armature) one = random.scaled(1e-5, 1e-3);
    if (robot.dof(GetParam()) == 0) continue;
    const Mobility own = mobility(robot, GetParam(), k, armature);
    MassMatrix mass(robot, GetParam());
    mass.update(k);
    Eigen::MatrixXd M = mass.matrix();
    for (std::size_t j = 0; j < armature.size(); ++j) {
      const Eigen::Index at = M.rows() - static_cast<Eigen::Index>(armature.size() - j);
      M(at, at) += armature[j];
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(M);
    for (std::size_t j = 0; j < armature.size(); ++j) {
      const Eigen::Index at = M.rows() - static_cast<Eigen::Index>(armature.size() - j);
      const double expected = solver.solve(Eigen::VectorXd::Unit(M.rows(), at))[at];
      EXPECT_NEAR(own.joints[j], expected, kRounding * expected);
    }
    for (std::size_t l = 0; l < robot.links.size(); ++l) {
      const Eigen::MatrixXd J = jacobian(robot, state, l, GetParam());
      const Eigen::MatrixXd expected = J * solver.solve(J.transpose());
      EXPECT_LE((own.links[l] - expected).norm(), kRounding * expected.norm()) << l;
      const Vec3 x = k.p[l] + random.vector(0.1);
      Eigen::MatrixXd to = Eigen::MatrixXd::Zero(3, 6);
      for (int axis = 0; axis < 3; ++axis) {
        to.col(axis) = Vec3::Unit(axis);
        to.col(3 + axis) = Vec3::Unit(axis).cross(x - k.p[l]);
      }
      EXPECT_NEAR(own.at(l, x, k), (to * expected * to.transpose()).trace() / 3, kRounding * expected.norm());
    }
  }
}

/// The time derivative of the kinetic energy with v' = a equals the power of the forces. This tests the velocity terms, which
/// the mass matrix does not contain.
TEST_P(EveryBase, PowerIsTheRateOfKineticEnergy) {
  RandomRobots random(3);
  for (int i = 0; i < kRobots; ++i) {
    const Robot robot = random.robot();
    const RobotState state = random.state(robot, GetParam());
    const Acceleration a = random.acceleration(robot, GetParam());
    const auto kinetic = [&](double t) {
      RobotState s = state;
      s.position += t * state.velocity;
      s.velocity += t * a.linear;
      s.orientation = turn(t * state.angular_velocity) * state.orientation;
      s.angular_velocity += t * a.angular;
      for (std::size_t j = 0; j < s.q.size(); ++j) {
        s.q[j] += t * state.qd[j];
        s.qd[j] += t * a.joints[j];
      }
      return sums(robot, moved(robot, s), Vec3::Zero()).kinetic;
    };
    // The five-point derivative has the error t^4/30 times the fifth derivative, and the rounding error 1e-16 / t.
    constexpr double t = 2e-4;
    const double rate = (8 * (kinetic(t) - kinetic(-t)) - (kinetic(2 * t) - kinetic(-2 * t))) / (12 * t);
    InverseDynamics dynamics(robot);
    dynamics.update(moved(robot, state), a, Vec3::Zero());
    const Eigen::VectorXd v = generalised(state.velocity, state.angular_velocity, state.qd, GetParam());
    EXPECT_NEAR(generalised_force(dynamics, GetParam()).dot(v), rate, 1e-8 * (1 + std::abs(rate)));
  }
}

/// Indices of all bodies of a module and of the modules that are docked to it, directly or indirectly.
std::vector<std::size_t> hanging_on(const Robot& robot, std::size_t module) {
  std::vector<std::size_t> bodies;
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    for (int m = static_cast<int>(robot.bodies[b].module); m >= 0; m = robot.modules[static_cast<std::size_t>(m)].parent) {
      if (m == static_cast<int>(module)) bodies.push_back(b);
    }
  }
  return bodies;
}

TEST(Reactions, DockOfARobotAtRestCarriesWhatHangsOnIt) {
  RandomRobots random(4);
  for (int i = 0; i < kRobots; ++i) {
    const Robot robot = random.robot();
    RobotState state = random.state(robot, Base::fixed);
    state.qd.assign(state.qd.size(), 0.0);
    const Kinematics k = moved(robot, state);
    const Vec3 gravity(0.3, -0.2, -9.81);
    Acceleration none;
    none.joints = state.qd;
    InverseDynamics dynamics(robot);
    dynamics.update(k, none, gravity);
    for (std::size_t m = 1; m < robot.modules.size(); ++m) {
      const Module& parent = robot.modules[static_cast<std::size_t>(robot.modules[m].parent)];
      Vec3 origin = Vec3::Zero();
      for (const FaceType& face : robot.types[parent.type].faces) {
        const Body& on = robot.bodies[parent.first_body + face.body];
        if (face.id == robot.modules[m].dock.parent_face) origin = k.point(on.link, on.in_link * face.origin);
      }
      Wrench expected;
      for (const std::size_t b : hanging_on(robot, m)) {
        const Body& body = robot.bodies[b];
        const BodyType& type = robot.types[robot.modules[body.module].type].bodies[body.type];
        const Vec3 weight = type.mass * gravity;
        expected.force -= weight;
        expected.moment -= (k.point(body.link, body.in_link * type.com) - origin).cross(weight);
      }
      EXPECT_LT((dynamics.dock(m).force - expected.force).norm(), kDynamicsRounding * 50);
      EXPECT_LT((dynamics.dock(m).moment - expected.moment).norm(), kDynamicsRounding * 50);
    }
  }
}

/// Chain of two rods that hang on hinges. Rod k has mass m_k, and its centre of mass is l_k below its hinge and y_k aside along
/// the hinge axis y.
class HangingChain : public testing::Test {
 protected:
  HangingChain() : robot_(assemble({type()}, {0}, {})) {
    state_.q = {0, 0};
    state_.qd = {kW1, kW2};
    none_.joints = {0, 0};
  }

  static ModuleType type() {
    ModuleType t;
    t.name = "chain";
    t.bodies = {{"hook", 1, Vec3::Zero(), Mat3::Identity()},
                {"upper", kM1, {0, 0, -kL1}, Vec3(0.01, 0.01, 1e-4).asDiagonal()},
                {"lower", kM2, {0, kY2, -kL2}, Vec3(0.02, 0.02, 1e-4).asDiagonal()}};
    t.hinges = {{"top", 0, 1, {Mat3::Identity(), {0, 0, -0.1}}, Vec3::UnitY(), -3, 3},
                {"middle", 1, 2, {Mat3::Identity(), {0, 0, -kLength}}, Vec3::UnitY(), -3, 3}};
    return t;
  }

  static constexpr double kM1 = 2, kM2 = 3, kL1 = 0.4, kL2 = 0.25, kLength = 0.9, kY2 = 0.05, kW1 = 1.5, kW2 = -4, kG = 10;
  Robot robot_;
  RobotState state_;
  Acceleration none_;
};

TEST_F(HangingChain, CarriesWeightAndCentrifugalForce) {
  InverseDynamics dynamics(robot_);
  dynamics.update(moved(robot_, state_), none_, {0, 0, -kG});
  // At its lowest point the chain is vertical, and every centre of mass has the upward acceleration w^2 r about its hinges.
  const double lower = kM2 * (kG + kW1 * kW1 * kLength + (kW1 + kW2) * (kW1 + kW2) * kL2);
  const double upper = kM1 * (kG + kW1 * kW1 * kL1);
  EXPECT_NEAR(dynamics.hinge(1).force.z(), lower, kDynamicsRounding * lower);
  EXPECT_NEAR(dynamics.hinge(0).force.z(), lower + upper, kDynamicsRounding * lower);
  EXPECT_NEAR(dynamics.base().force.z(), lower + upper + 1 * kG, kDynamicsRounding * lower);
  // The lower rod hangs kY2 aside along the axis, so that the bearing carries a moment about x.
  EXPECT_NEAR(dynamics.hinge(1).moment.x(), kY2 * lower, kDynamicsRounding * lower);
  EXPECT_NEAR(dynamics.hinge(0).moment.x(), kY2 * lower, kDynamicsRounding * lower);
  for (const double torque : dynamics.torques()) EXPECT_NEAR(torque, 0, kDynamicsRounding * lower);
}

TEST_F(HangingChain, OneMoreTorqueAndForceFromOutsideAreCarried) {
  InverseDynamics dynamics(robot_);
  state_.qd = {0, 0};
  const std::array<BodyWrench, 1> pull{{{2, {0.3, 0, -2}, {7, 0, 0}, {0, 0.5, 0}}}};
  dynamics.update(moved(robot_, state_), none_, Vec3::Zero(), pull);
  EXPECT_NEAR(dynamics.hinge(1).force.x(), -7, kDynamicsRounding);
  // A force of 7 N along x acts 1 m below the lower and 1.9 m below the upper hinge. Its moment about y is 7 N times the
  // distance.
  EXPECT_NEAR(dynamics.torques()[1], 7 * 1.0 - 0.5, kDynamicsRounding * 10);
  EXPECT_NEAR(dynamics.torques()[0], 7 * 1.9 - 0.5, kDynamicsRounding * 10);
}

}  // namespace
}  // namespace gaitlab::test
