// Runs under the controller `rc_servo` agree with the closed solution of a rotor between two ticks.
#include <cmath>

#include "tests/program/fixture.h"
#include "tests/program/rod.h"

namespace gaitlab::test {
namespace {

/// Closed solution of a rotor of inertia J with the bare line of a servo, which is exact between two ticks.
struct ServoRotor {
  double J, T0, w0, angle = 0, speed = 0;
  void advance(double volts, double period) {  // at the supply of 1 V of the line
    const double rate = T0 / w0 / J;
    const double last = w0 * volts;
    const double left = std::exp(-rate * period);
    angle += last * period + (speed - last) * (1 - left) / rate;
    speed = last + (speed - last) * left;
  }
};

TEST(RcServo, RunsAreThoseOfAnOwnSimulator) {
  // The rod of 1 kg and 1 m turns about its axis without gravity; the set point is a step of 1 rad. The limit of the current is
  // far away. A servo that samples every 20 ms with a high gain oscillates for ever; so does one with latency.
  constexpr double kPeriod = 0.005;
  struct Case {
    const char* keys;
    double gain, every, dead, punch, speed, latency;
  };
  for (const Case& one :
       {Case{"gain: 3", 3, 1, 0, 0, 0, 0}, Case{"gain: 3, every: 4", 3, 4, 0, 0, 0, 0},
        Case{"gain: 40, every: 4", 40, 4, 0, 0, 0, 0}, Case{"gain: 6, dead_band: 0.02, punch: 0.05", 6, 1, 0.02, 0.05, 0, 0},
        Case{"gain: 6, speed_limit: 2", 6, 1, 0, 0, 2, 0}, Case{"gain: 6, latency: 0.03", 6, 1, 0, 0, 0, 0.03}}) {
    const std::string text = rod() + fmt::format(R"(
ground: {{type: none}}
contact: {{on: none}}
physics: {{engine: articulated, gravity: [0, 0, 0], accuracy: 1e-6, estimate: off}}
initial: {{angles: 0.25}}
actuator: {{type: servo, voltage: 6, stall_torque: 2, no_load_speed: 8, i_max: 1000, load_friction: 0, dry_friction: 0,
            viscous_friction: 0, rotor_inertia: 0}}
controller: {{type: rc_servo, period: {}, {}}}
cpg: {{type: keyframes, model: {{interpolation: linear, repeat: false, frames: [{{time: 0, angles: 1}}, {{time: 9, angles: 1}}]}}}}
duration: 2
trace: {{period: {}, columns: [t, joint.*]}}
)",
                                                 kPeriod, one.keys, kPeriod);
    const Trace trace = run(scenario(text)).trace;
    ServoRotor rotor{1.0 / 3, 2, 8, 0.25};
    std::vector<double> goals(static_cast<std::size_t>(std::lround(one.latency / kPeriod)), 0.25);
    double goal = 0.25;
    double duty = 0;
    const std::size_t angle = trace.find("joint.0.angle");
    for (std::size_t k = 0; k < trace.rows(); ++k) {
      // 1e-5: accuracy 1e-6 of the torques, 2 N m, acts on 1/3 kg m^2 for 2 s; a loop that oscillates amplifies it.
      ASSERT_NEAR(trace.at(k, angle), rotor.angle, 1e-5) << one.keys << " at row " << k;
      goals.push_back(1);
      if (k % static_cast<std::size_t>(one.every) == 0) {
        const double wanted = goals[k];
        goal = one.speed > 0 ? goal + std::clamp(wanted - goal, -one.speed * kPeriod, one.speed * kPeriod) : wanted;
        const double e = goal - rotor.angle;
        const double side = e < 0 ? -1 : 1;
        duty = std::abs(e) <= one.dead ? 0 : std::clamp(one.gain * (e - side * one.dead) + side * one.punch, -1.0, 1.0);
      }
      rotor.advance(duty, kPeriod);
    }
  }
}

TEST(RcServo, ACommandBeyondTheLimitCountsAsAtTheSupply) {
  const auto saturated = [](const std::string& limit) {
    const Recording r =
        run(scenario(rod() +
                     "ground: {type: none}\ncontact: {on: none}\nphysics: {engine: articulated, estimate: off}\n"
                     "actuator: {type: servo, voltage: 6, stall_torque: 2, no_load_speed: 8}\n"
                     "controller: {type: rc_servo, period: 0.01, gain: 1" +
                     limit + "}\ninitial: {angles: 0.8}\nduration: 0.1\n"));
    return r.joints.at(0).saturated_voltage;
  };
  EXPECT_EQ(saturated(""), 0) << "the error stays small";
  EXPECT_NEAR(saturated(", limit: 0.001"), 1, 0.2) << "all ticks but the first, at which the error is 0";
}

TEST(RcServo, RefusesAGainThatIsStatedTwice) {
  const auto text = [](const std::string& keys) {
    return rod() + "actuator: {type: servo, voltage: 6, stall_torque: 2, no_load_speed: 8}\ncontroller: {type: rc_servo" +
           keys + "}\nduration: 1\n";
  };
  expect_refusal(text(", gain: 1, P: 400"), "gain and P are both stated");
  expect_refusal(text(", gain: 1, latency: -1"), "latency");
  expect_refusal(text(", gain: 1, latency: 10, period: 1e-6"),
                 "latency of joint m0/swing is more than 100000 control periods; expected a shorter latency, or a longer");
  expect_refusal(rod() + "actuator: {type: torque}\ncontroller: {type: rc_servo, gain: 1}\nduration: 1\n",
                 "controller 'rc_servo' commands duty, but actuator 'torque' takes N m");
}

TEST(RcServo, ALatencyThatIsRoundedHasANote) {
  const auto notes = [](const std::string& keys) {
    std::string all;
    const Scenario s = scenario(rod() + "actuator: {type: servo, voltage: 6, stall_torque: 2, no_load_speed: 8}\n" +
                                "controller: {type: rc_servo, " + keys + "}\nduration: 1\n");
    for (const Note& note : s.notes) all += note.text;
    return all;
  };
  EXPECT_EQ(notes("period: 0.005, latency: 0.007"),
            "controller: latency 0.007 s acts as 0.01 s, the next whole number of control periods (controller.period 0.005 s)");
  EXPECT_EQ(notes("period: 0.001, latency: 0.007"), "");
  EXPECT_EQ(notes("period: 0.005"), "");
  EXPECT_TRUE(
      contains(notes("period: 0.005, latency: {m0/swing: 0.012}"), "latency 0.012 s of joint m0/swing acts as 0.015 s"));
  const Folder folder;
  const std::string file =
      folder.write("s.yaml", rod() + "actuator: {type: servo, voltage: 6, stall_torque: 2, no_load_speed: 8}\n" +
                                 "controller: {type: rc_servo, latency: 0.007, period: 0.01}\nduration: 0.1\n");
  for (const char* const command : {"check", "run --no-report --out r"}) {
    const Result result = gaitlab(fmt::format("{} s.yaml", command), folder.path().string());
    EXPECT_TRUE(contains(result.err, "s.yaml: note: controller: latency 0.007 s acts as 0.01 s")) << result.err;
  }
  const ScenarioTemplate all(file, {}, catalog());
  EXPECT_EQ(all.with({"controller.latency=0.01"}).notes.size(), 0U) << "the note of the template is not kept";
}

TEST(RcServo, ALatencyInARunIsRefusedWithItsReason) {
  const std::string text = rod() + "actuator: {type: servo, voltage: 6, stall_torque: 2, no_load_speed: 8}\n" +
                           "controller: {type: rc_servo, latency: 0.01, period: 0.005}\nduration: 1\n";
  expect_refusal(
      text + "at: [{t: 0.5, set: {controller.latency: 0.02}}]\n",
      "set changes the controller's 8 states to 10 (latency: Time from a set point until it acts; the longest one is "
      "a state per control period); expected settings that keep the number of states");
}

}  // namespace
}  // namespace gaitlab::test
