// Numbers that others have published for models of their own: tests/published/*.yaml say where each stands.
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "fixture.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

const std::string kPublished = std::string(GAITLAB_SOURCE_DIR) + "/tests/published/";

Scenario published(const std::string& name, const std::vector<std::string>& sets = {}) {
  return read_scenario(kPublished + name, sets, catalog());
}

TEST(Published, ExudynKinematicTree) {
  const RunRecord record = run(published("exudyn_kinematic_tree.yaml"));
  const Table table(record.trace);
  double sum = 0;
  for (int j = 0; j < 5; ++j) sum += table.at(record.trace.rows() - 1, fmt::format("joint.{}.angle", j));
  validate({"published.exudyn.kinematic_tree", "five bars on skew hinges, 1 s of falling, rk4 at 0.25 ms: sum of the angles",
            "EXUDYN 1.11.0, TestModels/kinematicTreeTest.py", "rad"},
           sum, -1.3093839514061, 1.1e-13,
           "13 decimals published (5e-14); order 4: RK4 at 5 ms is 8.8e-9 off (the model's other number), at 0.25 ms 20^4 "
           "times less");
}

/// Joint accelerations at the start: one semi_implicit step adds h times them to the speeds, h = 2^-10 s exactly.
std::vector<double> accelerations(const std::string& modules, const std::vector<double>& angles,
                                  const std::vector<double>& speeds, const std::string& gravity) {
  constexpr double kStep = 0.0009765625;
  const RunRecord record = run(scenario(fmt::format(R"(
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
    // RBDL numbers a tree depth-first, as its test adds the bodies; joints here go breadth-first: a, b1, b2, c1, c2.
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
  const RunRecord record = run(published("babyboot.yaml"));
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
  // At the published end state; the module type is the scenario's, in a file of its own.
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
    Vec3 position, spin;
  };
  // Of the files' 501 rows each.
  const std::array<std::vector<Sample>, 2> adams{{
      {{0.5, {1.660810E+00, 0, -1.114320E+00}, {0, 2.308810E+00, 0}},
       {1, {-8.923810E-01, 0, -1.789880E+00}, {0, 2.926140E+00, 0}},
       {2, {-1.951120E+00, 0, -4.394790E-01}, {0, -1.449950E+00, 0}},
       {3, {1.869170E+00, 0, -7.114810E-01}, {0, -1.844870E+00, 0}},
       {4, {1.296960E+00, 0, -1.522460E+00}, {0, 2.698710E+00, 0}},
       {5, {-1.999680E+00, 0, -3.555870E-02}, {0, 4.124360E-01, 0}}},
      {{0.5, {2.825910E+00, 2.577080E+00, 2.422920E+00}, {0, 1.174870E+00, 1.174870E+00}},
       {1, {1.042100E+00, 3.413900E+00, 1.586100E+00}, {0, 1.838980E+00, 1.838980E+00}},
       {2, {-1.000000E+00, 2.000630E+00, 2.999370E+00}, {0, 3.872270E-02, 3.872270E-02}},
       {3, {8.738000E-01, 3.411400E+00, 1.588600E+00}, {0, -1.837350E+00, -1.837350E+00}},
       {4, {3.000000E+00, 2.002510E+00, 2.997490E+00}, {0, -7.744530E-02, -7.744530E-02}},
       {5, {1.209960E+00, 3.406400E+00, 1.593600E+00}, {0, 1.834100E+00, 1.834100E+00}}},
  }};
  for (std::size_t i = 0; i < 2; ++i) {
    const RunRecord record = run(published(fmt::format("chrono_revolute_{}.yaml", i + 1)));
    const Table table(record.trace);
    const std::string id = fmt::format("published.chrono_revolute.{}.", i + 1);
    const std::string source = fmt::format("ADAMS in Chrono, Revolute_Case0{}_ADAMS", i + 1);
    for (const Sample& sample : adams[i]) {
      const auto at = [&](const std::string& name) { return table(sample.t, "body.m0/pendulum." + name); };
      const Quat turn(at("qw"), at("qx"), at("qy"), at("qz"));
      const Vec3 com = Vec3(at("x"), at("y"), at("z")) + turn * Vec3(2, 0, 0);
      const Vec3 spin = turn * Vec3(0, 0, table(sample.t, "joint.0.speed"));
      validate_below({id + "position", "pendulum of 4 m from the horizontal, 5 s: COM at six times", source, "m"},
                     (com - sample.position).cwiseAbs().maxCoeff(), 6e-6,
                     "six digits published, half a unit of the last is 5e-6; the rest ADAMS's own error");
      validate_below({id + "spin", "pendulum of 4 m from the horizontal, 5 s: angular velocity at six times", source, "rad/s"},
                     (spin - sample.spin).cwiseAbs().maxCoeff(), 6e-6, "as the position");
    }
  }
}

}  // namespace
}  // namespace gaitlab::test
