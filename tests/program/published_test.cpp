// Comparison with published results of other programs. The files tests/published/*.yaml contain the models and their sources.
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "core/dynamics/inverse_dynamics.h"
#include "core/scenario/read_scenario.h"
#include "tests/folders.h"
#include "tests/program/fixture.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

const std::string kPublished = std::string(gaitlab::test::source_folder()) + "/tests/published/";

Scenario published(const std::string& name, const std::vector<std::string>& sets = {}) {
  return read_scenario(kPublished + name, sets, catalog());
}

TEST(Published, ExudynKinematicTree) {
  const Recording record = run(published("exudyn_kinematic_tree.yaml"));
  const Table table(record.trace);
  double sum = 0;
  for (int j = 0; j < 5; ++j) sum += table.at(record.trace.rows() - 1, fmt::format("joint.{}.angle", j));
  validate({"published.exudyn.kinematic_tree", "five bars on skew hinges, 1 s of falling, rk4 at 0.25 ms: sum of the angles",
            "EXUDYN 1.11.0, TestModels/kinematicTreeTest.py", "rad"},
           sum, -1.3093839514061, 1.1e-13,
           "13 decimals published (5e-14); order 4: RK4 at 5 ms is 8.8e-9 off (the model's other number), at 0.25 ms 20^4 "
           "times less");
}

/// Joint accelerations at the start, computed from the change of the speeds in one semi_implicit step of h = 2^-10 s.
std::vector<double> accelerations(const std::string& modules, const std::vector<double>& angles,
                                  const std::vector<double>& speeds, const std::string& gravity) {
  constexpr double kStep = 0.0009765625;
  const Recording record = run(scenario(fmt::format(R"(
gaitlab: 1
robot: {{base: fixed, position: [0, 0, 0], modules: "{}"}}
initial: {{angles: [{}], speeds: [{}]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
physics: {{integrator: semi_implicit, step: {}, gravity: {}}}
duration: {}
trace: {{period: {}, columns: [joint.*.speed]}}
)",
                                                    kPublished + modules, fmt::join(angles, ", "), fmt::join(speeds, ", "),
                                                    kStep, gravity, kStep, kStep)));
  std::vector<double> result;
  for (std::size_t c = 1; c < record.trace.columns.size(); ++c) {
    result.push_back((record.trace.at(1, c) - record.trace.at(0, c)) / kStep);
  }
  return result;
}

TEST(Published, RbdlAccelerations) {
  struct Case {
    std::string model;
    std::vector<double> angles, qdd;
  };
  const std::vector<Case> cases{
      {"single_chain", {0}, {-4.905}},
      {"spatial_inertia", {0}, {-2.3544}},
      {"double_chain", {0, 0}, {-5.88600000000000E+00, 3.92400000000000E+00}},
      {"triple_chain", {0, 0, 0}, {-6.03692307692308E+00, 3.77307692307692E+00, 1.50923076923077E+00}},
      {"double_chain_3d", {0, 0}, {-3.92400000000000E+00, 0}},
      {"simple_tree_3d",
       {0, 0, 0, 0, 0},
       {-1.60319066147860E+00, -5.34396887159533E-01, 4.10340466926070E+00, 2.67198443579767E-01, 5.30579766536965E+00}},
      {"three_dof", {1, 0, 0}, {3.301932144386186, 0, 0}},
  };
  for (const Case& one : cases) {
    // The test of RBDL numbers the joints depth-first. In gaitlab they are numbered breadth-first: a, b1, b2, c1, c2.
    std::vector<double> measured =
        accelerations("rbdl_" + one.model + ".yaml", one.angles, std::vector<double>(one.qdd.size(), 0.0), "[0, -9.81, 0]");
    if (one.model == "simple_tree_3d") std::swap(measured[2], measured[3]);
    ASSERT_EQ(measured.size(), one.qdd.size()) << one.model;
    for (std::size_t j = 0; j < measured.size(); ++j) {
      validate({"published.rbdl." + one.model, "joint accelerations from rest", "RBDL, tests/DynamicsTests.cc", "rad/s^2"},
               measured[j], one.qdd[j], 1e-13, "RBDL's own; 14 digits published");
    }
  }
}

TEST(Published, MotionGenesisBabyboot) {
  const Recording record = run(published("babyboot.yaml"));
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  const std::string source = "MotionGenesis 5.9 in Drake, benchmarks/chaotic_babyboot/MG/test";
  const std::string what = "Kane's unstable plate on a pendulum, 10 s, rk4 at 0.25 ms: ";
  const double degree = 180 / std::numbers::pi;
  const std::string reason = "spread of the published solutions (4 runs of 2 programs), the farthest from the first";
  validate({"published.babyboot.rod_angle", what + "angle of the rod", source, "deg"}, degree * table.at(last, "joint.0.angle"),
           -61.312983340691, 1.6e-6, reason);
  validate({"published.babyboot.plate_angle", what + "angle of the plate", source, "deg"},
           degree * table.at(last, "joint.1.angle"), -929.47789677244, 1.2e-5, reason);
  validate({"published.babyboot.rod_speed", what + "speed of the rod", source, "rad/s"}, table.at(last, "joint.0.speed"),
           -6.7440081040646, 2.5e-7, reason);
  validate({"published.babyboot.plate_speed", what + "speed of the plate", source, "rad/s"}, table.at(last, "joint.1.speed"),
           -2.7795690128833, 5.7e-6, reason);
  validate({"published.babyboot.energy", what + "energy", source, "J"},
           table.at(last, "energy.kinetic") + table.at(last, "energy.potential"), 0, 7e-13,
           "variation of energy in the published solutions");
}

TEST(Published, MotionGenesisBabybootAccelerations) {
  // Accelerations at the published final state. The file of the module type is the type of the scenario.
  const double degree = std::numbers::pi / 180;
  const std::vector<double> qdd = accelerations("babyboot_module.yaml", {-61.312983340691 * degree, -929.47789677244 * degree},
                                                {-6.7440081040646, -2.7795690128833}, "[0, 0, -9.81]");
  const std::string source = "MotionGenesis 5.9 in Drake, benchmarks/chaotic_babyboot/MG/test";
  const std::string what = "Kane's plate on a pendulum at MotionGenesis's end state: acceleration of the ";
  const std::string reason =
      "14 digits published of state and accelerations of 40 rad/s^2; differences of speeds over 1 ms: 1e-12";
  validate({"published.babyboot.rod_acceleration", what + "rod", source, "rad/s^2"}, qdd[0], 41.137023263571, 1e-11, reason);
  validate({"published.babyboot.plate_acceleration", what + "plate", source, "rad/s^2"}, qdd[1], 19.483647096003, 1e-11,
           reason);
}

TEST(Published, ChronoRevoluteAgainstAdams) {
  struct Sample {
    double t;
    Vec3 position, spin, force, moment;  // position and angular velocity of the body; reaction of the joint on the ground
  };
  // Samples of the 501 rows of each published file. Values of 1e-14 and less are 0.
  const std::array<std::vector<Sample>, 2> adams{{
      {{0.5, {1.660810, 0, -1.114320}, {0, 2.308810, 0}, {13.27970, 0, -9.149250}, {0, 0, 0}},
       {1, {-0.8923810, 0, -1.789880}, {0, 2.926140, 0}, {-11.46120, 0, -23.22730}, {0, 0, 0}},
       {2, {-1.951120, 0, -0.4394790}, {0, -1.449950, 0}, {-6.152950, 0, -1.625120}, {0, 0, 0}},
       {3, {1.869170, 0, -0.7114810}, {0, -1.844870, 0}, {9.542820, 0, -3.871560}, {0, 0, 0}},
       {4, {1.296960, 0, -1.522460}, {0, 2.698710, 0}, {14.16910, 0, -16.87180}, {0, 0, 0}},
       {5, {-1.999680, 0, -0.03555870}, {0, 0.4124360, 0}, {-0.5102250, 0, -0.2482590}, {0, 0, 0}}},
      {{0.5,
        {2.825910, 2.577080, 2.422920},
        {0, 1.174870, 1.174870},
        {7.560950, -2.394070, -7.412590},
        {-5.659270, 8.953040, -8.953040}},
       {1,
        {1.042100, 3.413900, 1.586100},
        {0, 1.838980, 1.838980},
        {0.4271640, 9.560810, -19.36730},
        {-13.86540, 0.2064460, -0.2064460}},
       {2,
        {-1.000000, 2.000630, 2.999370},
        {0, 0.03872270, 0.03872270},
        {-0.008990560, -4.783850, -5.023050},
        {-0.006147890, -9.806900, 9.806900}},
       {3,
        {0.8738000, 3.411400, 1.588600},
        {0, -1.837350, -1.837350},
        {-1.278100, 9.510780, -19.31710},
        {-13.84060, -0.6187770, 0.6187770}},
       {4,
        {3.000000, 2.002510, 2.997490},
        {0, -0.07744530, -0.07744530},
        {0.03602900, -4.783660, -5.022970},
        {-0.02459090, 9.806610, -9.806610}},
       {5,
        {1.209960, 3.406400, 1.593600},
        {0, 1.834100, 1.834100},
        {2.118950, 9.409770, -19.21640},
        {-13.79200, 1.029500, -1.029500}}},
  }};
  const std::string what = "pendulum of 4 m let go from the horizontal, at six times of 5 s: ";
  for (std::size_t i = 0; i < 2; ++i) {
    const Scenario pendulum = published(fmt::format("chrono_revolute_{}.yaml", i + 1));
    const Robot& robot = *pendulum.robot;
    const Recording record = run(pendulum);
    const Table table(record.trace);
    const std::string id = fmt::format("published.chrono_revolute.{}.", i + 1);
    const std::string source = fmt::format("ADAMS in Chrono, Revolute_Case0{}_ADAMS", i + 1);
    const auto worst = [](const Vec3& a, const Vec3& b) { return (a - b).cwiseAbs().maxCoeff(); };
    for (const Sample& sample : adams[i]) {
      RobotState state{pendulum.position, Quat(rpy(pendulum.orientation)),    Vec3::Zero(),
                       Vec3::Zero(),      {table(sample.t, "joint.0.angle")}, {table(sample.t, "joint.0.speed")}};
      Kinematics kinematics(robot);
      kinematics.update(robot, state);
      validate_below({id + "position", what + "COM", source, "m"},
                     worst(kinematics.point(1, robot.links[1].com), sample.position), 5e-6,
                     "six digits published of numbers from 1 to 10: half a unit of the last");
      validate_below({id + "spin", what + "angular velocity", source, "rad/s"}, worst(kinematics.omega[1], sample.spin), 5e-6,
                     "as the position");
      // Acceleration at which the torque of the joint is zero. The torque is a linear function of the acceleration.
      InverseDynamics dynamics(robot);
      Acceleration acceleration{Vec3::Zero(), Vec3::Zero(), {0}, {}};
      dynamics.update(kinematics, acceleration, pendulum.physics.gravity);
      const double held = dynamics.torques()[0];
      acceleration.joints[0] = 1;
      dynamics.update(kinematics, acceleration, pendulum.physics.gravity);
      acceleration.joints[0] = -held / (dynamics.torques()[0] - held);
      dynamics.update(kinematics, acceleration, pendulum.physics.gravity);
      validate_below(
          {id + "reaction_force", what + "force of the joint on the ground", source, "N"},
          worst(-dynamics.hinge(0).force, sample.force), 6e-4,
          "ADAMS's forces miss Newton's law at its own positions and spins by up to 5e-4, and half a unit of their sixth "
          "digit, 5e-5");
      validate_below({id + "reaction_moment", what + "moment of the joint on the ground", source, "N m"},
                     worst(-dynamics.hinge(0).moment, sample.moment), 5.2e-4,
                     "ADAMS's force along the axis misses the weight's share by 2.3e-4 N (case 2, t = 3 s), at an arm of 2 m: "
                     "4.7e-4; half a unit of the sixth digit, 5e-5");
    }
  }
}

}  // namespace
}  // namespace gaitlab::test
