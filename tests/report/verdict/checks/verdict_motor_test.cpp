// Tests of the checks of motors: ratings, envelopes, and the sources of their data.

#include "report/analysis/envelope.h"
#include "report/analysis/motors.h"
#include "tests/labels.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {
namespace {

const Label kLongVerdictMotor("Verdict.JudgesRatings", "long");

/// A torque near the envelope of a motor gives a warning, never a failure. Only the checks of voltage and current can fail.
TEST(Verdict, WarnsOfATorqueNearWhatAMotorHas) {
  const auto with = [&](double share) {
    Case made = walk();
    made.tick(made.last_tick(), 2, kEnvelopePeak) = share;
    return made.check("envelope");
  };
  EXPECT_EQ(with(0.75).status, CheckStatus::pass);
  EXPECT_EQ(with(0.85).status, CheckStatus::warn);
  EXPECT_EQ(with(1).status, CheckStatus::warn);
  EXPECT_EQ(with(0.85).worst, "m1/active");
  EXPECT_EQ(with(0.85).value, 0.85);
}

/// Speeds are judged by the speed without load, u_max / (Ks n) = 7.4 V / (0.00395 V s/rad 594) = 3.1539 rad/s.
TEST(Verdict, JudgesSpeedsByTheOneWithoutTorque) {
  const double no_load = 7.4 / (0.00395 * 594);
  const auto with = [&](double speed) {
    Case made = walk();
    made.tick(made.last_tick(), 7, kSpeedPeak) = speed;
    return made.check("speed");
  };
  EXPECT_NEAR(with(3).limit, no_load, 1e-12 * no_load);
  EXPECT_EQ(with(0.75 * no_load).status, CheckStatus::pass);
  EXPECT_EQ(with(0.9 * no_load).status, CheckStatus::warn);
  EXPECT_EQ(with(1.01 * no_load).status, CheckStatus::fail);
  EXPECT_EQ(with(1.01 * no_load).worst, "m3/passive");
  EXPECT_TRUE(contains(with(1.01 * no_load).text, "the load drives it"));
  const Scenario rated = shipped("caterpillar.yaml", {"duration=4", "physics.engine=articulated", "actuator.speed_max=1.2"});
  EXPECT_EQ(report::motors(rated, 0).joint(0).speed_max, 1.2);
}

/// A continuous rating of the manufacturer is compared with the RMS over the window, a peak rating with the largest value.
TEST(Verdict, JudgesRatings) {
  const auto with = [](const std::string& rating, double value) {
    Case made;
    made.scenario = shipped("caterpillar.yaml",
                            {"duration=4", "physics.engine=articulated", "actuator." + rating + "=" + std::to_string(value)});
    made.record = walk().record;
    return made;
  };
  const std::vector<JudgedJoint> joints = summarise(walk().scenario, walk().record, 0).judged.joints;
  const std::vector<JudgedJoint> whole = summarise(walk().scenario, walk().record, 0).judged.whole;
  const auto most = [&](double JudgedJoint::*member) {
    const bool peak = member == &JudgedJoint::torque_peak || member == &JudgedJoint::speed_peak;  // judged in the whole run
    double largest = 0;
    for (const JudgedJoint& joint : peak ? whole : joints) largest = std::max(largest, joint.*member);
    return largest;
  };
  for (const auto& [id, rating, value] : {std::tuple{"heat", "i_continuous", most(&JudgedJoint::current_rms)},
                                          {"gear_peak", "gear_torque_peak", most(&JudgedJoint::torque_peak)},
                                          {"gear_continuous", "gear_torque_continuous", most(&JudgedJoint::torque_rms)},
                                          {"speed", "speed_max", most(&JudgedJoint::speed_peak)}}) {
    EXPECT_GT(value, 0) << id;
    EXPECT_EQ(with(rating, 1.3 * value).status(id), CheckStatus::pass) << id;
    EXPECT_EQ(with(rating, 1.1 * value).status(id), CheckStatus::warn) << id;
    EXPECT_EQ(with(rating, 0.9 * value).status(id), CheckStatus::fail) << id;
    EXPECT_FALSE(contains(with(rating, 0.9 * value).check(id).text, "the load drives it")) << id;
    EXPECT_NEAR(with(rating, value).check(id).value, value, 1e-6 * value) << id;
    EXPECT_EQ(with(rating, value).check(id).source,
              "chosen: no source stated for " + std::string(rating) +
                  " of the scenario; the rest: chosen: the paper names no motor (docs/equations.md, 3)");
  }
  EXPECT_EQ(walk().status("gear_peak"), CheckStatus::not_judged) << "nobody states it";
}

/// The current of a DC motor is T / (eta Kt n) by eq. 2. Its RMS is thus the RMS of the torque divided by eta Kt n.
TEST(Verdict, OfCurrentsThatMakeTheTorques) {
  const std::vector<JudgedJoint> joints = summarise(walk().scenario, walk().record, 0).judged.joints;
  for (const JudgedJoint& joint : joints)
    EXPECT_NEAR(joint.current_rms, joint.torque_rms / (0.7 * 0.00395 * 594), 1e-9 * joint.current_rms);
}

/// The envelope ratio is |T| / (eta Kt n min(i_max, (u_max - s Ks n w) / R)) with the sign s of T (eq. 1 and 2). The test
/// computes it from a row at every step.
TEST(Verdict, EnvelopeIsTheLawsAtEveryStep) {
  const Scenario scenario =
      shipped("caterpillar.yaml", {"duration=2", "physics.engine=articulated", "physics.step=0.0005", "trace.period=0.0005"});
  const Recording record = run(scenario);
  const Judged judged = judge(record, {}, 1000);
  for (std::size_t j = 0; j < judged.whole.size(); ++j) {
    const Series command = record.joint(j, "voltage_command");
    const Series speed = record.joint(j, "speed");
    double largest = 0;
    const auto at = [&](double voltage, double w) {
      const double drawn = std::clamp((std::clamp(voltage, -7.4, 7.4) - 0.00395 * 594 * w) / 4.3, -1.2, 1.2);
      const double there = std::min(1.2, (7.4 - std::copysign(0.00395 * 594 * w, drawn * w)) / 4.3);
      largest = std::max(largest, std::abs(drawn) / there);
    };
    // A row contains the command of the step before it. The step after the row has the command of the next row.
    for (std::size_t k = 0; k < speed.size(); ++k) {
      at(command[k], speed[k]);
      if (k + 1 < speed.size()) at(command[k + 1], speed[k]);
    }
    // The tolerance is 1 %, because an oscillating torque may be larger in the stages of a step than at its ends.
    EXPECT_NEAR(judged.whole[j].envelope_peak, largest, 0.01 * largest) << scenario.robot->joints[j].name;
  }
}

TEST(Verdict, SaysWhoseFiguresItRestsOn) {
  const Verdict chosen_motors = walk().judged();
  EXPECT_TRUE(chosen_motors.chosen_motors);
  EXPECT_EQ(walk().check("voltage").source,
            "chosen (limits.saturated_share); motors: chosen: the paper names no motor "
            "(docs/equations.md, 3)");
  EXPECT_EQ(chosen_motors.figures, "motors: chosen figures");
  EXPECT_EQ(walk().check("tracking").source, "chosen (limits.tracking_error)");
}

TEST(Verdict, OfAnActuatorWithoutALimit) {
  const auto with = [&](const std::string& actuator) {
    const Scenario s = scenario(
        "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.2\nphysics: {engine: articulated}\n"
        "controller: {unit: N m, Kp: 5, period: 0.002}\ncontact: {on: all}\nactuator: " +
        actuator + "\n");
    const Recording r = run(s);
    return verdict(s, r, summarise(s, r, 0), overlaps(s, r));
  };
  const auto status = [](const Verdict& v, const char* id) { return std::ranges::find(v.checks, id, &Check::id)->status; };
  const Verdict ideal = with("{type: torque}");
  EXPECT_EQ(status(ideal, "voltage"), CheckStatus::not_judged);
  EXPECT_EQ(status(ideal, "current"), CheckStatus::not_judged);
  EXPECT_EQ(ideal.word, Word::not_judged);
  const Verdict real = with("{type: torque, limit: 100}");
  EXPECT_EQ(status(real, "voltage"), CheckStatus::not_judged);
  EXPECT_EQ(status(real, "current"), CheckStatus::pass);
}

}  // namespace
}  // namespace gaitlab::test
