// Tests of the energy ledger: the energies of all steps balance except for the integration error.
#include "tests/labels.h"
#include "tests/program/engines.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

// Whole walks of bullet.
const Label kLedgers("*LedgerOf.*:Ledger.Directional*", "long;unsanitized");

const std::string kShort = "duration=1.5";  // long enough that motors drive and are driven, and feet stand and slip
const std::string kColumns = "trace.columns=[energy.*]";

Ledger ledger(const Scenario& s) { return run(s).ledger; }

class LedgerOf : public testing::TestWithParam<const char*> {};

TEST_P(LedgerOf, ExplainsTheElectricalEnergy) {
  Scenario s = shipped(GetParam(), {"physics.integrator=semi_implicit", kShort, kColumns});
  const Ledger at_default = ledger(s);
  s.physics.refine(2);
  const Ledger halved = ledger(s);
  EXPECT_GT(at_default.electrical, 0.5);
  const std::string robot = std::string(GetParam()).substr(0, std::string(GetParam()).find('.'));
  validate_below(
      {"ledger." + robot, "energy no entry explains, of what is drawn in 1.5 s, at the default step", "balance of energy", ""},
      std::abs(at_default.residual()) / at_default.electrical, 0.005, "required by the issue: 0.5 %");
  validate({"ledger." + robot + "_order", "that energy at half the step, relative, 1.5 s", "first order", ""},
           halved.residual() / at_default.residual(), 0.5, 0.15, "the second order, of the size of the motor's h lambda");
  for (const double loss : {at_default.copper, at_default.contact, at_default.friction}) EXPECT_GT(loss, 0);
}
INSTANTIATE_TEST_SUITE_P(Robots, LedgerOf, testing::Values("caterpillar.yaml", "hexapod.yaml"));

TEST(Ledger, DirectionalGearsCreateNothing) {
  const Recording printed = run(shipped("hexapod.yaml", {kShort}));
  const Recording directional = run(shipped("hexapod.yaml", {kShort, "actuator.efficiency_model=directional"}));
  double created = 0;
  for (const JointStatistics& joint : printed.joints) created += joint.created;
  EXPECT_GT(created, 0.05 * printed.ledger.electrical);  // measured 0.2, the reason for the directional model
  const double electrical = directional.ledger.electrical;
  double most = 0;
  for (const JointStatistics& joint : directional.joints) most = std::max(most, joint.created);
  validate_below(
      {"ledger.directional_created", "hexapod, directional gears, 1.5 s: most that any joint's gear creates, of what is drawn",
       "a gear loses", ""},
      most / electrical, 1e-12, "none by its law: rounding of power in - copper - shaft");
  validate_below({"ledger.directional", "hexapod, directional gears: energy no entry explains, of what is drawn in 1.5 s",
                  "balance of energy", ""},
                 std::abs(directional.ledger.residual()) / electrical, 0.005, "required by the issue: 0.5 %");
}

class LedgerIn : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Engines, LedgerIn, engines(), engine_name);

// The lost kinetic and potential energy of a thrown robot without motors equals the losses in stops, ground and friction.
TEST_P(LedgerIn, ExplainsAThrownRobot) {
  const auto thrown = [](double step) {
    return ledger(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, build: robots/caterpillar-8.dat}}
initial: {{base_velocity: [0.6, 0.3, 0], angles: 1.4, speeds: 3}}
physics: {{engine: {}, step: {}}}
contact: {{on: all}}
actuator: {{type: none}}
duration: 0.3
trace: {{period: 0.01, columns: [energy.*]}}
)",
                                       GetParam(), step)));
  };
  const Ledger coarse = thrown(2e-5);
  const Ledger fine = thrown(1e-5);
  EXPECT_EQ(coarse.electrical, 0);
  EXPECT_LT(coarse.stored, -0.5);
  for (const double work : {coarse.contact, coarse.friction, coarse.stops}) EXPECT_GT(work, 0.01);
  EXPECT_LT(std::abs(coarse.residual()), 0.01 * -coarse.stored);
  EXPECT_LT(std::abs(fine.residual()), 0.7 * std::abs(coarse.residual()));
}

// The energy that a stop dissipates equals the lost kinetic energy of a hinge that bounces three times. No other force acts.
TEST_P(LedgerIn, BooksWhatAStopTakes) {
  const Recording record = run(scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 1]
  modules:
    name: gate
    bodies:
      post: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
      wing: {{mass: 1, inertia: [0.05, 0.05, 0.05, 0, 0, 0]}}
    hinges: [{{name: pin, parent: post, child: wing, axis: [0, 1, 0], range: [-0.2, 0.2]}}]
initial: {{speeds: 2}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
physics: {{engine: {}, step: 2e-5}}
duration: 1
trace: {{period: 0.01, columns: [energy.*, joint.*]}}
)",
                                                    GetParam())));
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  const double kinetic = 0.5 * 0.05 * 2 * 2;
  const double left = 0.5 * 0.05 * std::pow(table.at(last, "joint.0.speed"), 2);
  // A stop of 50 N m/rad and 0.5 N m s/rad returns an inertia of 0.05 kg m^2 with at most 0.6 of its speed.
  EXPECT_LT(left, 0.2 * kinetic);
  EXPECT_LT(std::abs(table.at(last, "joint.0.angle")), 0.2) << "between the stops, whose springs hold nothing";
  EXPECT_NEAR(record.ledger.stops, kinetic - left, 1e-3 * kinetic) << "order 1: h times the stop's 30/s, and as much again";
  EXPECT_LT(std::abs(record.ledger.residual()), 1e-3 * kinetic);
}

TEST(Ledger, RowsAndSummaryHoldTheSameSums) {
  const Recording record = run(shipped("caterpillar.yaml", {"duration=0.3", kColumns}));
  const Table table(record.trace);
  const std::size_t last = record.trace.rows() - 1;
  EXPECT_EQ(table.at(0, "energy.electrical"), 0);
  EXPECT_EQ(table.at(0, "energy.stored"), 0);
  EXPECT_EQ(table.at(last, "energy.friction"), record.ledger.friction);
  EXPECT_EQ(table.at(last, "energy.residual"), record.ledger.residual());
  double electrical = 0;
  for (const JointStatistics& joint : record.joints) electrical += joint.electrical;
  // Both sums have the same terms in a different order, so that they differ only by rounding errors.
  EXPECT_NEAR(table.at(last, "energy.electrical"), electrical, 1e-12 * electrical);
}

}  // namespace
}  // namespace gaitlab::test
