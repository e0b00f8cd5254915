// Requirements that every registered CPG, controller and actuator must satisfy.
#include <cmath>
#include <limits>
#include <map>

#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "core/settings/wording.h"
#include "tests/program/allocations.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

struct Plugin {
  Kind kind;
  std::string name;
};

std::string section(Kind kind) { return kind == Kind::cpg ? "cpg" : kind == Kind::controller ? "controller" : "actuator"; }

std::vector<Plugin> registered() {
  const Catalog all = app::standard_catalog();
  std::vector<Plugin> plugins;
  for (const Kind kind : {Kind::cpg, Kind::controller, Kind::actuator}) {
    for (const std::string& name : all.names(kind)) plugins.push_back({kind, name});
  }
  return plugins;
}

/// Lists all numbers of a Settings struct with their paths, except numbers in lists of structs.
class Numbers final : public Fields {
 public:
  struct Found {
    double value;
    Spec spec;
    bool whole;
  };
  std::map<std::string, Found> found;
  std::vector<std::string> empty_abouts, required;
  std::vector<std::string> not_stated;  ///< ratings with the value 0, and words, which may be outside the range

  void visit(const Field& field) override {
    if (std::string_view(field.about).size() < 4 || !std::string_view(field.about).ends_with('.')) {
      empty_abouts.push_back(prefix_ + field.key);
    }
    const auto note = [&](double value, const Spec& spec, bool whole) {
      found.emplace(prefix_ + field.key, Found{value, spec, whole});
    };
    if (const auto* one = std::get_if<field::Number>(&field.value)) note(one->value, one->spec, false);
    if (const auto* one = std::get_if<field::NumberOr>(&field.value)) {
      note(one->value, one->spec, false);
      if (one->value == 0) not_stated.push_back(prefix_ + field.key);  // the word
    }
    if (const auto* one = std::get_if<field::Integer>(&field.value)) note(static_cast<double>(one->value), one->spec, true);
    if (const auto* one = std::get_if<field::EachJoint>(&field.value)) {
      note(field::in_force(*one).common, one->spec, false);
      if (one->role == field::Role::required) required.push_back(prefix_ + field.key);
      if (one->role == field::Role::rating && one->value == PerJoint()) not_stated.push_back(prefix_ + field.key);
    }
    if (const auto* one = std::get_if<field::Group>(&field.value)) {
      const std::string before = prefix_;
      prefix_ += std::string(field.key) + ".";
      one->visit(one->self, *this);
      prefix_ = before;
    }
  }
  void problem_at(const char* key, std::string_view, std::size_t, std::string_view what) override {
    ADD_FAILURE() << key << ": " << what;
  }

 private:
  std::string prefix_;
};

Numbers numbers_of(const Entry& entry, void* settings) {
  Numbers numbers;
  entry.fields(settings, numbers);
  return numbers;
}

/// CPGs that have the settings common to oscillators.
std::vector<Plugin> oscillators() {
  std::vector<Plugin> some;
  for (const Plugin& plugin : registered()) {
    const Entry& entry = *catalog().find(plugin.kind, plugin.name);
    if (plugin.kind == Kind::cpg && numbers_of(entry, entry.settings(entry).get()).found.contains("phase_lag"))
      some.push_back(plugin);
  }
  return some;
}

std::vector<Plugin> actuators() {
  std::vector<Plugin> some = registered();
  std::erase_if(some, [](const Plugin& plugin) { return plugin.kind != Kind::actuator; });
  return some;
}

class Contract : public ::testing::TestWithParam<Plugin> {
 protected:
  [[nodiscard]] const Entry& entry() const { return *catalog().find(GetParam().kind, GetParam().name); }

  /// Text of a scenario with the plugin and with the further sections `more`.
  [[nodiscard]] std::string text(const std::string& own, const std::string& more = {}) const {
    const bool walks = GetParam().kind == Kind::cpg;  // some gaits require legs
    return "gaitlab: 1\nrobot: {modules: mtran" + std::string(walks ? ", build: robots/hexapod.dat" : "") +
           "}\nduration: 0.06\n" + own + more;
  }
  /// Text of a scenario in which the plugin has only its required settings.
  [[nodiscard]] std::string plain() const {
    const auto& [kind, name] = GetParam();
    std::string own = section(kind) + ": {type: " + name;
    // All required numbers are 1e-7: with a stall torque this small, no stall current above 0 requires an efficiency above 1.
    for (const std::string& key : numbers_of(entry(), entry().settings(entry()).get()).required) own += ", " + key + ": 1e-7";
    own += "}\n";
    const bool volts = kind != Kind::actuator || name == "dc_motor" || name == "servo";
    return text(own, volts ? "" : "controller: {type: pid, unit: N m, Kp: 5, Kd: 0.05}\n");
  }
  [[nodiscard]] const PluginSelection& choice(const Scenario& s) const {
    return GetParam().kind == Kind::cpg ? s.cpg : GetParam().kind == Kind::controller ? s.controller : s.actuator;
  }
  static std::unique_ptr<Cpg> make_cpg(const Scenario& s) {
    const void* settings = s.cpg.settings.get();
    return std::unique_ptr<Cpg>(static_cast<Cpg*>(s.cpg.entry->make(info(*s.robot), {&settings, 1})));
  }
};

TEST_P(Contract, ExplainsItself) {
  const std::string manual(entry().manual);
  EXPECT_NE(manual.find("\n    "), std::string::npos) << "no indented equation";
  EXPECT_TRUE(manual.find("Source: ") != std::string::npos || manual.find("Reference: ") != std::string::npos) << manual;
  EXPECT_NE(manual.find("\n    " + section(GetParam().kind) + ":"), std::string::npos) << "no minimal scenario";
  EXPECT_LT(manual.find(" = "), manual.find("\n    " + section(GetParam().kind) + ":")) << "no equation";
  const Numbers numbers = numbers_of(entry(), entry().settings(entry()).get());
  EXPECT_EQ(numbers.empty_abouts, std::vector<std::string>{}) << "fields need a sentence";
  for (const auto& [path, number] : numbers.found) {
    const std::string& name = path;  // clang 14 captures no binding
    const auto lists = [&](const std::vector<std::string>& paths) { return std::ranges::find(paths, name) != paths.end(); };
    if (lists(numbers.required) || lists(numbers.not_stated)) continue;
    EXPECT_TRUE(number.value >= number.spec.min && number.value <= number.spec.max) << path << ": default out of range";
  }
}

TEST_P(Contract, LoadsFromNothing) {
  const Scenario s = scenario(plain());
  EXPECT_EQ(choice(s).entry->name, GetParam().name);
}

TEST_P(Contract, TheManualsScenarioRuns) {
  const std::string manual(entry().manual);
  const std::size_t begin = manual.find("\n    " + section(GetParam().kind) + ":");
  std::istringstream lines(manual.substr(begin + 1));
  std::string own;
  for (std::string line; std::getline(lines, line);) own += line.substr(std::min<std::size_t>(4, line.size())) + "\n";
  // The examples of the manuals refer to joints of at most two modules. CPGs get a robot with legs.
  const std::string body = GetParam().kind == Kind::cpg
                               ? text(own)
                               : "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.06\n" + own;
  const Recording record = run(scenario(body));
  EXPECT_EQ(record.trace.rows(), 13U);
}

TEST_P(Contract, EveryNumberIsReachedAndRefusesNan) {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  std::filesystem::create_directory_symlink(kScenarios + "robots", folder / "robots");
  const std::string path = folder.write("s.yaml", plain());
  const Numbers defaults = numbers_of(entry(), entry().settings(entry()).get());
  for (const auto& [key, number] : defaults.found) {
    const std::string full = section(GetParam().kind) + "." + key;
    EXPECT_THROW((void)read_scenario(path, {full + "=.nan"}, catalog()), InputError) << full;
    // The value differs only slightly from the default, so that checks between several settings still pass.
    const double away = number.whole ? 1 : 1e-3 * std::max(1e-3, std::abs(number.value));
    const double near = number.value + away <= number.spec.max ? number.value + away : number.value - away;
    const double other = std::max(near, number.spec.min);
    const Scenario s = read_scenario(path, {full + "=" + number_text(other)}, catalog());
    EXPECT_EQ(numbers_of(*choice(s).entry, choice(s).settings.get()).found.at(key).value, other) << full;
    EXPECT_NE(resolved(s).find(number_text(other)), std::string::npos) << full;
  }
}

/// Integrates a CPG by RK4 as the program does. It allocates only in the constructor.
struct Host {
  explicit Host(const Cpg& c, std::size_t joints)
      : cpg(c), x(c.states()), at(x.size()), k{at, at, at, at}, setpoint(joints), zeros(joints, 0.0) {
    cpg.start(x);
  }
  void tick() {
    const Measured m{static_cast<double>(ticks) * kTick, kTick, zeros, zeros, zeros, zeros};
    cpg.event(m, x);
    cpg.output(m.t, x, setpoint);
    for (std::size_t stage = 0; stage < 4; ++stage) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        at[i] = stage == 0 ? x[i] : x[i] + (stage == 3 ? kTick : kTick / 2) * k[stage - 1][i];
      }
      cpg.derivative(m, at, k[stage]);
    }
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += kTick / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
    ++ticks;
  }
  static constexpr double kTick = 0.015;
  const Cpg& cpg;
  std::vector<double> x, at;
  std::array<std::vector<double>, 4> k;
  std::vector<double> setpoint, zeros;
  long ticks = 0;
};

TEST_P(Contract, SameBitsTwiceAndStatesGoRound) {
  const Scenario s = scenario(plain());
  if (GetParam().kind == Kind::cpg) {
    const auto first = make_cpg(s);
    const auto second = make_cpg(s);
    const std::size_t joints = s.robot->joints.size();
    Host a(*first, joints), b(*second, joints), later(*second, joints);
    for (int i = 0; i < 100; ++i) a.tick();
    later.x = a.x;
    later.ticks = a.ticks;
    for (int i = 0; i < 100; ++i) a.tick();
    for (int i = 0; i < 200; ++i) b.tick();
    for (int i = 0; i < 100; ++i) later.tick();
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.setpoint, b.setpoint);
    EXPECT_EQ(a.x, later.x);
    EXPECT_EQ(a.setpoint, later.setpoint);
    return;
  }
  Simulation a({&s, 1}), b({&s, 1}), later({&s, 1});
  for (int i = 0; i < 1000; ++i) a.step();
  std::copy(a.state().begin(), a.state().end(), later.state().begin());
  for (int i = 0; i < 1000; ++i) a.step();
  for (int i = 0; i < 2000; ++i) b.step();
  for (int i = 0; i < 1000; ++i) later.step();
  EXPECT_TRUE(std::equal(a.state().begin(), a.state().end(), b.state().begin()));
  EXPECT_TRUE(std::equal(a.state().begin(), a.state().end(), later.state().begin()));
}

class ActuatorContract : public Contract {};

TEST_P(ActuatorContract, WithoutItsLimitTheLawIsTheSameOrMore) {
  for (const char* model : {"", ", efficiency_model: directional"}) {
    const bool dc_motor = GetParam().name == "dc_motor";
    const bool motor = dc_motor || GetParam().name == "servo";
    const Scenario s = dc_motor ? scenario(text("actuator: {type: dc_motor" + std::string(model) + "}\n")) : scenario(plain());
    const void* settings = s.actuator.settings.get();
    const std::unique_ptr<Actuator> actuator(static_cast<Actuator*>(s.actuator.entry->make(info(*s.robot), {&settings, 1})));
    int limited = 0;
    for (int i = -12; i <= 12; ++i) {
      for (int k = -12; k <= 12; ++k) {
        const double command = 0.75 * i, speed = 0.5 * k;
        const std::vector<double> u(2, command), w(2, speed);
        std::vector<double> torque(2), slope(2), more(2), steeper(2);
        actuator->effort(u, w, torque, slope);
        actuator->unlimited(u, w, more, steeper);
        EXPECT_GE(std::abs(more[0]), std::abs(torque[0])) << command << " V at " << speed;
        EXPECT_GE(torque[0] * more[0], 0);
        EXPECT_GE(steeper[0], slope[0]);
        if (more[0] == torque[0]) {
          EXPECT_EQ(steeper[0], slope[0]);
        }
        limited += more[0] != torque[0] ? 1 : 0;
      }
    }
    EXPECT_EQ(limited > 0, motor);
  }
}

TEST_P(Contract, AllocatesNothing) {
  const Scenario s = scenario(plain());
  if (GetParam().kind == Kind::cpg) {
    const auto cpg = make_cpg(s);
    Host host(*cpg, s.robot->joints.size());
    const Allocations allocations;
    for (int i = 0; i < 10; ++i) host.tick();
    EXPECT_EQ(allocations.count(), 0);
    return;
  }
  Simulation simulation({&s, 1});
  for (int i = 0; i < 1400; ++i) simulation.step();  // during the first ticks and contacts, Bullet allocates its buffers
  const Allocations allocations;
  for (int i = 0; i < 700; ++i) simulation.step();
  EXPECT_EQ(allocations.count(), 0);
}

/// Times after `from` at which the set point of a joint rises through its mean, and the extremes of the set point.
struct Cycle {
  std::vector<double> rises;
  double lo = std::numeric_limits<double>::infinity(), hi = -lo, before = 0;
};

std::vector<Cycle> cycles(const Cpg& cpg, const std::vector<double>& mean, double from, double until) {
  std::vector<Cycle> joints(mean.size());
  Host host(cpg, mean.size());
  while (static_cast<double>(host.ticks) * Host::kTick < until) {
    const double t = static_cast<double>(host.ticks) * Host::kTick;
    host.tick();
    for (std::size_t j = 0; j < joints.size(); ++j) {
      Cycle& c = joints[j];
      const double q = host.setpoint[j] - mean[j];
      if (t > from) {
        c.lo = std::min(c.lo, q);
        c.hi = std::max(c.hi, q);
        if (c.before < 0 && q >= 0) c.rises.push_back(t - Host::kTick * q / (q - c.before));
      }
      c.before = q;
    }
  }
  return joints;
}

void expect_common_keys(const std::string& type, double f, double lag, const std::string& rule) {
  SCOPED_TRACE(fmt::format("{} at {} Hz, lag {}, {}", type, f, lag, rule));
  const Scenario s =
      scenario(fmt::format("gaitlab: 1\nrobot: {{modules: mtran, docks: [[1, 1, 4, 0, 0]]}}\nduration: 1\n"
                           "cpg: {{type: {}, frequency: {}, amplitude: [0.5, 0.2, 0.6, 0.3], offset: [0.1, -0.2, 0, 0.3], "
                           "phase_lag: {}, couplings: {}}}\n",
                           type, f, lag, rule));
  const void* settings = s.cpg.settings.get();
  const std::unique_ptr<Cpg> cpg(static_cast<Cpg*>(s.cpg.entry->make(info(*s.robot), {&settings, 1})));
  const double amplitude[] = {0.5, 0.2, 0.6, 0.3};
  const std::vector<double> mean{0.1, -0.2, 0, 0.3};
  const std::vector<Cycle> joints = cycles(*cpg, mean, 16, 16 + 4 / f);
  for (std::size_t j = 0; j < 4; ++j) {
    const Cycle& c = joints[j];
    ASSERT_GE(c.rises.size(), 3U) << j;
    const double period = (c.rises.back() - c.rises.front()) / static_cast<double>(c.rises.size() - 1);
    EXPECT_NEAR(period * f, 1, 0.01) << j;  // tolerance of the plugin interface for CPGs
    EXPECT_NEAR((c.hi - c.lo) / 2, amplitude[j], 0.02 * amplitude[j]) << j;
    if (j == 0) continue;
    const double lead = 2 * std::numbers::pi * f * (joints[j - 1].rises[1] - c.rises[1]);
    EXPECT_NEAR(std::remainder(lead - lag, 2 * std::numbers::pi), 0, 0.02) << j;
  }
}

class OscillatorContract : public Contract {};

TEST_P(OscillatorContract, RealisesTheCommonKeys) {
  const std::string& type = GetParam().name;
  expect_common_keys(type, 0.25, 1.2, "chain");
  expect_common_keys(type, 1, -0.7, "parent");
  expect_common_keys(type, 0.5, 0.4, "all");
  expect_common_keys(
      type, 0.5, 0.9,
      "[{from: 0, to: 1, phase_lag: 0.9}, {from: 1, to: 2, phase_lag: 0.9, weight: 2}, {from: 2, to: 3, phase_lag: 0.9}]");
}

TEST_P(OscillatorContract, RunsOnARobotWithoutJoints) {
  const Scenario s = scenario(
      "gaitlab: 1\nrobot: {modules: {name: rigid, bodies: {block: {mass: 1, com: [0, 0, 0], inertia: [1, 1, 1, 0, 0, 0]}}}}\n"
      "contact: {on: none}\ntrace: {columns: [base.*]}\nduration: 0.06\ncpg: {type: " +
      GetParam().name + "}\n");
  EXPECT_EQ(run(s).trace.rows(), 13U);
}

std::string shown(const ::testing::TestParamInfo<Plugin>& param) { return section(param.param.kind) + "_" + param.param.name; }

INSTANTIATE_TEST_SUITE_P(Every, Contract, ::testing::ValuesIn(registered()), shown);
INSTANTIATE_TEST_SUITE_P(Every, ActuatorContract, ::testing::ValuesIn(actuators()), shown);
INSTANTIATE_TEST_SUITE_P(Every, OscillatorContract, ::testing::ValuesIn(oscillators()), shown);

}  // namespace
}  // namespace gaitlab::test
