// Largest stable step of explicit methods: the power iteration for the decay rate lambda agrees with dense eigenvalues, and the
// messages are correct.
#include "core/simulation/stability.h"

#include <Eigen/Eigenvalues>

#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// These tests simulate a whole walk with engine bullet.
const Label kLateWarning("LambdaRule.Warns*", "long;unsanitized");

/// Dense inverse mass matrix of a robot at zero angles, computed from the kinetic energies of unit velocities.
class DenseMass final : public InverseMass {
 public:
  DenseMass(const Robot& robot, const Kinematics& at) : size_(static_cast<Eigen::Index>(6 + robot.joints.size())) {
    Eigen::MatrixXd mass(size_, size_);
    for (Eigen::Index i = 0; i < size_; ++i) {
      for (Eigen::Index j = 0; j < size_; ++j)
        mass(i, j) = (energy(robot, at, i, j) - energy(robot, at, i, -1) - energy(robot, at, j, -1));
    }
    inverse = mass.inverse();
  }
  void apply(In force, Out acceleration) override {
    const Eigen::Map<const Eigen::VectorXd> f(force.data(), size_);
    Eigen::Map<Eigen::VectorXd>(acceleration.data(), size_) = inverse * f;
  }
  Eigen::MatrixXd inverse;

 private:
  static double energy(const Robot& robot, Kinematics k, Eigen::Index i, Eigen::Index j) {
    RobotState state;
    state.q.assign(robot.joints.size(), 0.0);
    state.qd = state.q;
    for (const Eigen::Index one : {i, j}) {
      if (one < 0) continue;
      if (one < 3) state.velocity[one] += 1;
      if (one >= 3 && one < 6) state.angular_velocity[one - 3] += 1;
      if (one >= 6) state.qd[static_cast<std::size_t>(one - 6)] += 1;
    }
    k.update(robot, state);
    return sums(robot, k, Vec3::Zero()).kinetic;
  }
  Eigen::Index size_;
};

TEST(LambdaRule, PowerIterationFindsTheLargestEigenvalue) {
  const Scenario s = shipped("caterpillar.yaml");
  const Robot& robot = *s.robot;
  Kinematics k(robot);
  RobotState zero;
  zero.q.assign(robot.joints.size(), 0.0);
  zero.qd = zero.q;
  k.update(robot, zero);
  DenseMass mass(robot, k);
  RateMonitor monitor(robot);
  for (const double friction : {0.0, 400.0, 4000.0}) {  // N s/m; motors, both, or the contact determine lambda
    monitor.motor.assign(robot.joints.size(), 0.896);
    monitor.contacts.assign(
        1, {0, 3, k.point(3, Vec3(0.03, 0.02, -0.03)), Vec3::UnitZ(), Vec3::UnitY(), friction, 0.3 * friction});
    // Dense damping matrix, whose columns are the forces of unit velocities.
    Eigen::MatrixXd damping = Eigen::MatrixXd::Zero(22, 22);
    for (Eigen::Index j = 0; j < 16; ++j) damping(6 + j, 6 + j) = 0.896;
    Eigen::MatrixXd jacobian(3, 22);
    for (Eigen::Index i = 0; i < 22; ++i) {
      RobotState unit = zero;
      if (i < 3) unit.velocity[i] = 1;
      if (i >= 3 && i < 6) unit.angular_velocity[i - 3] = 1;
      if (i >= 6) unit.qd[static_cast<std::size_t>(i - 6)] = 1;
      Kinematics moving(robot);
      moving.update(robot, unit);
      jacobian.col(i) = moving.velocity(3, monitor.contacts[0].point);
    }
    const Mat3 g = Vec3(friction, 0, 0.3 * friction).asDiagonal();  // slope 0 along the slip (y), normal slope along z
    damping += jacobian.transpose() * g * jacobian;
    const double largest = (mass.inverse * damping).eigenvalues().real().maxCoeff();
    const Stability found = monitor.largest(robot, k, mass, 200);
    // After 200 iterations the error is below 0.98^400, because the closest modes of the chain differ by 1 % and the error of a
    // Rayleigh quotient is quadratic.
    EXPECT_NEAR(found.rate, largest, 1e-3 * largest) << friction;
    EXPECT_EQ(found.source, friction > 1000 ? Stability::Source::contact : Stability::Source::motor) << friction;
    // After the 20 iterations of the monitor, the rate is at most 3 % too small.
    const double quick = monitor.largest(robot, k, mass, 20).rate;
    EXPECT_LE(quick, largest * (1 + 1e-12));
    EXPECT_NEAR(quick, largest, 0.03 * largest) << friction;
  }
}

TEST(LambdaRule, RefusesAStepThatIsTooLong) {
  const Folder folder;
  const Result result = gaitlab("run '" + kScenarios + "caterpillar.yaml' --set physics.step=2e-4 --out out", folder / "");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(
      result.err,
      "--set physics.step=2e-4: error: step 0.0002 s is too long: the largest allowed is 6.44e-05 s, set by the motor of joint "
      "m0/active (standing; h lambda = 3.11, allowed up to 1); use step: 5e-05\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(LambdaRule, JudgesTheStandingRobotByMotorsAtRest) {
  // At 20 rad/s the motors are at their current limit and do not damp. The check must not rely on this, because speeds fall.
  const Folder folder;
  const Result result =
      gaitlab("check '" + kScenarios + "caterpillar.yaml' --set physics.step=1e-4 --set initial.speeds=20", folder / "");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("h lambda = 1.55"), std::string::npos) << result.err;
}

TEST(LambdaRule, AFixedRobotInTheAirStandsOnNothing) {
  const Scenario s = scenario(
      "gaitlab: 1\nrobot: {modules: mtran, base: fixed, position: [0, 0, 1]}\nduration: 0.1\n"
      "physics: {step: 5e-5}\nground: {friction: 5}\ncontact: {slip_speed: 1e-3}\n");
  EXPECT_NO_THROW(Simulation({&s, 1}));
}

TEST(LambdaRule, WarnsInTheSameWordsWhereTheGroundBindsLater) {
  const Folder folder;
  const Result result = gaitlab(
      "run '" + kScenarios +
          "caterpillar.yaml' --set physics.integrator=semi_implicit --set ground.friction=1.2 --set contact.slip_speed=0.002 "
          "--set duration=4.5 --out out",
      folder / "");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.err.find("warning: h lambda exceeds 1 in "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("step 2.5e-05 s is too long: the largest allowed is "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("set by the contact m"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace gaitlab::test
