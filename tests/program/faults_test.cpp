// Faults of joints and changes of settings in a run.
#include <cmath>

#include "core/model/pattern.h"
#include "core/scenario/resolved.h"
#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/messages.h"
#include "tests/program/allocations.h"
#include "tests/program/as_alone.h"
#include "tests/program/engines.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

const Label kLongFaults(
    "*FaultsOf.WithoutEffectLeaveTheSameBits/*:Faults.AStuckJointShortensExplicitSteps:*FaultsOf.ADeadJointIsOneWithoutGains/*",
    "long");

Scenario faulty_caterpillar(std::vector<std::string> sets, const std::string& engine = "articulated") {
  sets.push_back("physics.engine=" + engine);
  return shipped("caterpillar.yaml", sets);
}

/// The section `at` with one fault of joint 6, m3/active.
std::string fault(const std::string& keys, const std::string& t = "0.1", const std::string& joint = "m3/active") {
  return fmt::format("at=[{{t: {}, fault: {{joint: {}, kind: {}}}}}]", t, joint, keys);
}
constexpr const char* kJoint = "joint.6.";
const std::vector<std::string> kKinds{"dead", "open", "stuck", "weak, share: 0.5", "lost, share: 0.3", "late, delay: 0.03"};
const std::string kAll =
    "at=[{t: 0.03, fault: [{joint: m0/active, kind: dead}, {joint: m1/active, kind: open}, {joint: m2/active, kind: stuck}]}, "
    "{t: 0.06, fault: [{joint: m3/active, kind: weak, share: 0.5}, {joint: m4/*, kind: lost, share: 0.3}]}, "
    "{t: 0.09, set: {cpg.frequency: 0.3, controller.Kp.m7/active: 80}, fault: {joint: m5/*, kind: late, delay: 0.03}}]";

/// Hash of the columns that a run without changes has too.
std::string common(const Scenario& s) {
  const Recording r = run(s);
  return hash(r.trace) + bits(r);
}

class FaultsOf : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Engine, FaultsOf, engines(), engine_name);

TEST_P(FaultsOf, WithoutEffectLeaveTheSameBits) {
  const auto of = [](std::vector<std::string> own) {
    own.insert(own.end(), {"duration=0.45", "trace.columns=[joint.*.torque, joint.*.setpoint, base.*, cpg.*]"});
    return common(faulty_caterpillar(own, GetParam()));
  };
  const std::string without = of({});
  EXPECT_EQ(resolved(faulty_caterpillar({"at=[]"}, GetParam())), resolved(faulty_caterpillar({}, GetParam())));
  EXPECT_EQ(of({"at=[]"}), without);
  EXPECT_EQ(of({"at=[{t: 0.1, set: {cpg.frequency: 0.25, controller.Kp: 100}}]"}), without);
  for (const char* kind : {"none", "lost, share: 0", "late, delay: 0", "weak, share: 1"}) EXPECT_EQ(of({fault(kind)}), without);
  for (const std::string& kind : kKinds) {
    if (GetParam() == "bullet" && kind == "stuck") continue;  // a stuck joint needs steps of 2.5e-6 s
    EXPECT_NE(of({fault(kind)}), without) << kind;
  }
}

TEST_P(FaultsOf, ADeadJointIsOneWithoutGains) {
  const auto of = [](const std::vector<std::string>& own) {
    std::vector<std::string> sets{"duration=0.9", "trace.columns=[joint.*.torque, joint.*.current, base.*, energy.*]"};
    sets.insert(sets.end(), own.begin(), own.end());
    sets.push_back("physics.engine=" + GetParam());
    return common(shipped("hexapod.yaml", sets));
  };
  EXPECT_EQ(of({fault("dead", "0", "m7/active")}), of({"controller.Kp.m7/active=0", "controller.Kd.m7/active=0"}));
}

TEST_P(FaultsOf, AnOpenJointHasNeitherTorqueNorCurrent) {
  const Recording r =
      run(faulty_caterpillar({"duration=1.5", fault("open", "0.5"), "trace.columns=[joint.*, energy.residual]"}, GetParam()));
  const Table table(r.trace);
  for (std::size_t row = 0; row < r.trace.rows(); ++row) {
    const bool open = table.at(row, "t") > 0.511;
    ASSERT_EQ(table.at(row, std::string(kJoint) + "fault"), open ? 2 : 0) << row;
    for (const char* column : {"torque", "current", "voltage", "voltage_command"}) {
      if (!open) continue;
      ASSERT_EQ(table.at(row, std::string(kJoint) + column), 0) << row << column;
    }
  }
  const double residual = std::abs(table.at(r.trace.rows() - 1, "energy.residual"));
  EXPECT_LT(residual / r.ledger.electrical, 1e-3) << "as without the fault";
}

// The resolved scenario states the settings of a segment in full, with values by joint as lists.
TEST(Faults, TheResolvedScenarioCanBeReadAgain) {
  const Scenario s =
      shipped("caterpillar.yaml", {"physics.engine=articulated", "duration=1.2", "cpg.amplitude={default: 0.6, 'm0/*': 0.3}",
                                   "at=[{t: 0.3, set: {cpg.amplitude.m3/active: 0.1, controller.Kp.m1/active: 50}}, "
                                   "{t: 0.6, set: {controller.Kp.m1/active: 50}}]"});
  const std::string text = resolved(s);
  const Scenario again = scenario(text);
  EXPECT_EQ(resolved(again), text);
  EXPECT_EQ(alone(again), alone(s));
}

// Motors of 1.97 N m turn a joint by 4e-4 rad against 5000 N m/rad. The weight of the modules adds as much again, and the
// impact a little.
TEST(Faults, AStuckJointStaysWhereItIs) {
  const Recording r =
      run(faulty_caterpillar({"duration=6", fault("stuck", "2"), "trace.columns=[joint.*, energy.*]", "physics.estimate=off"}));
  const Table table(r.trace);
  double held = NAN;
  double farthest = 0;
  for (std::size_t row = 1; row < r.trace.rows(); ++row) {
    if (!(table.at(row, std::string(kJoint) + "fault") > 0)) continue;
    if (std::isnan(held)) held = table.at(row - 1, std::string(kJoint) + "angle");
    if (table.at(row, "t") < 2.1)
      continue;  // waits five times as long as a joint in motion needs for the ramp of 20 ms and its return
    farthest = std::max(farthest, std::abs(table.at(row, std::string(kJoint) + "angle") - held));
  }
  validate_below(
      {"closed.stuck_joint", "a stuck joint of the caterpillar keeps its angle", "required (docs/real-robot.md)", "rad"},
      farthest, 1e-3, "the largest torques over the stiffness of the hold");
  EXPECT_LT(std::abs(r.ledger.residual()) / r.ledger.electrical, 1e-3);
}

/// A hold that acts immediately stopped a joint in motion within 20 us, with 1200 N at a dock of the hexapod. The hold
/// therefore grows from 0 in 20 ms. No load changes at the tick of the jam, and later loads do not depend on the step.
TEST(Faults, AJamInMotionTakesHoldGradually) {
  const auto loads_of = [](const std::string& robot, std::vector<std::string> sets) {
    for (const char* const set : {"physics.engine=articulated", "duration=1.26", "contact.on=all", "cpg.frequency=1"})
      sets.emplace_back(set);
    const Scenario s = shipped(robot, sets);
    Simulation simulation({&s, 1}, Loads::recorded);
    simulation.run();
    return simulation.take_recording(0).loads;
  };
  constexpr std::size_t kJam = 80;  // row at 1.2 s
  for (const auto& [robot, joint] : {std::pair("caterpillar.yaml", "m3/active"), std::pair("hexapod.yaml", "m7/active")}) {
    const std::string jams = fault("stuck", "1.2", joint);
    const Trace free = loads_of(robot, {});
    const Trace jammed = loads_of(robot, {jams});
    const Trace fine = loads_of(robot, {jams, "physics.accuracy=0.002"});
    for (std::size_t c = 0; c < free.columns.size(); ++c) {
      if (!glob("dock.*", free.columns[c].name)) continue;
      const auto most = [&](const Trace& loads) {
        double all = 0;
        for (std::size_t row = kJam; row < loads.rows(); ++row) all = std::max(all, std::abs(loads.at(row, c)));
        return all;
      };
      EXPECT_EQ(jammed.at(kJam, c), free.at(kJam, c)) << robot << " " << free.columns[c].name;
      EXPECT_NEAR(most(jammed), most(fine), 0.1 * most(fine) + 0.02) << robot << " " << free.columns[c].name;
    }
  }
}

// The hold of 50 N m s/rad is the fastest damper of the robot. The stability rule includes it before the run.
TEST(Faults, AStuckJointShortensExplicitSteps) {
  const Scenario s =
      faulty_caterpillar({"duration=0.09", "physics.integrator=semi_implicit", fault("stuck", "0.03")}, "bullet");
  EXPECT_LT(s.physics.step, 5e-6);
  const Recording r = run(s);
  const Table table(r.trace);
  const double held = table.at(6, std::string(kJoint) + "angle");
  EXPECT_EQ(table.at(7, std::string(kJoint) + "fault"), 3);
  EXPECT_NEAR(table.at(18, std::string(kJoint) + "angle"), held, 1e-3);
  const std::string refused = message_of([] {
    run(faulty_caterpillar({"duration=0.09", fault("stuck", "0.03"), "physics.step=2.5e-5", "physics.estimate=off"}, "bullet"));
  });
  EXPECT_NE(refused.find("set by the hinge stop of joint m3/active"), std::string::npos) << refused;
}

TEST(Faults, NeedAMotor) {
  const auto error = [](const std::string& joint) {
    return message_of([&] {
      static_cast<void>(read_scenario(std::string(gaitlab::test::source_folder()) + "/tests/data/castor-first.yaml",
                                      {fmt::format("at=[{{t: 1, fault: {{joint: {}, kind: dead}}}}]", joint)}, catalog()));
    });
  };
  EXPECT_TRUE(error("m0/castor").ends_with("error: joint 'm0/castor' has no motor (drive: none)")) << error("m0/castor");
  EXPECT_EQ(error("'m0/*'"), "no error") << "one of the joints has a motor";
  const std::string none = message_of([] { faulty_caterpillar({"actuator={type: none}", fault("dead")}); });
  EXPECT_NE(none.find("a fault needs a motor, but the robot has none (actuator.type: none); remove the fault"),
            std::string::npos)
      << none;
}

// The motor of a weak joint draws the current of a whole one at that speed, and gives a share of the torque.
TEST(Faults, AWeakJointHasAShareOfTheTorque) {
  const Recording r = run(faulty_caterpillar({"duration=0.9", fault("weak, share: 0.25", "0.3"), "trace.columns=[joint.6.*]"}));
  const Table table(r.trace);
  constexpr double kWhole = 0.7 * 0.00395 * 594;  // eta Kt n of the module type
  for (std::size_t row = 0; row < r.trace.rows(); ++row) {
    const double share = table.at(row, "joint.6.fault") > 0 ? 0.25 : 1;
    ASSERT_NEAR(table.at(row, "joint.6.torque"), share * kWhole * table.at(row, "joint.6.current"), 1e-12) << row;
  }
}

// Companions of the estimate run beside the recorded lane, and a battery bounds the motors: the torque available to the
// recorded joint has the fault too.
TEST(Faults, TheAvailableTorqueBesideCompanionsHasTheFault) {
  const auto share = [](const std::string& at) {
    const Recording r =
        run(faulty_caterpillar({"duration=1.2", "physics.estimate=full", "supply={voltage: 7.4, resistance: 0.05}", at}));
    return judge_from(r, 0).joints[6].envelope_peak;
  };
  const double whole = share("at=[]");
  const double weak = share(fault("weak, share: 0.1", "0"));
  EXPECT_GT(weak, 2 * whole);
  EXPECT_LE(weak, 1 + 1e-9);
}

TEST(Faults, LateSetPointsAreThoseOfEarlierTicks) {
  const std::vector<std::string> sets{"duration=0.6", "trace.period=0.015", "trace.columns=[joint.6.*]"};
  const Recording on_time = run(faulty_caterpillar(sets));
  std::vector<std::string> own = sets;
  own.push_back(fault("late, delay: 0.03", "0.3"));
  const Recording late = run(faulty_caterpillar(own));
  for (std::size_t row = 0; row < late.trace.rows(); ++row) {
    const std::size_t from = row > 20 ? row - 2 : row;  // a row shows the set point in force before it
    ASSERT_EQ(Table(late.trace).at(row, "joint.6.setpoint"), Table(on_time.trace).at(from, "joint.6.setpoint")) << row;
  }
}

TEST(Faults, LostSetPointsAreHeld) {
  const Recording r = run(faulty_caterpillar({"duration=15", "trace.period=0.015", "trace.columns=[joint.6.*]",
                                              "physics.estimate=off", fault("lost, share: 0.3", "0")}));
  const Table table(r.trace);
  std::size_t held = 0;
  for (std::size_t row = 2; row < r.trace.rows(); ++row) {
    held += table.at(row, "joint.6.setpoint") == table.at(row - 1, "joint.6.setpoint") ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(held) / 999, 0.3, 0.045) << "three deviations of 999 draws";
}

TEST_P(FaultsOf, SnapshotGoesOn) {
  std::string all = kAll;
  if (GetParam() == "bullet") all.replace(all.find("stuck"), 5, "weak, share: 0.9");  // a stuck joint needs steps of 2.5e-6 s
  const Scenario s = faulty_caterpillar({"duration=1", all}, GetParam());
  const auto go = [](Simulation& simulation, double until) {
    while (simulation.time() < until) simulation.step();
    return std::vector<double>(simulation.state().begin(), simulation.state().end());
  };
  Simulation first({&s, 1});
  const std::vector<double> early = go(first, 0.068);
  const std::vector<double> end = go(first, 0.25);
  Simulation second({&s, 1});
  std::copy(early.begin(), early.end(), second.state().begin());
  EXPECT_EQ(go(second, 0.25), end);
  std::copy(early.begin(), early.end(), first.state().begin());  // returns from a later segment
  EXPECT_EQ(go(first, 0.25), end);
}

TEST_P(FaultsOf, AllocateNothingInTheSteadyState) {
  std::string all = kAll;
  if (GetParam() == "bullet") all.replace(all.find("stuck"), 5, "weak, share: 0.9");
  const Scenario s = faulty_caterpillar({"duration=12", all}, GetParam());
  Simulation simulation({&s, 1});
  for (int i = 0; i < 4000; ++i) simulation.step();
  const Allocations allocations;
  for (int i = 0; i < 1000; ++i) simulation.step();
  EXPECT_EQ(allocations.count(), 0);
}

class FaultsInLanes : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Step, FaultsInLanes, ::testing::Values("5e-4", "auto"),
                         [](const auto& step) { return step.index == 0 ? "fixed" : "adaptive"; });

TEST_P(FaultsInLanes, AreAsAlone) {
  const std::vector<std::vector<std::string>> own{{kAll},
                                                  {},
                                                  {fault("stuck")},
                                                  {kAll, "seed=5"},
                                                  {fault("open"), "duration=0.2"},
                                                  {fault("weak, share: 0.1")},
                                                  {"at=[{t: 0.1, set: {cpg.phase_lag: -1.2}}]"},
                                                  {fault("lost, share: 0.5")}};
  const std::vector<Scenario> all = rollouts(
      kScenarios + "caterpillar.yaml",
      {"physics.engine=articulated", "physics.estimate=off", std::string("physics.step=") + GetParam(), "duration=0.3"}, own,
      catalog());
  const std::vector<std::string> expected = expect_as_alone(all, 7);
  EXPECT_NE(expected[0], expected[3]);
}

TEST(Faults, RowsWithinAStepChangeNothing) {
  const auto with_rows = [](const std::string& period) {
    return bits(run(faulty_caterpillar({"duration=0.18", kAll, "trace.period=" + period})));
  };
  EXPECT_EQ(with_rows("0.0023"), with_rows("0.005"));
}

// Companions have the same faults, so that their torques are as near to those of the run as without faults.
TEST(Faults, TheEstimateOfTheTorqueErrorHasThem) {
  for (const char* step : {"auto", "5e-4"}) {
    const Recording r = run(faulty_caterpillar({"duration=2", kAll, std::string("physics.step=") + step}));
    double worst = 0;
    for (std::size_t j = 0; j < r.joints.size(); ++j) {
      const double peak = r.joints[j].torque_peak;
      if (peak > 0.1) worst = std::max(worst, r.tally.torque_error[j] / peak);
    }
    EXPECT_LT(worst, 0.05) << step;
    EXPECT_EQ(r.tally.torque_error.empty(), false);
  }
}

TEST(Changes, PhaseAndAmplitudeFollowTheirEquations) {
  const Recording r = run(faulty_caterpillar({"duration=14", "controller.period=0.01", "trace.period=0.01",
                                              "trace.columns=[cpg.*, segment]", "physics.estimate=off", "cpg.model.coupling=1",
                                              "at=[{t: 10, set: {cpg.phase_lag: -1.2, cpg.amplitude: 0.4}}]"}));
  const Table table(r.trace);
  double phase = 0;
  double amplitude = 0;
  double first = NAN;
  for (std::size_t row = 1001; row < r.trace.rows(); ++row) {
    const double t = table.at(row, "t") - 10;
    const double psi = table.at(row, "cpg.phi.1") - table.at(row, "cpg.phi.0") + 1.2;
    if (std::isnan(first)) first = table.at(1000, "cpg.r.0");
    phase = std::max(phase, std::abs(psi - 2 * std::atan(std::tan(1.2) * std::exp(-t))));
    amplitude = std::max(amplitude, std::abs(table.at(row, "cpg.r.0") - (0.4 + (first - 0.4) * std::exp(-2 * t))));
    ASSERT_EQ(table.at(row, "segment"), 1);
  }
  EXPECT_NEAR(table.at(1000, "cpg.phi.1") - table.at(1000, "cpg.phi.0") + 1.2, 2.4, 1e-9);
  const std::string why = "Runge-Kutta of order 4 with steps of 0.01 s";
  validate_below({"cpg.changed_lag", "phase difference after a change of phase_lag", "closed form", "rad"}, phase, 1e-6, why);
  validate_below({"cpg.changed_amplitude", "amplitude after a change of amplitude", "closed form", "rad"}, amplitude, 1e-6,
                 why);
}

// This coupling reverses the wave of the 16 joints within 10 s.
TEST(Changes, TheCaterpillarTurnsBack) {
  const auto last = [](const std::vector<std::string>& own) {
    std::vector<std::string> sets{"trace.period=1", "trace.columns=[com.x]", "physics.estimate=off", "cpg.model.coupling=4"};
    sets.insert(sets.end(), own.begin(), own.end());
    const Recording r = run(faulty_caterpillar(sets));
    return Table(r.trace).at(r.trace.rows() - 1, "com.x") - Table(r.trace).at(r.trace.rows() - 9, "com.x");
  };
  const double turned = last({"duration=40", "at=[{t: 20, set: {cpg.phase_lag: -1.2}}]"});
  validate({"published.reversed_wave", "travel of the caterpillar in 8 s, 12 s after its wave turns about, over that before",
            "the chain is the same from both ends", ""},
           turned / last({"duration=20"}), -1, 0.03, "the gait settles again");
}

}  // namespace
}  // namespace gaitlab::test
