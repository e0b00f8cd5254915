// Drawn robots of 2 to 4 joints with friction, gears, limits, stops and contacts, in both engines against an integrator of
// their own: steps of 1 us with the set-valued law of friction (tests/oracles/sticking_robot.h).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/labels.h"
#include "tests/oracles/sticking_robot.h"
#include "tests/program/engines.h"
#include "tests/program/rod.h"
#include "tests/random_robots.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

// 0.5 million steps for each of eight robots.
const Label kDrawnFriction("Of/DrawnFriction.*", "long;unsanitized");

constexpr double kStep = 1e-6;  // s; with half of it no error below changes by 1e-3 %
constexpr double kRow = 5e-3;   // s
constexpr double kTime = 0.5;   // s
constexpr double kLate = 1e-3;  // s, see distance()
constexpr double kGear = 300;   // of dc_motor
constexpr double kVolts = 6;    // of the data sheets of servos

/// A robot, its scenario as text and, for the oracle, the numbers of its drives and of its loop.
struct Drawn {
  std::string text;
  std::vector<oracle::Drive> drives;
  double gain = 0, period = 0, frequency = 0, amplitude = 0;  ///< V/rad, s, Hz, rad

  [[nodiscard]] double setpoint(std::size_t joint, double t) const {
    return amplitude * std::sin(2 * std::numbers::pi * frequency * t + static_cast<double>(joint));
  }
};

/// Uniform box of 2 to 5 cm by 2 to 5 cm by `length`, m, whose long axis x begins at the hinge.
std::string drawn_body(RandomRobots& random, std::size_t number, double length) {
  const double mass = random.uniform(0.05, 0.3);
  const double a = random.uniform(0.02, 0.05);
  const double b = random.uniform(0.02, 0.05);
  return fmt::format("      b{}: {{mass: {}, com: [{}, 0, 0], inertia: [{}, {}, {}, 0, 0, 0]}}\n", number, mass, length / 2,
                     mass / 12 * (a * a + b * b), mass / 12 * (length * length + b * b), mass / 12 * (length * length + a * a));
}

/// Drawn motors, as values of the keys of a servo or of a dc_motor with a directional gear, and as drives of the oracle.
struct Motors {
  std::vector<std::vector<double>> columns = std::vector<std::vector<double>>(8);
  std::vector<oracle::Drive> drives;

  void add(RandomRobots& random, bool servo, bool limited) {
    oracle::Drive d;
    const double stall = random.scaled(0.3, 1.5);
    const double speed = random.uniform(4, 9);
    const double constant = kVolts / speed;                         // of motor and gear, N m/A
    const double current = stall / ((servo ? 0.7 : 1) * constant);  // A, at stall; 0.7: the efficiency of a servo's currents
    const double share = limited ? random.uniform(0.3, 0.6) : 1;
    const double lost = servo ? random.uniform(0, 0.3) : random.uniform(0.5, 0.9);
    d.per_volt = stall / kVolts;
    d.per_speed = stall / speed;
    d.largest = share * stall;
    d.eta = servo ? (1 - lost) / (1 + lost) : lost;
    d.supply = random.uniform(4, 8);
    d.dry = stall * random.uniform(0.02, 0.1);
    d.viscous = stall / speed * random.uniform(0, 0.2);
    d.rotor = stall / speed * random.uniform(0.003, 0.03);
    drives.push_back(d);
    const std::array keys{servo ? stall : constant / kGear,
                          servo ? speed : kVolts / current,
                          lost,
                          share * current,
                          d.supply,
                          d.dry,
                          d.viscous,
                          servo ? d.rotor : d.rotor / (kGear * kGear)};
    for (std::size_t i = 0; i < keys.size(); ++i) columns[i].push_back(keys[i]);
  }

  [[nodiscard]] std::string text(bool servo) const {
    const auto list = [&](std::size_t column) { return fmt::format("[{}]", fmt::join(columns[column], ", ")); };
    return (servo ? fmt::format("{{type: servo, voltage: {}, stall_torque: {}, no_load_speed: {}, load_friction: {}", kVolts,
                                list(0), list(1), list(2))
                  : fmt::format("{{type: dc_motor, gear: {0}, Kt: {1}, Ks: {1}, R: {2}, efficiency: {3}, efficiency_model: "
                                "directional",
                                kGear, list(0), list(1), list(2))) +
           fmt::format(", i_max: {}, u_max: {}, dry_friction: {}, viscous_friction: {}, rotor_inertia: {}}}", list(3), list(4),
                       list(5), list(6), list(7));
  }
};

Drawn drawn(std::uint32_t seed) {
  RandomRobots random(seed);
  Drawn robot;
  const std::array bases{"floating", "fixed", "floating", "planar"};
  const char* base = bases[seed % 4];
  const std::size_t joints = 2 + random.below(3);
  std::vector<double> lengths{random.uniform(0.05, 0.12)};
  std::string bodies = drawn_body(random, 0, lengths[0]);
  std::string hinges;
  std::string elements = fmt::format("        - {{body: b0, sphere: [0, 0, 0], radius: {}}}\n", random.uniform(0.01, 0.03));
  for (std::size_t j = 0; j < joints; ++j) {
    const std::size_t parent = random.below(j + 1);
    lengths.push_back(random.uniform(0.05, 0.12));
    bodies += drawn_body(random, j + 1, lengths.back());
    const Vec3 axis = seed % 4 == 3 ? Vec3::UnitY() : random.direction();
    const double lo = random.uniform(0.1, 0.8);
    const double hi = random.uniform(0.1, 0.8);
    const double turned = random.uniform(-1, 1);
    hinges += fmt::format(
        "      - {{name: h{0}, parent: b{1}, child: b{2}, origin: [{3}, 0, 0], rpy: [0, {4}, 0], axis: [{5}, {6}, {7}], "
        "range: [{8}, {9}]}}\n",
        j, parent, j + 1, lengths[parent], turned, axis.x(), axis.y(), axis.z(), -lo, hi);
    elements += fmt::format("        - {{body: b{}, sphere: [{}, 0, 0], radius: {}}}\n", j + 1, lengths.back(),
                            random.uniform(0.01, 0.03));
  }
  robot.gain = random.scaled(10, 80);
  robot.period = 0.005 * static_cast<double>(1 + random.below(3));
  robot.frequency = random.uniform(1, 4);
  robot.amplitude = random.uniform(0.2, 0.8);
  const bool servo = seed % 3 != 0;
  Motors motors;
  for (std::size_t j = 0; j < joints; ++j) motors.add(random, servo, seed % 2 == 0);
  robot.drives = motors.drives;
  robot.text = fmt::format(R"(
gaitlab: 1
robot:
  base: {}
  modules:
    gaitlab_module: 1
    name: drawn
    bodies:
{}    hinges:
{}    contacts:
      all:
{}
initial: {{angles: 0}}
ground: {{friction: {}}}
contact: {{on: all}}
actuator: {}
controller: {{type: pid, Kp: {}, Ki: 0, Kd: 0, period: {}}}
cpg: {{type: sine, frequency: {}, amplitude: {}, phase_lag: 1}}
duration: {}
trace: {{period: {}, columns: [t, joint.*]}}
)",
                           base, bodies, hinges, elements, random.uniform(0.2, 1), motors.text(servo), robot.gain, robot.period,
                           robot.frequency, robot.amplitude, kTime, kRow);
  return robot;
}

/// Torques of the oracle after every step, N m: step * joints + joint.
struct Truth {
  std::vector<double> torque;
  oracle::StickingRobot::Seen seen;

  [[nodiscard]] double at(std::size_t step, std::size_t joint, std::size_t joints) const {
    return torque[step * joints + joint];
  }
};

Truth by_oracle(const Drawn& robot, const Scenario& scenario) {
  oracle::StickingRobot own(scenario, robot.drives, kStep);
  Truth truth;
  const long period = std::lround(robot.period / kStep);
  std::vector<double> volts(robot.drives.size());
  for (long step = 0; step < std::lround((kTime + kLate) / kStep); ++step) {
    if (step % period == 0) {
      for (std::size_t j = 0; j < volts.size(); ++j) {
        volts[j] = robot.gain * (robot.setpoint(j, static_cast<double>(step) * kStep) - own.state().q[j]);
      }
    }
    own.step(volts);
    truth.torque.insert(truth.torque.end(), own.torque().begin(), own.torque().end());
  }
  truth.seen = own.seen();
  return truth;
}

/// RMS over the rows, without the one before the first command, of the distance of a torque to those of the oracle within
/// `late` of the row's time, over the joint's peak (at least 2 % of the largest one); value of the worst joint. A joint that
/// comes to rest has a torque that jumps by up to its whole friction. If this is some microseconds late, a row between both
/// times differs by the jump.
double distance(const Recording& record, const Truth& truth, double late) {
  const std::size_t joints = record.joints.size();
  const auto steps = [](double time) { return static_cast<std::size_t>(std::lround(time / kStep)); };
  std::vector<double> peaks(joints), squares(joints);
  for (std::size_t row = 1; row < record.rows(); ++row) {
    const std::size_t here = row * steps(kRow) - 1;
    for (std::size_t j = 0; j < joints; ++j) {
      double lo = truth.at(here, j, joints);
      double hi = lo;
      peaks[j] = std::max(peaks[j], std::abs(lo));
      for (std::size_t step = here - steps(late); step <= here + steps(late); ++step) {
        lo = std::min(lo, truth.at(step, j, joints));
        hi = std::max(hi, truth.at(step, j, joints));
      }
      const double torque = record.joint(j, "torque")[row];
      squares[j] += std::pow(std::max({0.0, lo - torque, torque - hi}), 2);
    }
  }
  const double largest = *std::max_element(peaks.begin(), peaks.end());
  double worst = 0;
  for (std::size_t j = 0; j < joints; ++j) {
    worst =
        std::max(worst, std::sqrt(squares[j] / static_cast<double>(record.rows() - 1)) / std::max(peaks[j], 0.02 * largest));
  }
  return worst;
}

class DrawnFriction : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, DrawnFriction, engines(), engine_name);

TEST_P(DrawnFriction, HasTheTorquesOfShortStepsWithTheSetValuedLaw) {
  double usual = 0;
  double fine = 0;
  oracle::StickingRobot::Seen seen;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    const Drawn robot = drawn(seed);
    const Scenario at_default = scenario(robot.text, {set()});
    const Truth truth = by_oracle(robot, at_default);
    usual = std::max(usual, distance(run(at_default), truth, kLate));
    fine = std::max(fine, distance(run(scenario(robot.text, {set(), "physics.accuracy=1e-4"})), truth, 0));
    seen.rest += truth.seen.rest;
    seen.largest += truth.seen.largest;
    seen.beyond += truth.seen.beyond;
    seen.touch += truth.seen.touch;
  }
  const std::string robots =
      GetParam() + ": eight robots with friction, gears, limits, stops and contacts, torque, RMS over peak, ";
  const std::string source = "steps of 1 us with the set-valued law";
  validate_below({"limits.drawn.fine." + GetParam(), robots + "accuracy 1e-4", source, ""}, fine, 0.01,
                 "required by the issue");
  validate_below({"limits.drawn.default." + GetParam(), robots + "default accuracy, jumps within 1 ms", source, ""}, usual,
                 0.01, "required by the issue");
  for (const long steps : {seen.rest, seen.largest, seen.beyond, seen.touch}) EXPECT_GT(steps, 100'000);
}

/// The oracle itself: a rotor stops at the time and angle of the closed form, and an arm rests within its friction.
TEST(StickingRobot, ObeysTheClosedForms) {
  const std::string text = rod() + R"(
ground: {type: none}
contact: {on: none}
actuator: {type: torque}
controller: {type: pid, unit: N m}
duration: 1
)";
  constexpr double kShort = 1e-5;  // s
  constexpr double kInertia = 1.0 / 3;
  const Scenario turning = scenario(text + "initial: {speeds: 2}", {"physics.gravity=[0, 0, 0]"});
  oracle::StickingRobot rotor(turning, {{.dry = 0.3, .viscous = 0.2}}, kShort);
  int steps = 0;
  for (; rotor.state().qd[0] > 1e-9; ++steps) rotor.step({0});
  const double time = kInertia / 0.2 * std::log1p(0.2 * 2 / 0.3);
  // Order 1: the decay rate 0.6/s times the step, and the step itself.
  EXPECT_NEAR(steps * kShort, time, 3 * kShort);
  EXPECT_NEAR(rotor.state().q[0], kInertia / 0.2 * 2 - 0.3 / 0.2 * time, 3 * kShort);

  const Scenario hanging = scenario(text + "initial: {angles: 0.1}");
  const double weight = 9.81 / 2 * std::sin(0.1);  // N m
  const auto turns = [&](double volts) {
    oracle::StickingRobot arm(hanging, {{.per_volt = 1, .supply = 9, .largest = 9, .eta = 0.6, .dry = 0.1}}, kShort);
    for (int i = 0; i < 1000; ++i) arm.step({volts});
    return arm.state().q[0] - 0.1;
  };
  constexpr double kStuck = 1e-9;  // rad; the balance ends at 1e-9 N m
  EXPECT_GT(turns((weight + 0.1) / 0.6 * 1.001), 10 * kStuck) << "lifts";
  EXPECT_NEAR(turns((weight + 0.1) / 0.6 * 0.999), 0, kStuck);
  EXPECT_NEAR(turns((weight - 0.1) * 0.6 * 1.001), 0, kStuck);
  EXPECT_LT(turns((weight - 0.1) * 0.6 * 0.999), -10 * kStuck) << "sinks";
}

}  // namespace
}  // namespace gaitlab::test
