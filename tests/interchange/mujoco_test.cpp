// The exported MJCF in MuJoCo, an independent program, has the mass matrix, bias and passive motion of gaitlab.
#include "core/dynamics/mass_matrix.h"
#include "core/plugin/plugin_instance.h"
#include "core/plugin/robot_info.h"
#include "core/simulation/start.h"
#include "tests/interchange/in_mujoco.h"
#include "tests/labels.h"
#include "tests/program/random_scenario.h"
#include "tests/validation.h"

namespace gaitlab::test {

using namespace interchange;

namespace {

const Label kLongMujoco("Mujoco.MovesTheSameWithoutMotorsAndContacts", "long");

constexpr std::array<Base, 3> kBases{Base::floating, Base::fixed, Base::planar};

/// Largest difference of two mass matrices, with each entry relative to its bound sqrt(M_ii M_jj).
double apart(const Eigen::MatrixXd& theirs, const Eigen::MatrixXd& ours) {
  const Eigen::VectorXd root = ours.diagonal().cwiseSqrt();
  return (theirs - ours).cwiseQuotient(root * root.transpose()).cwiseAbs().maxCoeff();
}

TEST(Mujoco, HasOurMassMatrixAndBiasAtRandomStatesOfRandomAssemblies) {
  RandomRobots random(21);
  double mass_error = 0;
  double bias_error = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    const Base base = kBases[i % 3];
    Scenario s = random_scenario(random, base);
    if (i % 2 == 1) add_motors(random, s);
    InMujoco mujoco(s);
    ASSERT_EQ(mujoco.model().nv, s.robot->dof(base));
    RobotState state = random.state(*s.robot, base);
    const double x = random.uniform(-1, 1);
    const double z = random.uniform(-1, 1);
    const double turned = random.uniform(-3, 3);
    const RobotState start = start_state(s);
    if (base != Base::floating) state.orientation = start.orientation;
    if (base == Base::planar) state.orientation = turn(Vec3::UnitY(), turned) * start.orientation;
    mujoco.set(state, x, z, turned);

    Kinematics k(*s.robot);
    k.update(*s.robot, state);
    MassMatrix mass(*s.robot, base);
    mass.update(k);
    InverseDynamics dynamics(*s.robot);
    Acceleration none;
    none.joints.assign(state.q.size(), 0.0);
    dynamics.update(k, none, s.physics.gravity);
    const Eigen::VectorXd bias = generalised_force(dynamics, base);
    const Eigen::MatrixXd T = mujoco.from_ours(state);
    const Eigen::MatrixXd theirs = T.transpose() * mujoco.mass() * T;
    Eigen::MatrixXd ours = mass.matrix();
    if (const auto* motors = static_cast<const actuators::DcMotorActuator::Settings*>(s.actuator.settings.get())) {
      const auto first = ours.rows() - static_cast<Eigen::Index>(state.q.size());
      for (std::size_t j = 0; j < state.q.size(); ++j) {
        ours.diagonal()[first + static_cast<Eigen::Index>(j)] += motors->gear[j] * motors->gear[j] * motors->rotor_inertia[j];
      }
    }
    mass_error = std::max(mass_error, apart(theirs, ours));
    // Differences of the entries of M a are relative to their bounds, |(M a)_i| <= sqrt(M_ii a.M a).
    const double size = std::sqrt(bias.dot(ours.llt().solve(bias)));
    const Eigen::VectorXd difference = T.transpose() * mujoco.bias() - bias;
    bias_error = std::max(bias_error, difference.cwiseQuotient(ours.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff() / size);
  }
  const std::string reason = "required by the issue; rounding of 1e-16, of sums up to 1e4 times the entry";
  validate_below(
      {"format.mujoco-mass-matrix", "M of the exported MJCF, every entry over sqrt(M_ii M_jj), 100 random assemblies",
       "MuJoCo 2.2.2, composite rigid bodies", ""},
      mass_error, 1e-9, reason);
  validate_below({"format.mujoco-bias", "bias c of the exported MJCF, every entry over sqrt(M_ii c M^-1 c), 100 random states",
                  "MuJoCo 2.2.2, recursive Newton-Euler", ""},
                 bias_error, 1e-9, reason);
}

/// Mass matrix of gaitlab at a state, without rotors.
Eigen::MatrixXd mass_at(const Scenario& s, const RobotState& state) {
  Kinematics k(*s.robot);
  k.update(*s.robot, state);
  MassMatrix mass(*s.robot, s.base);
  mass.update(k);
  return mass.matrix();
}

TEST(Mujoco, HasOurMassMatrixWithRotors) {
  const Scenario s = shipped("caterpillar.yaml", {"actuator.rotor_inertia=1e-8"});
  InMujoco mujoco(s);
  const RobotState start = start_state(s);
  mujoco.set(start, 0, 0, 0);
  Eigen::MatrixXd ours = mass_at(s, start);
  ours.diagonal().tail(static_cast<Eigen::Index>(s.robot->joints.size())).array() += 594 * 594 * 1e-8;  // n^2 J
  const Eigen::MatrixXd T = mujoco.from_ours(start);
  validate_below(
      {"format.mujoco-rotors",
       "M of the caterpillar's MJCF with rotors of 1e-8 kg m^2 behind gears of 594, every entry over sqrt(M_ii M_jj)",
       "MuJoCo 2.2.2: armature", ""},
      apart(T.transpose() * mujoco.mass() * T, ours), 1e-9, "required by the issue, as without rotors");
}

/// The mass matrices of all scenarios of the library agree. Their modules have faces with or without gender, hinges without
/// stops, different motors, and rotors.
TEST(Mujoco, HasOurMassMatrixOfTheWholeLibrary) {
  RandomRobots random(23);
  double worst = 0;
  int robots = 0;
  for (const Scenario& s : shipped_library()) {
    InMujoco mujoco(s);
    ASSERT_EQ(mujoco.model().nv, s.robot->dof(s.base)) << s.name;
    const RobotState state = random.state(*s.robot, s.base);
    mujoco.set(state, 0, 0, 0);
    Eigen::MatrixXd ours = mass_at(s, state);
    const std::unique_ptr<Actuator> actuator = make_actuator(s.actuator, info(*s.robot));
    const In rotors = actuator == nullptr ? In() : actuator->reflected_inertia();
    const auto first = ours.rows() - static_cast<Eigen::Index>(state.q.size());
    for (std::size_t j = 0; j < rotors.size(); ++j) ours.diagonal()[first + static_cast<Eigen::Index>(j)] += rotors[j];
    const Eigen::MatrixXd T = mujoco.from_ours(state);
    worst = std::max(worst, apart(T.transpose() * mujoco.mass() * T, ours));
    for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
      EXPECT_EQ(mujoco.model().jnt_limited[mujoco.id(s.robot->joints[j].name)] != 0, !s.robot->joints[j].turns_freely())
          << s.name;
    }
    ++robots;
  }
  EXPECT_GE(robots, 13);
  validate_below(
      {"format.mujoco-library", "M of the exported MJCF of every robot of the library, every entry over sqrt(M_ii M_jj)",
       "MuJoCo 2.2.2, composite rigid bodies", ""},
      worst, 1e-10, "required by the issue; rounding of 1e-16, of sums up to 1e4 times the entry");
}

TEST(Mujoco, MovesTheSameWithoutMotorsAndContacts) {
  RandomRobots random(22);
  double worst = 0;
  for (std::size_t i = 0; i < 18; ++i) {
    const Base base = kBases[i % 3];
    Scenario s = random_scenario(random, base);
    s.physics.integrator = s.physics.engine->integrator("rk4");
    s.physics.step = std::array{2.5e-4, 2e-4, 1.25e-4, 1e-4}[random.below(4)];
    s.duration = 0.2;
    s.trace.period = s.control_period = s.cpg_step = 0.2;
    const Recording record = run(s);
    InMujoco mujoco(s);
    for (std::int64_t step = 0; step < std::llround(s.duration / s.physics.step); ++step)
      mj_step(&mujoco.model(), &mujoco.data());
    const std::size_t joints = s.robot->joints.size();
    for (std::size_t j = 0; j < joints; ++j) {
      worst = std::max(worst, std::abs(record.joint(j, "angle")[1] - mujoco.q(j)));
    }
    const RobotState end = record.state(*s.robot, 1);
    const double* q = mujoco.data().qpos;
    if (base == Base::floating) {
      worst = std::max({worst, (end.position - Vec3(q[0], q[1], q[2])).norm(),
                        end.orientation.angularDistance(Quat(q[3], q[4], q[5], q[6]))});
    }
    if (base == Base::planar) {
      const RobotState start = start_state(s);
      worst = std::max({worst, (end.position - start.position - Vec3(q[0], 0, q[1])).norm(),
                        end.orientation.angularDistance(turn(Vec3::UnitY(), q[2]) * start.orientation)});
    }
  }
  validate_below({"format.mujoco-motion", "angles, pose after 0.2 s of passive motion, rk4, 18 random assemblies",
                  "MuJoCo 2.2.2, RK4 at the same step", "rad, m"},
                 worst, 1e-6, "required by the issue; both of order 4: (2.5e-4 s, the longest, * 100 rad/s)^4 is 4e-7");
}

/// Sensors measure in MuJoCo what they measure here: the angle and speed of a joint, R^T w and, in free fall without rotation,
/// no specific force.
TEST(Mujoco, HasTheSensors) {
  const Scenario s =
      shipped("caterpillar.yaml", {"initial.angles=0.2", "initial.speeds=0.3",
                                   "sensors={e: {type: encoder, joints: m2/active}, head: {type: imu, body: "
                                   "m3/passive, position: [0.01, 0.02, 0]}, d: {type: motor, joints: m1/active}}"});
  InMujoco robot(s);
  RobotState state = start_state(s);
  state.orientation = Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  state.angular_velocity = Vec3(0.4, -0.2, 0.9);
  const auto sensed = [&](const char* name) {
    const int id = mj_name2id(&robot.model(), mjOBJ_SENSOR, name);
    if (id < 0) throw std::runtime_error(name);
    const mjtNum* at = robot.data().sensordata + robot.model().sensor_adr[id];
    return std::vector<double>(at, at + robot.model().sensor_dim[id]);
  };
  std::fill(state.qd.begin(), state.qd.end(), 0.0);
  state.qd[4] = 0.3;
  robot.set(state, 0, 0, 0);
  EXPECT_EQ(sensed("e.m2/active"), std::vector{0.2});
  EXPECT_EQ(sensed("e.m2/active.speed"), std::vector{0.3});
  EXPECT_EQ(sensed("d.m1/active.torque"), std::vector{0.0});
  Kinematics kinematics(*s.robot);
  kinematics.update(*s.robot, state);
  const auto& bodies = s.robot->bodies;
  const auto body = std::ranges::find(bodies, "m3/passive", &Body::name);
  ASSERT_NE(body, bodies.end());
  const Vec3 w = (kinematics.R[body->link] * body->in_link.R).transpose() * kinematics.omega[body->link];
  const std::vector<double> gyro = sensed("head.gyro");
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(gyro[static_cast<std::size_t>(i)], w[i], 1e-12);
  state.angular_velocity.setZero();
  state.qd[4] = 0;
  robot.set(state, 0, 0, 0);
  for (const double a : sensed("head.accelerometer")) EXPECT_NEAR(a, 0, 1e-9);  // the joints hold nothing: all parts fall alike
}

/// The exported file uses RK4 for all integrators of gaitlab and names the integrator of the scenario.
TEST(Mujoco, NamesTheIntegratorOfEitherEngine) {
  const auto exported = [](const std::vector<std::string>& more) {
    std::vector<std::string> sets{"physics.engine=articulated"};
    sets.insert(sets.end(), more.begin(), more.end());
    return to_mjcf(shipped("hexapod.yaml", sets), MjcfModel::strict);
  };
  const auto expect = [](const std::string& text, const std::string& step, const std::string& sentence) {
    EXPECT_TRUE(text.find("timestep=\"" + step + "\"") != std::string::npos) << step;
    EXPECT_TRUE(text.find(sentence) != std::string::npos) << sentence;
  };
  expect(exported({}), "0.0005", " Integrator: adaptive, accuracy 0.01; this file uses RK4 at 0.0005 s, of order 4.");
  expect(exported({"physics.step=1e-3"}), "0.001",
         " Integrator: implicit, of order 1; this file uses RK4 at the same step, of order 4.");
  expect(exported({"physics.step=1e-3", "physics.integrator=extrapolated"}), "0.001",
         " Integrator: extrapolated, of order 2; this file uses RK4 at the same step, of order 4.");
  const std::string rk4 = exported({"physics.step=2e-5", "physics.integrator=rk4"});
  EXPECT_EQ(rk4.find("Integrator:"), std::string::npos);
}

/// The exported hexapod is complete: names, contact elements, motors, start state.
TEST(Mujoco, HoldsTheHexapodWithItsNames) {
  const Scenario s = shipped("hexapod.yaml", {"physics.step=2.5e-5"});
  InMujoco mujoco(s);
  const mjModel& m = mujoco.model();
  EXPECT_EQ(m.nbody, 1 + 33);
  EXPECT_EQ(m.nv, 28);
  EXPECT_EQ(m.nu, 22);
  EXPECT_EQ(m.nsite, 24);  // six feet with four points each
  EXPECT_DOUBLE_EQ(m.opt.timestep, s.physics.step);
  EXPECT_NE(to_mjcf(s, MjcfModel::strict)
                .find("Integrator: semi_implicit, of order 1; this file uses RK4 at the same step, of order 4."),
            std::string::npos);
  EXPECT_EQ(m.opt.integrator, mjINT_RK4);
  for (int g = 0; g < m.ngeom; ++g) EXPECT_EQ(m.geom_contype[g] + m.geom_conaffinity[g], 0);
  mj_forward(&m, &mujoco.data());
  Kinematics k(*s.robot);
  k.update(*s.robot, start_state(s));
  for (const Body& body : s.robot->bodies) {
    const int id = mj_name2id(&m, mjOBJ_BODY, body.name.c_str());
    ASSERT_GE(id, 0) << body.name;
    // The tolerance is for the rounding errors of ten rotations and sums of numbers below 1.
    EXPECT_LT((Eigen::Map<const Vec3>(mujoco.data().xpos + std::ptrdiff_t{3} * id) - k.point(body.link, body.in_link.p)).norm(),
              1e-14);
  }
  // At the start, the lowest point of a contact element is on the ground.
  EXPECT_NEAR(mujoco.data().site_xpos[2], 0, 1e-14);
  EXPECT_DOUBLE_EQ(m.actuator_ctrlrange[1], 0.7 * 0.00395 * 594 * 1.2);  // eta Kt n i_max
}

/// The strict file keeps its bytes, because exact comparisons rest on it.
TEST(Mujoco, StrictFileIsTheRobotWithoutContactsAndControllers) {
  EXPECT_EQ(to_mjcf(shipped("pendulum.yaml"), MjcfModel::strict), R"(<mujoco model="pendulum">
    <!-- Written by gaitlab. Not in this file, because MJCF does not hold it: Hinge stops: a spring of 50 N m/rad and a damper of 0.5 N m s/rad outside the range. Geoms touch nothing: those of group 3 are the contact elements (points are drawn as spheres of 0.001 m), each with a site. -->
    <compiler angle="radian" inertiafromgeom="false"/>
    <option timestep="0.0001" gravity="0 0 -9.81" integrator="RK4"/>
    <default>
        <geom contype="0" conaffinity="0" group="1"/>
    </default>
    <worldbody>
        <body name="m0/pivot" pos="0 0 1.2" quat="1 0 0 0">
            <inertial pos="0 0 0" mass="1" quat="1 0 0 0" diaginertia="0.001 0.001 0.001"/>
            <geom type="box" size="0.025 0.025 0.025" pos="0 0 0" quat="1 0 0 0"/>
            <body name="m0/rod" pos="0 0 0" quat="1 0 0 0">
                <joint name="m0/hinge" type="hinge" pos="0 0 0" axis="0 1 0" limited="true" range="-3.2 3.2"/>
                <inertial pos="0 0 -0.5" mass="1" quat="1 0 0 0" diaginertia="0.08333333333333333 0.08333333333333333 1e-06"/>
                <geom type="box" size="0.01 0.01 0.5" pos="0 0 -0.5" quat="1 0 0 0"/>
            </body>
        </body>
    </worldbody>
    <keyframe>
        <key name="start" qpos="1" qvel="0"/>
    </keyframe>
</mujoco>
)");
}

/// A hull is a mesh whose vertices MuJoCo moves to the mesh's own axes: in the world they are at our corners. MuJoCo has them
/// as float, 6e-8 of 0.3 m.
TEST(Mujoco, HasTheCornersOfHulls) {
  const Scenario s = scenario(
      "robot: {modules: {name: rock, bodies: {a: {mass: 1, inertia: [1, 1, 1, 0, 0, 0], shape: [{hull: [[0.3, 0, 0], [0, 0.2, "
      "0], [0, 0, 0.1], [-0.1, -0.1, -0.1], [0.2, 0.2, 0]], origin: [0.1, 0.2, 0.3], rpy: [0.3, 0.4, 0.5]}]}}}, position: [1, "
      "2, 3]}\ncontact: {on: none}\nduration: 1\n");
  InMujoco mujoco(s);
  mj_forward(&mujoco.model(), &mujoco.data());
  const mjModel& model = mujoco.model();
  ASSERT_EQ(model.nmesh, 1);
  const auto geom = std::find(model.geom_type, model.geom_type + model.ngeom, mjGEOM_MESH) - model.geom_type;
  ASSERT_LT(geom, model.ngeom);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(mujoco.data().geom_xmat + 9 * geom);
  const Eigen::Map<const Vec3> p(mujoco.data().geom_xpos + 3 * geom);
  const Shape& shape = s.robot->types[0].bodies[0].shapes[0];
  const RobotState start = start_state(s);
  ASSERT_EQ(shape.hull->corners.size(), 5U);
  for (const Vec3& corner : shape.hull->corners) {
    const Vec3 ours = start.orientation * (shape.in_body * corner) + start.position;
    double nearest = 1;
    for (int v = 0; v < model.mesh_vertnum[0]; ++v) {
      const Eigen::Map<const Eigen::Vector3f> vertex(model.mesh_vert + 3 * static_cast<std::ptrdiff_t>(v));
      nearest = std::min(nearest, (R * vertex.cast<double>() + p - ours).norm());
    }
    EXPECT_LT(nearest, 1e-7);
  }
}

}  // namespace
}  // namespace gaitlab::test
