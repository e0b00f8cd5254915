// Tests of the CPG `equations`: values of expressions agree with the C library and an independent evaluation, and a model
// agrees with the built-in phase oscillator.
#include "cpg/equations.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/math/functions.h"
#include "cpg/phase_oscillator.h"

namespace gaitlab::test {
namespace {

using namespace cpg;

/// Robot with a tree of four joints, 0 - 1 - 2 and 0 - 3. Joint 2 is on the left, joint 3 on the right.
RobotInfo robot() {
  RobotInfo robot;
  for (const std::int64_t parent : {-1, 0, 1, 0}) {
    JointInfo joint;
    joint.name = "j" + std::to_string(robot.joints.size());
    joint.module = parent == -1 ? 1 : 0;
    joint.parent = parent;
    joint.lo = -1.6;
    joint.hi = 1.6;
    robot.joints.push_back(joint);
  }
  robot.joints[2].origin = {0, 0.1, 0};
  robot.joints[3].origin = {0, -0.1, 0};
  robot.modules.resize(2);
  return robot;
}

/// Settings of a model without states, with this output.
Equations::Settings only(const std::string& output) {
  Equations::Settings s;
  s.model.states.clear();
  s.model.initial.clear();
  s.model.output = output;
  return s;
}

std::vector<double> values(const Equations::Settings& s, double t = 0.5) {
  const Equations cpg(robot(), s);
  std::vector<double> x(cpg.states()), out(4);
  cpg.start(x);
  cpg.output(t, x, out);
  return out;
}

double value(const std::string& text) { return values(only(text))[0]; }

TEST(EquationValues, FunctionsAndOperators) {
  const double x = 0.7;
  const double y = -1.3;
  const std::array<std::pair<const char*, double>, 41> cases{{
      {"sin(0.7)", std::sin(x)},
      {"cos(0.7)", std::cos(x)},
      {"tan(0.7)", std::tan(x)},
      {"tanh(0.7)", std::tanh(x)},
      {"exp(-1.3)", std::exp(y)},
      {"log(0.7)", std::log(x)},
      {"sqrt(0.7)", std::sqrt(x)},
      {"abs(-1.3)", 1.3},
      {"sign(-1.3) + 10*sign(0) + 100*sign(0.7)", 99},
      {"min(0.7, -1.3) + max(2, 3)", 1.7},
      {"clamp(-1.3, -1, 1) + clamp(0.7, -1, 1) + clamp(5, -1, 1)", 0.7},
      {"if(1 < 2, 3, 4)", 3},
      {"if(2 < 1, 3, 4)", 4},
      {"if(0, 1/0, 4)", 4},  // the value that is not selected has no effect
      {"mod(-1.3, 1) + 10*mod(0.7, 2)", 7.7},
      {"pi", std::numbers::pi},
      {"t", 0.5},
      {"1 + 2*3", 7},
      {"(1 + 2)*3", 9},
      {"7 - 2 - 1", 4},
      {"8/4/2", 1},
      {"2^3^2", 512},
      {"-2^2", -4},
      {"2^-1", 0.5},
      {"(-3)^2", 9},  // computed as a product, because the logarithm of -3 does not exist
      {"2*-3", -6},
      {"- - 3", 3},
      {"+3", 3},
      {"--t^2", 0.25},
      {"1 < 2", 1},
      {"(1 <= 1) + 2*(1 >= 2) + 4*(2 > 1) + 8*(1 == 1) + 16*(1 != 1)", 13},
      {"1 < 2 and 2 < 1", 0},
      {"1 < 2 or 2 < 1", 1},
      {"not 1 < 2", 0},
      {"not not 5", 1},
      {"1 or 0 and 0", 1},  // `and` has precedence over `or`
      {"1.5e3 + .5 + 2. + 1E-1", 1502.6},
      {"1+1 < 3", 1},
      {" 1\n + 1 ", 2},
      {"phase[i] + index[i]", 0},
      {"sum(j in neighbours, 1)", 0},  // joint 0 follows no joint
  }};
  for (const auto& [text, expected] : cases) EXPECT_DOUBLE_EQ(value(text), expected) << text;  // within 4 ulp
}

TEST(EquationValues, WhatIsNoNumberGoesThrough) {
  for (const char* text : {"log(-1)", "0/0", "min(0/0, 1)", "min(1, 0/0)", "max(0/0, 1)", "max(1, 0/0)", "sign(0/0)",
                           "clamp(0/0, 0, 1)", "abs(0/0)", "sqrt(-1)", "(0/0)^2", "0*log(0)"}) {
    EXPECT_TRUE(std::isnan(value(text))) << text;
  }
  EXPECT_EQ(value("1/0"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(value("log(0)"), -std::numeric_limits<double>::infinity());
}

TEST(EquationValues, WhatIsGivenOfJointAndTree) {
  Equations::Settings s = only("0");
  s.frequency.each = {0.1, 0.2, 0.3, 0.4};
  s.offset.each = {0, 0.1, 0.2, 0.3};
  s.rule = CouplingRule::parent;
  const auto of = [&](const std::string& text) {
    s.model.output = text;
    return values(s);
  };
  using V = std::vector<double>;
  EXPECT_EQ(of("frequency"), (V{0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(of("omega/frequency - 2*pi"), (V{0, 0, 0, 0}));
  EXPECT_EQ(of("amplitude + offset"), (V{0.6, 0.6 + 0.1, 0.6 + 0.2, 0.6 + 0.3}));
  EXPECT_EQ(of("phase"), (V{0, 1.2, 2.4, 1.2}));
  EXPECT_EQ(of("index + 10*joints"), (V{40, 41, 42, 43}));
  EXPECT_EQ(of("depth"), (V{0, 1, 2, 1}));
  EXPECT_EQ(of("side"), (V{0, 0, 1, -1}));
  EXPECT_EQ(of("sum(j in neighbours, index[j])"), (V{0, 0, 1, 0}));
  EXPECT_EQ(of("sum(j in neighbours, 100*w[i,j] + 10*index[i] + index[j] + index)"), (V{0, 111, 123, 133}));
  EXPECT_EQ(of("sum(j in neighbours, psi[i,j])"), (V{0, -1.2, -1.2, -1.2}));
  EXPECT_EQ(of("sum(j in neighbours, t)*2 + sum(j in neighbours, pi)/pi"), (V{0, 2, 2, 2}));
}

TEST(EquationValues, ParametersAreNumbersListsAndTextsOfTheTree) {
  Equations::Settings s = only("a + b*c");
  s.model.parameters = {
      {"a", "", {1000}}, {"b", "", {0, {1, 2, 3, 4}}}, {"c", "10*depth + a/1000 + sum(j in neighbours, b[j])"}};
  EXPECT_EQ(values(s), (std::vector<double>{1001, 1000 + 2 * 12., 1000 + 3 * 23., 1000 + 4 * 14.}));
}

/// Random expression that grows step by step, with its values for each joint (or coupling), computed independently.
class RandomText {
 public:
  explicit RandomText(unsigned seed) : random_(seed) {}
  struct Grown {
    std::string text;
    std::vector<double> values;
  };
  Grown grow(int levels, bool in_sum = false) {
    const auto what = levels == 0 ? 100 : random_() % 12;
    const auto inner = [&] { return grow(levels - 1, in_sum); };
    if (what == 0) return one("sin(", inner(), [](double x) { return math::sin(x); });
    if (what == 1) return one("abs(", inner(), [](double x) { return std::abs(x); });
    if (what == 2) return one("-(", inner(), [](double x) { return -x; });
    if (what == 3) return one("2*(", inner(), [](double x) { return 2 * x; });
    if (what == 4) return two(inner(), " + ", inner(), [](double x, double y) { return x + y; });
    if (what == 5) return two(inner(), " - ", inner(), [](double x, double y) { return x - y; });
    if (what == 6) return two(inner(), "*", inner(), [](double x, double y) { return x * y; });
    if (what == 7) return two(inner(), " < ", inner(), [](double x, double y) { return x < y ? 1. : 0.; });
    if (what == 8) return square(inner());
    if (what == 9) return choose(inner(), inner(), inner());
    if (what == 10 && !in_sum) return sum(grow(levels - 1, true));
    return leaf(in_sum);
  }

  const std::vector<Coupling> couplings{{0, 1, 0.5, 1}, {0, 2, 2, -1}, {3, 1, 1, 0.5},
                                        {1, 0, -1, 2},  {0, 1, 3, 0},  {2, 3, 1, 1}};
  const std::vector<double> state{0.3, -0.7, 1.1, 0.2};
  static constexpr double kTime = 0.45;

 private:
  template <class F>
  static Grown one(const std::string& before, Grown a, F f) {
    for (double& x : a.values) x = f(x);
    return {before + a.text + ")", a.values};
  }
  template <class F>
  static Grown two(Grown a, const std::string& sign, const Grown& b, F f) {
    for (std::size_t k = 0; k < a.values.size(); ++k) a.values[k] = f(a.values[k], b.values[k]);
    return {"(" + a.text + sign + b.text + ")", a.values};
  }
  static Grown square(Grown a) {
    for (double& x : a.values) x = x * x;
    return {"(" + a.text + ")^2", a.values};
  }
  static Grown choose(const Grown& c, Grown a, const Grown& b) {
    for (std::size_t k = 0; k < a.values.size(); ++k) a.values[k] = c.values[k] != 0 ? a.values[k] : b.values[k];
    return {"if(" + c.text + ", " + a.text + ", " + b.text + ")", a.values};
  }
  Grown sum(const Grown& a) const {
    std::vector<double> total(4, 0.0);
    for (std::size_t k = 0; k < couplings.size(); ++k) total[static_cast<std::size_t>(couplings[k].to)] += a.values[k];
    return {"sum(j in neighbours, " + a.text + ")", total};
  }
  Grown leaf(bool in_sum) {
    const auto what = random_() % (in_sum ? 8 : 4);
    if (what == 0) return {"t", std::vector<double>(in_sum ? couplings.size() : 4, kTime)};
    if (what == 1) return {"0.7", std::vector<double>(in_sum ? couplings.size() : 4, 0.7)};
    const std::vector<double> own = what == 2 || what == 4 ? state : std::vector<double>{0, 1, 2, 3};
    const std::string name = what == 2 || what == 4 ? "s" : "index";
    if (!in_sum) return {name, own};
    Grown grown{what == 6 ? "w[i,j]" : what == 7 ? "psi[i,j]" : what < 4 ? name : name + "[j]", {}};
    for (const Coupling& c : couplings) {
      grown.values.push_back(what == 6   ? c.weight
                             : what == 7 ? -c.phase_lag
                                         : own[static_cast<std::size_t>(what < 4 ? c.to : c.from)]);
    }
    return grown;
  }
  std::mt19937 random_;
};

TEST(EquationValues, ThousandsOfRandomTexts) {
  for (unsigned seed = 0; seed < 3000; ++seed) {
    RandomText random(seed);
    const RandomText::Grown grown = random.grow(6);
    Equations::Settings s;
    s.rule = std::nullopt;
    s.couplings = random.couplings;
    s.model.states = {{"s", "0"}};
    s.model.initial.clear();
    s.model.output = grown.text;
    if (grown.text.size() > 3000) continue;
    std::vector<double> out(4);
    try {
      Equations(robot(), s).output(RandomText::kTime, random.state, out);
    } catch (const std::invalid_argument& e) {
      ASSERT_NE(std::string(e.what()).find("more than 500"), std::string::npos) << e.what() << "\n" << grown.text;
      continue;
    }
    ASSERT_EQ(out, grown.values) << grown.text;  // identical bits, because the operations are the same
  }
}

/// Integrates a CPG by RK4, as the program does.
struct Walk {
  Walk(const Cpg& c) : cpg(c), x(c.states()), setpoint(4) { cpg.start(x); }
  void step(double h) {
    std::vector<double> k[4], at = x;
    const std::array<double, 4> zero{};
    const Measured m{0, h, zero, zero, zero, zero};
    for (int stage = 0; stage < 4; ++stage) {
      k[stage].resize(x.size());
      for (std::size_t i = 0; stage > 0 && i < x.size(); ++i) at[i] = x[i] + (stage == 3 ? h : h / 2) * k[stage - 1][i];
      cpg.derivative(m, at, k[stage]);
    }
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
    cpg.output(0, x, setpoint);
  }
  const Cpg& cpg;
  std::vector<double> x, setpoint;
};

/// Largest difference of states and set points of both CPGs during 4 s.
double difference(const PhaseOscillator::Settings& native, const Equations::Settings& own) {
  const PhaseOscillator a(robot(), native);
  const Equations b(robot(), own);
  EXPECT_EQ(a.note(), b.note());
  EXPECT_EQ(a.states(), b.states());
  for (std::size_t i = 0; i < a.states(); ++i) EXPECT_EQ(a.state_name(i), b.state_name(i));
  Walk left(a), right(b);
  double worst = 0;
  for (int k = 0; k <= 267; ++k) {
    for (std::size_t i = 0; i < left.x.size(); ++i) worst = std::max(worst, std::abs(left.x[i] - right.x[i]));
    for (std::size_t j = 0; j < 4; ++j) worst = std::max(worst, std::abs(left.setpoint[j] - right.setpoint[j]));
    left.step(0.015);
    right.step(0.015);
  }
  EXPECT_GT(std::abs(left.x[0]), 0.1);
  return worst;
}

void expect_native(const OscillatorKeys& keys, bool weighted = false) {
  PhaseOscillator::Settings native;
  Equations::Settings own;
  static_cast<OscillatorKeys&>(native) = keys;
  static_cast<OscillatorKeys&>(own) = keys;
  native.model.amplitude_weighted = weighted;
  native.model.coupling = own.model.coupling = 1.7;
  native.model.amplitude_rate = 3;
  own.model.parameters = {{"a_r", "", {3}}};
  own.model.states[1].text = "a_r*(amplitude - r)";
  if (weighted) own.model.states[0].text = "omega + sum(j in neighbours, w[i,j]*r[j]*sin(phi[j] - phi[i] - psi[i,j]))";
  EXPECT_LT(difference(native, own), 1e-12);  // required; another order of sums gives some ulp, which the network damps
}

TEST(Equations, AreTheNativePhaseOscillator) {
  OscillatorKeys keys;
  expect_native(keys);
  expect_native(keys, true);
  keys.frequency.each = {0.2, 0.25, 0.3, 0.5};
  keys.amplitude.each = {0.6, 0.1, 0.3, 0};
  keys.offset.each = {0.1, -0.2, 0, 0.4};
  keys.phase_lag.each = {0, 1.2, -0.7, 2};
  for (const auto rule :
       {CouplingRule::chain, CouplingRule::parent, CouplingRule::siblings, CouplingRule::mirror, CouplingRule::all}) {
    keys.rule = rule;
    expect_native(keys);
  }
  keys.rule = std::nullopt;
  keys.couplings = {{3, 1, 0.5, 1}, {0, 1, 2, 0.3}, {1, 0, 1, -0.3}, {0, 1, 0.25, 0.3}, {2, 0, -1, 0.1}, {1, 2, 1, 1}};
  expect_native(keys);
  expect_native(keys, true);
}

TEST(Equations, HearTheSensors) {
  Equations::Settings s;
  s.model.states = {{"y", "angle + 10*speed + 100*torque[i] + 1000*touching + 1e4*sum(j in neighbours, angle[j]*touching[j])"}};
  s.model.initial = {{"y", "index"}};
  s.model.output = "y";
  const Equations cpg(robot(), s);
  const std::array<double, 4> angle{1, 2, 3, 4}, speed{5, 6, 7, 8}, torque{9, 8, 7, 6};
  const std::array<double, 2> touching{0, 1};  // only the module of joint 0 touches the ground
  std::vector<double> rate(4), x(4);
  cpg.derivative({0, 0.015, angle, speed, torque, touching}, x, rate);
  EXPECT_EQ(rate, (std::vector<double>{1951, 862 + 1e4, 773, 684}));
  cpg.start(x);
  EXPECT_EQ(x, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(cpg.state_name(2), "y.2");
}

TEST(Equations, AStateWithoutAnInitialValueStartsAtZeroAndTimeRuns) {
  Equations::Settings s;
  s.model.states = {{"a", "1"}, {"b", "a"}};
  s.model.initial.clear();
  s.model.output = "b - t";
  const Equations cpg(robot(), s);
  Walk run(cpg);
  EXPECT_EQ(run.x, std::vector<double>(8, 0.0));
  for (int k = 0; k < 100; ++k) run.step(0.01);
  EXPECT_NEAR(run.x[0], 1, 1e-14);    // rounding errors of 100 sums up to 1
  EXPECT_NEAR(run.x[4], 0.5, 1e-14);  // RK4 is exact for t^2 / 2
}

TEST(Equations, InCodeAreRefusedInOneSentence) {
  Equations::Settings s;
  s.model.output = "x + y";
  try {
    const Equations cpg(robot(), s);
    ADD_FAILURE() << "made";
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()).substr(0, 50), "model.output, character 5: 'y' is unknown; known n");
  }
}

}  // namespace
}  // namespace gaitlab::test
