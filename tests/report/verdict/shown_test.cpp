// Tests of gaits that their runs do not show, because they grow, drift, last longer than the run, or move nothing. The window
// of a robot that drops or stands must not depend on the end of the run.
#include <cmath>

#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {
namespace {

Verdict verdict_of(const Scenario& s) {
  const Recording record = run(s);
  return verdict(s, record, summarise(s, record, 0), overlaps(s, record));
}

Verdict snake(const std::vector<std::string>& sets) {
  std::vector<std::string> all{"duration=6", "cpg.frequency=1"};
  all.insert(all.end(), sets.begin(), sets.end());
  return verdict_of(shipped("library/y1-snake.yaml", all));
}

Verdict caterpillar(const std::vector<std::string>& sets) {
  std::vector<std::string> all{"duration=16", "physics.engine=articulated"};
  all.insert(all.end(), sets.begin(), sets.end());
  return verdict_of(shipped("caterpillar.yaml", all));
}

/// Three modules in a row whose joints follow an equation of the time u.
Verdict equation(const std::string& output, const char* duration = "20") {
  return verdict_of(scenario(fmt::format(
      "gaitlab: 1\nrobot: {{modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0]]}}\nphysics: {{engine: articulated}}\n"
      "contact: {{on: all}}\ncpg: {{type: equations, model: {{states: {{u: \"1\"}}, output: \"{}\"}}}}\nduration: {}\n",
      output, duration)));
}

void expect_not_judged(const Verdict& made, const std::string& reason) {
  EXPECT_EQ(made.word, Word::not_judged) << made.why();
  EXPECT_TRUE(contains(made.why(), reason)) << made.why();
}

/// The duration of the growth follows from a key: the ramp or the rate.
TEST(Shown, SetPointsThatGrow) {
  expect_not_judged(
      verdict_of(shipped("hexapod.yaml", {"physics.engine=articulated", "duration=6", "cpg.frequency=1", "cpg.amplitude=0.8",
                                          "cpg.model.ramp=60"})),
      "the set points still grow: they reach their full size at 60 s, but the run ends at 6 s; take duration: 63");
  expect_not_judged(snake({"cpg.model.ramp=30"}), "at 30 s, but the run ends at 6 s; take duration: 33");
  expect_not_judged(caterpillar({"cpg.model.amplitude_rate=0.005"}), "at 782.4 s, but the run ends at 16 s;");
  expect_not_judged(caterpillar({"cpg={type: kuramoto_amplitude, frequency: 1, model: {amplitude_rate: 0.5}}"}),
                    "at 23.34 s, but the run ends at 16 s;");
  expect_not_judged(caterpillar({"cpg={type: van_der_pol, frequency: 1, model: {amplitude_rate: 0.2}}"}),
                    "at 19.56 s, but the run ends at 16 s;");
}

/// Equations state no times, so that the CPG alone is simulated for three periods after the run.
TEST(Shown, EquationsThatGrow) {
  expect_not_judged(equation("0.2*(1 + 0.02*u)*sin(2*pi*u + index)", "8"), "the set points still grow: those of joint ");
  expect_not_judged(equation("0.2*(1 + exp(u - 11))*sin(2*pi*u + index)", "8"), "the set points still grow: those of joint ");
  EXPECT_NE(equation("0.2*(1 + exp(-4*u))*sin(2*pi*u + index)", "8").word, Word::not_judged);
}

/// A small change from one period to the next is seen in the first and the last period of the window.
TEST(Shown, SetPointsThatDrift) {
  expect_not_judged(equation("0.4*sin(pi*u + index) + 0.0009*u"), "the set points drift: the mean of joint m");
  expect_not_judged(equation("0.2*(1 - 0.002*u)*sin(2*pi*u + index)"), "the set points shrink: the RMS of joint m");
  expect_not_judged(equation("0.2*(1 + 0.002*u)*sin(2*pi*u + index)"), "the set points grow: the RMS of joint m");
  EXPECT_NE(equation("0.2*(1 + 0.0001*u)*sin(2*pi*u + index) + 0.00001*u").word, Word::not_judged);
}

/// If equations leave a pose or reach their size within the run, the window begins where the set points repeat.
TEST(Shown, EquationsThatReachTheirSize) {
  for (const char* const output : {"0.2*clamp(u/3, 0, 1)*sin(2*pi*u + index)", "0.3*max(0, 1 - u/3) + 0.2*sin(2*pi*u + index)",
                                   "0.1*clamp(u - 2, 0, 1)*sin(4*pi*u + index)"}) {
    const Verdict made = equation(output, "8.3");
    EXPECT_NE(made.word, Word::not_judged) << output << ": " << made.why();
    EXPECT_GE(made.from, 3) << output;
    EXPECT_LE(made.from, 5.301) << output;
  }
}

/// Steps of a set point are sampled, so that one period may have a tick more at a level than another.
TEST(Shown, StepsDoNotDrift) { EXPECT_NE(equation("0.2*sign(sin(2*pi*u/0.97 + index))").word, Word::not_judged); }

/// The periods are too long because of keyframes in milliseconds, a frequency of 0.01 Hz, or an equation that is a thousand
/// times too slow.
TEST(Shown, APeriodLongerThanTheRun) {
  const std::string frames =
      "cpg={type: keyframes, model: {frames: [{time: 0, angles: 0}, {time: 500, angles: 0.3}, {time: 1000, angles: 0}]}}";
  expect_not_judged(caterpillar({frames}), "16 s contain only 0.016 of the 3 periods of 1000 s that a gait needs");
  expect_not_judged(snake({frames}), "6 s contain only 0.006 of the 3 periods of 1000 s that a gait needs");
  expect_not_judged(caterpillar({"cpg.frequency=0.01"}), "of the 3 periods of 100 s that a gait needs");
  expect_not_judged(equation("0.4*sin(0.002*pi*u + index)", "8"), "the set points still grow");
}

TEST(Shown, NoSetPointChanges) {
  expect_not_judged(caterpillar({"cpg.frequency=0"}), "no set point changes after 1.96 s: cpg phase_oscillator moves no joint");
  expect_not_judged(snake({"cpg.frequency=0"}), "no set point changes after 1 s: cpg sine moves no joint");
  expect_not_judged(verdict_of(scenario("gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\n"
                                        "physics: {engine: articulated}\ncontact: {on: all}\nduration: 3\n")),
                    "no set point changes: there is no cpg");
}

/// A chirp passes through a period with which a longer run would seem to repeat.
TEST(Shown, AChirpDoesNotRepeat) {
  const Verdict made = equation("0.1*sin(2*pi*(0.5*u + 0.01*u*u) + index)");
  EXPECT_EQ(made.rests_on, "the 20 s of the run; the set points do not repeat");
  EXPECT_EQ(made.from, 0);
}

/// Oscillators whose phases still approach each other repeat only after the run, with the period that they state.
TEST(Shown, OscillatorsThatStillSynchronise) {
  const std::string cpg =
      "cpg={type: hopf, frequency: 1, amplitude: 0.3, phase_lag: 1.278, couplings: chain, model: {coupling: 1, rate: 2}}";
  expect_not_judged(caterpillar({cpg, "duration=4"}), "the set points grow: the RMS of joint ");
  expect_not_judged(snake({cpg, "duration=4"}), "the set points grow: the RMS of joint ");
  EXPECT_NE(caterpillar({cpg, "duration=10"}).word, Word::not_judged);
}

/// The verdict has the same word for every end of the run, for a robot that stands and for one that starts 5 cm higher.
TEST(Shown, TheEndOfTheRunDoesNotDecide) {
  for (const char* const height : {"0.05", "0.1"}) {
    for (const char* const end : {"10.02", "10.9", "11.96", "12", "12.1"}) {
      const Verdict made = verdict_of(scenario(fmt::format(
          "gaitlab: 1\nrobot: {{modules: y1, build: y1-snake-8, position: [0, 0, {}]}}\nphysics: {{engine: articulated}}\n"
          "contact: {{on: all}}\ncpg: {{type: sine, frequency: 0.5, phase_lag: 1.0472, model: {{ramp: 1}}, amplitude: "
          "{{default: 0, "
          "m0/hinge: 0.4, m2/hinge: 0.4, m4/hinge: 0.4, m6/hinge: 0.4}}}}\nduration: {}\n"
          "actuator: {{load_friction: 0, dry_friction: 0, viscous_friction: 0, rotor_inertia: 0}}\n",
          height, end)));
      EXPECT_EQ(made.word, Word::feasible) << height << " m, " << end << " s: " << made.why();
      EXPECT_GE(made.from, 2.999) << "one period after the ramp of 1 s";
      EXPECT_LE(made.from, 5.001);
    }
  }
}

}  // namespace
}  // namespace gaitlab::test
