// Tests of `contact.law: bullet`, which uses the world and the constraint solver of Bullet.
#include <cmath>
#include <limits>

#include "core/model/kinematics.h"
#include "tests/labels.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// Whole walks of bullet.
const Label kSolverWalks("Solver.Walks*", "long;unsanitized");

const std::vector<std::string> kSolver{"contact.law=bullet"};

/// Largest difference of any torque of two runs, relative to the largest torque.
double torques_apart(const Recording& a, const Recording& b) {
  double most = 0;
  double apart = 0;
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    const Series one = a.joint(j, "torque");
    const Series other = b.joint(j, "torque");
    for (std::size_t row = 0; row < one.size(); ++row) {
      most = std::max(most, std::abs(one[row]));
      apart = std::max(apart, std::abs(one[row] - other[row]));
    }
  }
  return apart / most;
}

// Without contacts and limits, the solver's equations of sixteen motors are the linear system of the implicit step, with
// matrices at a slightly different state.
TEST(Solver, MotorRowsAreTheImplicitStep) {
  const auto waved = [](const std::string& physics, const std::string& law) {
    return run(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, build: robots/caterpillar-8.dat, position: [0, 0, 1]}}
physics: {{{}, step: 1e-3, gravity: [0, 0, 0]}}
ground: {{type: none}}
contact: {{law: {}}}
actuator: {{i_max: 100}}
cpg: {{type: phase_oscillator, frequency: 0.5, amplitude: 0.3, phase_lag: 1.2}}
duration: 1
)",
                                    physics, law)));
  };
  const Recording a = waved("engine: articulated, integrator: implicit", "penalty");
  const Recording b = waved("engine: bullet", "bullet");
  EXPECT_LT(torques_apart(a, b), 1e-3) << "the matrices are those of the step's start there and of its end here: of the order "
                                          "of the step, 1e-3 s * 2 pi 0.5 Hz * 0.3 rad";
  EXPECT_NEAR(b.ledger.residual(), a.ledger.residual(), 1e-3 * a.ledger.copper) << "the same";
}

class SolverStep : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(At, SolverStep, testing::Values(2.5e-4, 1e-3, 2.5e-3));

TEST_P(SolverStep, DoesNotChatterAtTheCurrentLimit) {
  for (const std::string_view model : {"paper", "directional"}) {
    const Recording record = run(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, build: robots/caterpillar-8.dat, base: fixed, on_ground: false, position: [0, 0, 1]}}
ground: {{type: none}}
contact: {{law: bullet, on: none}}
physics: {{step: {}}}
actuator: {{i_max: 0.3, efficiency_model: {}}}
cpg: {{type: table, model: {{repeat: false, file: "t, m7/passive\n0, 0.3\n1, 0.3\n"}}}}
duration: 0.3
trace: {{period: {}, columns: [joint.*]}}
)",
                                                      GetParam(), model, GetParam())));
    const Table table(record.trace);
    double fastest = 0;
    int limited = 0;
    int flips = 0;
    double before = 0;
    for (std::size_t row = 1; row < record.trace.rows(); ++row) {
      fastest = std::max(fastest, std::abs(table.at(row, "joint.15.speed")));
      // A change of the current's sign counts as chatter only between two control ticks, where the command is constant.
      if (std::abs(std::remainder(table.at(row - 1, "t"), 0.015)) < 1e-9) before = 0;
      if (table.at(row, "joint.15.saturation") != 2) continue;
      ++limited;
      flips += table.at(row, "joint.15.current") * before < 0 ? 1 : 0;
      before = table.at(row, "joint.15.current");
    }
    EXPECT_LT(fastest, 1.02 * 7.4 / (0.00395 * 594)) << model << ": no-load speed";
    EXPECT_EQ(flips, 0) << model << " " << limited;
    EXPECT_NEAR(table.at(record.trace.rows() - 1, "joint.15.angle"), 0.3, 0.03) << model;
    const double most = 0.00395 * 0.3 * 594 * (model == "paper" ? 0.7 : 1 / 0.7);  // eta, or 1 / eta if driven backwards
    EXPECT_LE(record.joints[15].torque_peak, most * (1 + 1e-12)) << model;
  }
}

TEST(Solver, StopsAreTheSameSpringAsElsewhere) {
  const Recording record = run(scenario(R"(
gaitlab: 1
robot: {modules: mtran, base: fixed, position: [0, 0, 1]}
physics: {gravity: [0, 0, 0]}
contact: {law: bullet}
actuator: {type: torque}
controller: {type: hold, command: [0.5, -0.5]}
initial: {angles: [1.5, -1.5]}
duration: 2
)"));
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  const double excess = 0.5 / 50;  // T / ks
  EXPECT_NEAR(table.at(last, "joint.0.angle"), M_PI / 2 + excess, 1e-9) << "at rest: rounding, and e^(-200) of the start";
  EXPECT_NEAR(table.at(last, "joint.1.angle"), -M_PI / 2 - excess, 1e-9);
  EXPECT_NEAR(table.at(last, "joint.0.stop_torque"), -0.5, 1e-7) << "50 N m/rad times the above";
  EXPECT_NEAR(record.ledger.stops + record.ledger.stored, record.ledger.electrical, 0.02 * record.ledger.electrical)
      << "of the order of the step over the 10 ms of the impact";
}

/// Run of a module that slides at 0.5 m/s along its axis. `yaw` is the direction of the axis.
Recording sliding(double yaw) {
  return run(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, orientation: [0, 0, {}]}}
contact: {{law: bullet, on: all}}
ground: {{friction: 0.3}}
initial: {{base_velocity: [{}, {}, 0]}}
duration: 0.4
)",
                                  yaw, 0.5 * std::cos(yaw), 0.5 * std::sin(yaw))));
}

TEST(Solver, FrictionIsCoulombsWhicheverWay) {
  const double expected = 0.5 * 0.5 / (2 * 0.3 * 9.81);  // v^2 / (2 f g)
  for (const double yaw : {0.0, M_PI / 8, M_PI / 4}) {
    const Recording r = sliding(yaw);
    const double way = r.travel().head<2>().norm();
    EXPECT_NEAR(way, expected, 0.02 * expected)
        << yaw << ": v h / 2 is 0.6 % of it; a pyramid would be off by 30 % at 45 degrees";
    const double heat = 0.4 * 0.5 * 0.5 / 2;
    EXPECT_NEAR(r.ledger.friction, heat, 0.03 * heat) << "the kinetic energy, and what the motors add while it rocks";
  }
}

TEST(Solver, FeetCarryTheWeight) {
  const Scenario s = shipped("hexapod.yaml", {"contact.law=bullet", "cpg.amplitude=0", "duration=1"});
  const Recording record = run(s);
  const Table table(record.trace);
  double weight = 0;
  int touching = 0;
  for (std::size_t c = 0; c < 24; ++c) {
    const double fn = table.at(record.trace.rows() - 1, fmt::format("contact.{}.fn", c));
    weight += fn;
    touching += fn > 0 ? 1 : 0;
  }
  EXPECT_NEAR(weight, 4.4 * 9.81, 0.01 * 4.4 * 9.81) << "at rest but for what still settles";
  EXPECT_GE(touching, 6);
}

TEST(Solver, WalksAsThePenaltyLawDoes) {
  for (const auto& [name, within] : {std::pair("hexapod.yaml", 0.10), std::pair("caterpillar.yaml", 0.05)}) {
    const std::string file = name;
    const auto walk = [&](const std::vector<std::string>& sets) {
      std::vector<std::string> all{"duration=4"};
      all.insert(all.end(), sets.begin(), sets.end());
      const Recording r = run(shipped(file, all));
      return r.travel().x();
    };
    const double penalty = walk({"physics.engine=articulated"});
    const double solver = walk(kSolver);
    EXPECT_NEAR(solver, penalty, within * std::abs(penalty))
        << file << ": measured 3.3 % and 0.3 %; feet creep under the one law and stick under the other";
  }
}

/// Least distance between the hinge axes of blocks of different modules that are not docked to each other.
double closest(const Recording& record, const Scenario& s) {
  double least = std::numeric_limits<double>::infinity();
  Kinematics k(*s.robot);
  k.update(*s.robot, record.state(*s.robot, record.rows() - 1));
  for (const Body& a : s.robot->bodies) {
    for (const Body& b : s.robot->bodies) {
      if (!a.name.ends_with("/passive") || !b.name.ends_with("/passive") || a.module + 2 > b.module) continue;
      least = std::min(least, (k.point(a.link, a.in_link.p) - k.point(b.link, b.in_link.p)).norm());
    }
  }
  return least;
}

TEST(Solver, AChainFoldedOnItselfStops) {
  std::string names = "t";
  std::string zeros = "0";
  std::string ends;
  for (int m = 0; m < 8; ++m) {
    names += fmt::format(", m{0}/active, m{0}/passive", m);
    zeros += ", 0, 0";
    ends += ", 0.9, 0.9";
  }
  const auto folded = [&](const std::string& engine, const std::string& law) {
    return scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, build: robots/caterpillar-8.dat, position: [0, 0, 1]}}
physics: {{engine: {}, step: 5e-4, gravity: [0, 0, 0]}}
ground: {{type: none}}
contact: {{law: {}, on: all}}
cpg: {{type: table, model: {{repeat: false, file: "{}\n{}\n2{}\n3{}\n"}}}}
duration: 3
)",
                                engine, law, names, zeros, ends, ends));
  };
  const Scenario through = folded("articulated", "penalty");
  EXPECT_LT(closest(run(through), through), 0.05) << "the penalty law knows no blocks";
  const Scenario stops = folded("bullet", "bullet");
  EXPECT_GT(closest(run(stops), stops), 0.065 - 0.002) << "two half cylinders of 32.5 mm; a motor presses them 2 mm at most";
}

/// Scenario of a module that slides at 0.5 m/s along x towards boxes.
Scenario module_and_boxes(const std::string& friction, const std::string& x, const std::string& boxes) {
  return scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, position: [{}, 0, 0.0325]}}
contact: {{law: bullet, on: all}}
ground: {{type: boxes, friction: {}, boxes: [{}]}}
initial: {{base_velocity: [0.5, 0, 0]}}
duration: 0.4
trace: {{columns: [momentum.*, box.*, contact.*, com.*]}}
)",
                              x, friction, boxes));
}

TEST(Solver, ABoxThatIsDroppedComesToRest) {
  const Scenario s =
      module_and_boxes("0.5", "-5", "{center: [0, 0, 0.07], size: [0.2, 0.1, 0.1], rpy: [0, 0.1, 0.3], mass: 0.5}");
  Scenario longer = s;
  longer.duration = 1;
  const Recording record = run(longer);
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  EXPECT_NEAR(table.at(last, "box.0.z"), 0.05, 2e-4) << "half its height; Bullet lets bodies sink by what a step of weight is";
  const double tilt = std::hypot(table.at(last, "box.0.qx"), table.at(last, "box.0.qy"));
  EXPECT_LT(tilt, 2e-3) << "the same over half its length";
  for (const char* axis : {"vx", "vy", "vz"}) EXPECT_NEAR(table.at(last, std::string("box.0.") + axis), 0, 1e-3) << axis;
}

TEST(Solver, ARobotPushesABox) {
  // Module and box have 0.4 kg each. Without friction the momentum is constant, and the box is faster after the impact.
  Scenario s = module_and_boxes("0", "-0.2", "{center: [0, 0, 0.05], size: [0.1, 0.1, 0.1], mass: 0.4}");
  s.trace.period = 1e-3;  // a row per step, because the impact lasts one step
  const Recording record = run(s);
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  const double box = 0.4 * table.at(last, "box.0.vx");
  const double robot = table.at(last, "momentum.x");
  EXPECT_NEAR(table.at(0, "momentum.x"), 0.2, 1e-12);
  EXPECT_NEAR(box + robot, 0.2, 1e-3 * 0.2) << "what the solver leaves of 200 N m/s^2: 50 impulses each";
  EXPECT_GE(box, robot - 1e-3);
  EXPECT_GT(table.at(last, "box.0.x"), 0.01);
  double pushed = 0;  // force on the contact elements of the pushing face
  for (std::size_t row = 0; row < record.trace.rows(); ++row) {
    for (std::size_t c = 0; c < 12; ++c) pushed = std::min(pushed, table.at(row, fmt::format("contact.{}.fx", c)));
  }
  EXPECT_LT(pushed, -1);
}

TEST(Solver, ABoxSlidesDownARampByCoulomb) {
  const double slope = M_PI / 6;
  const std::string ramp = fmt::format("{{center: [0, 0, -0.5], size: [4, 1, 0.2], rpy: [0, {}, 0], friction: 0.6}}", slope);
  // The box is so high on the ramp that it does not touch the plane.
  const double up = 1.5;
  const std::string box =
      fmt::format("{{center: [{}, 0, {}], size: [0.2, 0.2, 0.1], rpy: [0, {}, 0], friction: 0.3, mass: 1}}",
                  0.15 * std::sin(slope) - up * std::cos(slope), -0.5 + 0.15 * std::cos(slope) + up * std::sin(slope), slope);
  const Recording record = run(module_and_boxes("0.5", "-5", ramp + ", " + box));
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  const double way =
      std::hypot(table.at(last, "box.1.x") - table.at(0, "box.1.x"), table.at(last, "box.1.z") - table.at(0, "box.1.z"));
  const double expected = 9.81 * (std::sin(slope) - 0.3 * std::cos(slope)) * 0.4 * 0.4 / 2;
  EXPECT_NEAR(way, expected, 0.01 * expected) << "one step's h / t is 0.25 %; of the two frictions the smaller";
}

TEST(Solver, SameBitsTwice) {
  const Scenario s = shipped("caterpillar.yaml", {"contact.law=bullet", "duration=1"});
  EXPECT_EQ(run(s).trace.values, run(s).trace.values);
  const Scenario boxes = module_and_boxes("0.4", "-0.2", "{center: [0, 0, 0.05], size: [0.1, 0.1, 0.1], mass: 0.2}");
  EXPECT_EQ(run(boxes).trace.values, run(boxes).trace.values);
}

TEST(Solver, RefusesWhatItCannotDo) {
  const auto reading = [](std::vector<std::string> sets) {
    sets.emplace_back("contact.law=bullet");
    return message_of([&] { shipped("hexapod.yaml", sets); });
  };
  EXPECT_EQ(shipped("hexapod.yaml", kSolver).physics.step, 1e-3);
  EXPECT_EQ(shipped("hexapod.yaml", {"contact.law=bullet", "physics.step=5e-4"}).physics.step, 5e-4);
  EXPECT_NE(reading({"physics.engine=articulated"})
                .find("engine 'articulated' has no contact law 'bullet'; expected penalty, or engine: bullet"),
            std::string::npos);
  EXPECT_NE(reading({"physics.integrator=rk4"}).find("works only with integrator semi_implicit"), std::string::npos);
  EXPECT_NE(reading({"actuator.rotor_inertia=1e-8"}).find("cannot add rotor inertia"), std::string::npos);
  EXPECT_NE(
      reading({"ground.type=heightfield", "ground.heightfield.values=[[0, 0], [0, 0]]"}).find("does not support a heightfield"),
      std::string::npos);
  EXPECT_NE(reading({"contact.stiffness=1e5"}).find("unknown key 'stiffness'"), std::string::npos);
  const Scenario reactions = shipped("hexapod.yaml", {"contact.law=bullet", "trace.columns=[reaction.*]"});
  EXPECT_NE(message_of([&] { Simulation({&reactions, 1}); }).find("remove the columns reaction.*"), std::string::npos);
  const Scenario s = shipped("hexapod.yaml", kSolver);
  Simulation simulation({&s, 1});
  EXPECT_NE(message_of([&] { static_cast<void>(simulation.state()); }).find("allows no snapshot"), std::string::npos);
}

TEST(Solver, HasNoGoldens) {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  folder.write("one.yaml", "gaitlab: 1\nrobot: {modules: mtran}\ncontact: {law: bullet}\nduration: 0.1\n");
  const Result result = gaitlab("approve one.yaml --reason because", folder / "");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("one.yaml:3:16: error: contact.law: bullet has no goldens"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "one.golden"));
}

}  // namespace
}  // namespace gaitlab::test
