// Pattern generators in files (scenarios/cpg): their oscillators agree with closed forms and published numbers, and faults in a
// file or in its use are refused at their place.
#include <cmath>
#include <numbers>

#include "core/math/periods.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sensor_section.h"
#include "core/simulation/cpg_integrator.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A CPG of a scenario without its robot: inputs by joint are what the test sets.
class Alone {
 public:
  explicit Alone(const std::string& cpg, double period = 0.015)
      : scenario_(scenario(fmt::format("gaitlab: 1\nrobot: {{modules: rod, base: fixed}}\nground: {{type: none}}\n"
                                       "contact: {{on: none}}\nactuator: {{type: dc_motor}}\nphysics: {{engine: articulated}}\n"
                                       "controller: {{type: pid, Kp: 1, period: {}}}\nduration: 1\ncpg: {}\n",
                                       period, cpg))),
        cpg_(make_cpg(scenario_.cpg, plugin_info(scenario_))),
        x(cpg_->states()),
        integrator_(x.size()) {
    cpg_->start(x);
  }
  /// One control period; the states before the output.
  void tick() {
    const auto measured = [&](double at) {
      return Measured{at, scenario_.control_period, angle, speed, torque, touching, {}, load};
    };
    cpg_->event(measured(t()), x);
    seen = x;
    integrator_.advance(*cpg_, x, t(), math::steps_in(scenario_.control_period, scenario_.cpg_step), scenario_.cpg_step,
                        measured);
    ++ticks_;
  }
  [[nodiscard]] double t() const { return static_cast<double>(ticks_) * scenario_.control_period; }
  std::vector<double> angle{0}, speed{0}, torque{0}, touching{0}, load{0};

 private:
  Scenario scenario_;
  std::unique_ptr<Cpg> cpg_;

 public:
  std::vector<double> x, seen;

 private:
  CpgIntegrator integrator_;
  std::int64_t ticks_ = 0;
};

TEST(CpgFiles, TegotaeHasThePeriodOfItsClosedForm) {
  Alone slow("{type: tegotae, frequency: 0.5, sigma: 2, step: 0.001}");
  slow.load = {1};
  double last = 0;
  double period = 0;
  for (int k = 0; k < 4000; ++k) {
    const double before = slow.x[0];
    slow.tick();
    const double turns = std::floor(slow.x[0] / (2 * kPi));
    if (!(turns > std::floor(before / (2 * kPi)))) continue;
    const double at = slow.t() - 0.015 * (slow.x[0] - 2 * kPi * turns) / (slow.x[0] - before);  // linear within a tick
    if (last > 0) period = at - last;
    last = at;
  }
  EXPECT_NEAR(period, 2 * kPi / std::sqrt(kPi * kPi - 4), 2e-5);  // crossings by straight lines within a tick

  Alone held("{type: tegotae, frequency: 0.5, sigma: 4, step: 0.001}");
  held.load = {1};
  for (int k = 0; k < 2000; ++k) held.tick();
  EXPECT_NEAR(held.x[0], -std::acos(kPi / 4), 1e-10);
}

TEST(CpgFiles, PhaseResetTakesThePeriodOfTheContact) {
  Alone reset("{type: phase_reset, frequency: 0.5, step: 0.001}");
  std::vector<double> times, phases;
  for (int k = 0; k < 2000; ++k) {
    reset.load = {std::fmod(reset.t(), 1.7) < 0.85 && reset.t() > 1 ? 1.0 : 0.0};  // touchdowns at 1.7, 3.4 ...
    const double before = reset.x[0];
    reset.tick();
    if (reset.seen[0] >= before) continue;
    times.push_back(reset.t());
    phases.push_back(before);
  }
  ASSERT_GT(times.size(), 10U);
  for (std::size_t k = 1; k < times.size(); ++k) {
    EXPECT_NEAR(times[k] - times[k - 1], 1.7, 0.015 + 1e-9);  // a tick
    EXPECT_NEAR(phases[k], 1.7 * kPi, 0.015 * kPi + 1e-9);
  }
  EXPECT_NEAR(times.back() - times.front(), 1.7 * static_cast<double>(times.size() - 1), 0.015 + 1e-9);
}

TEST(CpgFiles, AnEventActsOnTheRisingEdgeAlone) {
  Alone clock(
      "{type: equations, step: 0.001, model: {states: {x: \"1\"}, output: x, events: [{when: t > 0.5, set: {x: \"0\"}}]}}");
  for (int k = 0; k < 100; ++k) clock.tick();
  EXPECT_NEAR(clock.x[0], 1.5 - 0.51, 1e-9);  // set once, at the first tick after 0.5 s; the condition stays true
  EXPECT_DOUBLE_EQ(clock.x[1], 1);            // event0.0

  Alone reset("{type: phase_reset, frequency: 0.5, step: 0.001}");
  reset.load = {3};
  for (int k = 0; k < 67; ++k) reset.tick();
  EXPECT_GT(reset.x[0], std::numbers::pi);  // the condition has two parts; both are true at the next tick, 1.005 s
  reset.tick();
  EXPECT_DOUBLE_EQ(reset.seen[0], 0);
}

TEST(CpgFiles, AdaptiveHopfLearnsTheFrequency) {
  Alone hopf("{type: adaptive_hopf, step: 0.001}", 0.001);
  // Time at which the average has this frequency: (nu0^2 - nu^2)/2 - 900 ln(nu0/nu) = eps^2 t/4.
  const auto when = [](double nu) { return ((1600 - nu * nu) / 2 - 900 * std::log(40 / nu)) * 4 / 9; };
  double low = 30;
  double high = 40;
  while (high - low > 1e-9) (when((low + high) / 2) > 10 ? low : high) = (low + high) / 2;
  double average = 0;
  for (int k = 0; k < 10500; ++k) {
    hopf.tick();
    if (k >= 9500) average += hopf.x[2] / 1000;  // nu swings about the average by eps/2/(nu + 30) and more
  }
  EXPECT_NEAR(average, low, 0.003 * low);  // the average is to second order in eps
  for (int k = 10500; k < 60000; ++k) hopf.tick();
  double mean = 0;
  for (int k = 0; k < 5000; ++k) {
    hopf.tick();
    mean += hopf.x[2] / 5000;
  }
  EXPECT_NEAR(mean, 30, 0.015);
}

TEST(CpgFiles, RighettiStopsWhileTheLegCarries) {
  Alone leg("{type: righetti_2008, frequency: 0.5, step: 0.001}", 0.001);
  leg.load = {5};
  for (int k = 0; k < 20000; ++k) leg.tick();
  EXPECT_NEAR(leg.x[0], -1, 1e-3);  // -sqrt(mu), the end of the stance; 1e-3: y crosses 0 in every tick of 1 ms
  EXPECT_NEAR(leg.x[1], 0, 1e-3);
  leg.load = {0};
  for (int k = 0; k < 20000; ++k) leg.tick();
  EXPECT_NEAR(leg.x[0], 1, 1e-3);  // the end of the swing, without contact
}

std::string with_files(const std::string& file, const std::string& section, const std::vector<std::string>& sets = {}) {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  folder.write("own.yaml", file);
  const std::string path = folder.write(
      "test.yaml", "gaitlab: 1\nrobot: {modules: mtran}\nphysics: {engine: articulated}\nduration: 1\ncpg: " + section + "\n");
  try {
    return resolved(read_scenario(path, sets, catalog()));
  } catch (const InputError& error) {
    std::string text = error.what();
    for (std::size_t at = 0; (at = text.find(path.substr(0, path.size() - 9))) != std::string::npos;)
      text.erase(at, path.size() - 9);
    return text;
  }
}

const std::string kRateFile =
    "gaitlab_cpg: 1\nparameters:\n  mu: {value: 2, unit: 1/s, low: 0, high: 10, about: Rate.}\n"
    "states: {phi: omega*mu}\noutput: amplitude*sin(phi)\n";

TEST(CpgFiles, ParametersAreKeysAndTheResolvedScenarioHasTheEquations) {
  const std::string text = with_files(kRateFile, "{type: ./own.yaml, mu: 3}");
  EXPECT_TRUE(contains(text, "type: equations")) << text;
  EXPECT_TRUE(contains(text, "mu: 3")) << text;
  EXPECT_TRUE(contains(with_files(kRateFile, "{type: own.yaml}"), "mu: 2"));
  EXPECT_TRUE(contains(with_files(kRateFile, "{type: ./own.yaml}", {"cpg.mu=4", "cpg.amplitude=0.2"}), "mu: 4"));
  EXPECT_TRUE(contains(with_files(kRateFile, "{type: ./own.yaml, mu: {default: 1, m0/active: 5}}"), "mu: [5, 1]"));
}

TEST(CpgFiles, ParametersInAtAreThoseOfTheFile) {
  const std::string change = "{type: ./own.yaml}\nat: [{t: 0.5, set: {cpg.mu: ";
  EXPECT_TRUE(contains(with_files(kRateFile, change + "5}}]"), "mu: 5\n"));
  EXPECT_TRUE(contains(with_files(kRateFile, change + "50}}]"), "mu is 50 1/s; expected 0 to 10"));
}

TEST(CpgFiles, AFileMayNameAnotherTypeAndDefaults) {
  const std::string file = "gaitlab_cpg: 1\ntype: sine\nfrequency: 0.7\nmodel: {ramp: 2}\n";
  const std::string text = with_files(file, "{type: ./own.yaml}");
  EXPECT_TRUE(contains(text, "type: sine") && contains(text, "frequency: 0.7") && contains(text, "ramp: 2")) << text;
  EXPECT_TRUE(contains(with_files(file, "{type: ./own.yaml, frequency: 0.3}"), "frequency: 0.3"));
  EXPECT_TRUE(contains(with_files("gaitlab_cpg: 1\ntype: sine\n", "{type: ./own.yaml}"), "missing key 'model'"));
}

TEST(CpgFiles, FaultsAreRefusedAtTheirPlace) {
  const auto refused = [](const std::string& file, const std::string& section, const std::string& text) {
    const std::string found = with_files(file, section);
    EXPECT_TRUE(contains(found, text)) << found;
  };
  refused(kRateFile, "{type: ./own.yaml, mu: 30}", "test.yaml:5:29: error: mu is 30 1/s; expected 0 to 10");
  refused(kRateFile, "{type: ./own.yaml, mu: fast}", "test.yaml:5:29: error: mu is 'fast'; expected a number");
  refused(kRateFile, "{type: ./other.yaml}", "other.yaml");
  refused(kRateFile, "{type: ./own.yaml, model: {states: {x: 1}}}", "model.states is stated by");
  refused(kRateFile, "{type: ./own.yaml, ampl: 1}", "unknown key 'ampl'; known parameters of the file: mu");
  refused(kRateFile, "{type: ./own.yaml, muu: 1}", "unknown key 'muu'; did you mean 'mu'?");
  refused("gaitlab_cpg: 1\nparameters: {step: {value: 1}}\nstates: {x: step}\noutput: x\n", "{type: ./own.yaml}",
          "own.yaml:2:14: error: 'step' is a key of cpg itself");
  refused("gaitlab_cpg: 2\nstates: {x: 1}\noutput: x\n", "{type: ./own.yaml}", "own.yaml:1:14");
  refused("gaitlab_cpg: 1\nstates: {x: 1}\n", "{type: ./own.yaml}", "output");
  refused("gaitlab_cpg: 1\nstates: {phi: omega*nu}\noutput: phi\n", "{type: ./own.yaml}",
          "own.yaml:2:21: error: 'nu' is unknown");
  refused("gaitlab_cpg: 1\nparameters: {omega: {value: 1}}\nstates: {x: 1}\noutput: x\n", "{type: ./own.yaml}",
          "has a fixed meaning");
  refused("gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\n", "{type: ./own.yaml}", "this is a scenario, not a CPG file");
}

TEST(CpgFiles, FaultsOfEventsAndInputs) {
  const auto refused = [](const std::string& model, const std::string& text) {
    const std::string found = with_files("", "{type: equations, model: " + model + "}");
    EXPECT_TRUE(contains(found, text)) << found;
  };
  refused("{states: {phi: omega}, output: phi, events: [{when: touching, set: {psi: 0}}]}",
          "event 0, set.psi: 'psi' is not a state");
  refused("{states: {phi: omega}, output: phi, events: [{when: touchng, set: {phi: 0}}]}",
          "event 0, when, character 1: 'touchng' is unknown; did you mean 'touching'?");
  refused("{states: {phi: omega}, output: phi, events: [{set: {phi: \"0\"}}]}", "no condition is given");
  refused("{states: {phi: omega}, output: phi, events: [{when: touching}]}", "nothing is set");
  refused("{states: {phi: omega}, output: phi, events: [{when: touching, set: {phi: \"0\"}, of: \"*/hip\"}]}", "*/hip");
  refused("{states: {phi: omega}, output: limb_load}",
          "'limb_load' may not be used in the output; only in a derivative or an event");
  refused("{states: {phi: imu.role}, output: phi}", "'imu.role' is unknown; no sensor of this scenario gives such values");
  refused("{states: {phi: \"mod(omega, 0)\"}, output: phi}", "mod(a, b): b must be above 0");
  refused("{states: {phi: omega}, output: phi, inputs: {phi: imu.roll}}", "'phi'");
}

/// Frequency of a state's crossings of 0 upwards from `from` on, rad/s.
double frequency(const Trace& trace, const std::string& column, double from) {
  const std::size_t c = trace.find(column);
  double first = 0;
  double last = 0;
  int count = -1;
  for (std::size_t k = 1; k < trace.rows(); ++k) {
    const double a = trace.at(k - 1, c);
    const double b = trace.at(k, c);
    if (trace.at(k, 0) < from || !(a < 0 && b >= 0)) continue;
    last = trace.at(k, 0) - (trace.at(k, 0) - trace.at(k - 1, 0)) * b / (b - a);
    if (++count == 0) first = last;
  }
  return 2 * kPi * count / (last - first);
}

const std::string kRod =
    "gaitlab: 1\nrobot: {modules: rod, base: fixed, position: [0, 0, 2]}\nground: {type: none}\n"
    "contact: {on: none}\nphysics: {engine: articulated, integrator: rk4, step: 0.001}\n";

TEST(CpgFiles, ResonanceIsLearned) {
  // A rod of 1 kg and 1 m on a motor that is a spring of 0.5 N m/rad: sqrt((m g l/2 + 0.5)/(m l^2/3)).
  const double oracle = std::sqrt((9.81 / 2 + 0.5) * 3);
  for (const double nu0 : {6.0, 3.0}) {
    const Recording record = run(scenario(
        kRod +
        fmt::format("actuator: {{type: dc_motor, R: 1, Kt: 0.2, Ks: 0.2, gear: 1, efficiency: 1, u_max: 100, i_max: 100}}\n"
                    "controller: {{type: pid, Kp: 2.5, Kd: 0, period: 0.005}}\nduration: 400\n"
                    "cpg: {{type: resonance, amplitude: 0.04, step: 0.001, nu0: {}}}\n"
                    "trace: {{columns: [\"cpg.*\"], period: 0.02}}\n",
                    nu0)));
    const std::size_t c = record.trace.find("cpg.nu.0");
    double mean = 0;
    for (std::size_t k = record.trace.rows() - 2500; k < record.trace.rows(); ++k) mean += record.trace.at(k, c) / 2500;
    EXPECT_NEAR(mean, oracle, 0.005 * oracle) << nu0;  // a swing of 0.12 rad and the tick lower it by 0.3 %
  }
}

TEST(CpgFiles, MatsuokaFollowsTheBody) {
  // rad/s at k = 0 1 2 4 6; an independent simulation gave these numbers of the same model.
  const std::vector<std::pair<double, double>> rows{{0, 7.040}, {1, 6.872}, {2, 6.725}, {4, 6.581}, {6, 6.599}};
  for (const auto& [k, expected] : rows) {
    const Recording record = run(scenario(
        kRod +
        fmt::format("actuator: {{type: torque}}\ncontroller: {{type: pid, unit: N m, Kp: 2, Kd: 0.1, N: 1000, period: 0.005}}\n"
                    "duration: 40\ncpg: {{type: matsuoka_feedback, amplitude: 1, step: 0.001, k: {}}}\n"
                    "trace: {{columns: [joint.0.setpoint], period: 0.01}}\n",
                    k)));
    EXPECT_NEAR(frequency(record.trace, "joint.0.setpoint", 15), expected, 0.005)
        << k;  // found: within 4e-4, but 7.0431 for 7.040
  }
}

}  // namespace
}  // namespace gaitlab::test
