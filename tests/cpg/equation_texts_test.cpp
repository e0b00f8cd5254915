// Tests of the CPG `equations` in scenarios: messages with the position of the error, and expressions in the resolved scenario.
#include <gtest/gtest.h>

#include <array>
#include <sstream>

#include "core/scenario/resolved.h"
#include "cpg/equations.h"
#include "tests/core/scenario/fixture.h"

namespace gaitlab::test {
namespace {

using namespace cpg;

class EquationTexts : public fakes::ScenarioTest {
 protected:
  EquationTexts() { add_cpg<Equations>(catalog_, "equations", Equations::kManual); }

  /// Messages on these lines of a model. Their first line is line 7 of the scenario.
  std::string wrong(const std::string& lines, const std::vector<std::string>& sets = {}) {
    std::string text = fakes::kTwo + "cpg:\n  type: equations\n  model:\n";
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) text += "    " + line + "\n";
    const std::string all = error(text, sets);
    return all.starts_with("DIR/s.yaml:") ? all.substr(11) : all;
  }
  /// Messages on a model with this output. The first character of the expression is in column 13.
  std::string output(const std::string& text) { return wrong("output: " + text); }
};

TEST_F(EquationTexts, OfWrongGrammarNameTheCharacter) {
  const std::array<std::pair<const char*, const char*>, 31> cases{{
      {"x + r*sin(phy)", "8:23: error: 'phy' is unknown; did you mean 'phi'?"},
      {"x + r*sn(phi)", "8:19: error: 'sn' is not a function; did you mean 'sin'?"},
      {"x*foo(1)",
       "8:15: error: 'foo' is not a function; known functions: sin, cos, tan, tanh, exp, log, sqrt, abs, sign, min, max, "
       "clamp, if, mod, atan2, sum"},
      {"x + sin(phi, r)", "8:17: error: sin has 2 arguments; expected 1"},
      {"max(x)", "8:13: error: max has 1 argument; expected 2"},
      {"min()", "8:17: error: found ')'; expected a number, a name or '('"},
      {"x + r r", "8:19: error: found 'r'; expected an operator or the end of the text"},
      {"x + r)", "8:18: error: found ')'; expected an operator or the end of the text"},
      {"(x + r", "8:19: error: found the end of the text; expected an operator or ')'"},
      {"sin(x", "8:18: error: found the end of the text; expected an operator, ',' or ')'"},
      {"x +", "8:16: error: found the end of the text; expected a number, a name or '('"},
      {"x + *r", "8:17: error: found '*'; expected a number, a name or '('"},
      {"x = r", "8:15: error: found '='; compare with '=='"},
      {"x $ r", "8:15: error: found '$', which has no meaning here"},
      {"x \xC3\x97 r", "8:15: error: found '\xC3\x97', which has no meaning here"},
      {"x + 010", "8:17: error: found '010'; expected a number without a leading zero"},
      {"x + 1e400", "8:17: error: found '1e400'; expected a number that fits a double"},
      {"x + 0x10", "8:18: error: found 'x10'; expected an operator or the end of the text"},
      {"x < r < 1", "8:19: error: found '<' after a comparison; write a < b and b < c"},
      {"phi[j]", "8:13: error: 'phi'[j] is known only within sum(j in neighbours, ...)"},
      {"phi[3]", "8:17: error: found '3'; expected i or j"},
      {"phi[i,j]", "8:13: error: 'phi'[j] is known only within sum(j in neighbours, ...)"},
      {"w[i,j]", "8:13: error: 'w' is known only within sum(j in neighbours, ...)"},
      {"sum(j in neighbours, w*x[j])", "8:34: error: 'w' belongs to a coupling; write w[i,j]"},
      {"sum(j in neighbours, x[i,j])", "8:34: error: 'x' belongs to one joint; write [i] or [j]"},
      {"sum(k in neighbours, x)", "8:17: error: found 'k'; expected 'j': sum(j in neighbours, TERM)"},
      {"sum(j in all, x)", "8:22: error: found 'all'; expected 'neighbours': sum(j in neighbours, TERM)"},
      {"sum(j in neighbours, sum(j in neighbours, x))", "8:34: error: a sum within a sum; expected one level"},
      {"x + sin", "8:17: error: 'sin' is a function; put its arguments in brackets after it"},
      {"x(1)", "8:13: error: 'x' is not a function; multiply with *"},
      {"t[i]", "8:13: error: 't' is one number; write it without brackets"},
  }};
  for (const auto& [text, message] : cases) EXPECT_EQ(output(text), message) << text;
}

TEST_F(EquationTexts, KnowWhereAWordMayStand) {
  EXPECT_EQ(output("x + angle"),
            "8:17: error: 'angle' may not be used in the output; only in a derivative or an event: set a state");
  EXPECT_EQ(wrong("initial: {phi: r}"),
            "8:20: error: 'r' may not be used in an initial value; only in a derivative, an event or the output");
  EXPECT_EQ(wrong("parameters: {a: b, b: 2}"),
            "8:21: error: 'b' is defined below; a parameter may use only parameters above it");
  EXPECT_EQ(wrong("parameters: {a: t}"),
            "8:21: error: 't' may not be used in a parameter; only in a derivative, an event or the output");
  EXPECT_EQ(wrong("initial: {phy: 1}"), "8:15: error: 'phy' is not a state; did you mean 'phi'?");
  EXPECT_EQ(wrong("parameters: {sin: 1}"), "8:18: error: 'sin' has a fixed meaning in equations; choose another name");
  EXPECT_EQ(wrong("parameters: {depth: 1}"), "8:18: error: 'depth' has a fixed meaning in equations; choose another name");
  EXPECT_EQ(wrong("parameters: {phi: 1}"),
            "8:18: error: 'phi' is declared twice, as a parameter, a state or an input; give one of them another name");
  EXPECT_EQ(wrong("parameters: {1a: 1}"), "8:18: error: '1a' is not a name; expected a letter, then letters, digits and `_`");
}

TEST_F(EquationTexts, LackNothing) {
  EXPECT_EQ(wrong("states: {y: 1}"),
            "8:5: error: no output is given; expected the set point in rad, for example output: r*sin(phi)");
  EXPECT_EQ(wrong("states: {y: }\noutput: y"), "8:17: error: states.y is empty; expected a text");
  EXPECT_EQ(wrong("states: {y: \"\"}\noutput: y"), "8:17: error: states.y is empty; expected a text");
  EXPECT_EQ(wrong("states: {y: [1]}\noutput: y"), "8:17: error: states.y is a list; expected a text");
  EXPECT_EQ(wrong("states: [y]\noutput: x"), "8:13: error: states is a list; expected a map of names");
  EXPECT_EQ(wrong("parameters: {a: [1, 2, 3]}"),
            "8:21: error: parameters.a has 3 numbers; expected one for each of the robot's 2 joints");
  EXPECT_EQ(wrong("parameters: {a: {m0/h: 1}}"),
            "8:21: error: parameters.a names only some joints; add default: for the others");
  EXPECT_EQ(wrong("parameters: {a: {m0/*: 1, \"m?/h\": 1}}\noutput: a"), "no error") << "every joint by a pattern";
  EXPECT_EQ(wrong("parameters: {a: {m0/*: 1, m0/h: 1}}"),
            "8:21: error: parameters.a names only some joints; add default: for the others");
  EXPECT_EQ(wrong("parameters: {a: {default: 1, m0/x: 1}}"), "8:34: error: no joint 'm0/x'; did you mean 'm0/h'?");
  EXPECT_EQ(wrong("parameters: {a: }"),
            "8:21: error: parameters.a is empty; expected a number, a text, a list, or a map of joints");
  EXPECT_EQ(wrong("parameters: {a: .inf}"), "8:21: error: found '.', which has no meaning here");
  EXPECT_EQ(wrong("parameters: {a: {m0/h: 1, m1/h: 2}, b: [1, 2], c: -1.5e3, d: a/2}\noutput: a + b*c + d"), "no error");
}

TEST_F(EquationTexts, AreAllChecked) {
  EXPECT_EQ(
      wrong("states:\n  phi: omega + a\n  r: 1 +\ninitial: {phi: bb}\noutput: cc*phi + dd"),
      "9:20: error: 'a' is unknown; known names: pi, t, angle, speed, torque, touching, load, limb_load, limb_touching, "
      "frequency, omega, amplitude, offset, "
      "phase, index, joints, depth, side, phi, r\n"
      "DIR/s.yaml:10:13: error: found the end of the text; expected a number, a name or '('\n"
      "DIR/s.yaml:11:20: error: 'bb' is unknown; known names: pi, frequency, omega, amplitude, offset, phase, index, joints, "
      "depth, side\n"
      "DIR/s.yaml:12:13: error: 'cc' is unknown; known names: pi, t, frequency, omega, amplitude, offset, phase, index, "
      "joints, depth, side, phi, r\n"
      "DIR/s.yaml:12:22: error: 'dd' is unknown; known names: pi, t, frequency, omega, amplitude, offset, phase, index, "
      "joints, depth, side, phi, r");
}

TEST_F(EquationTexts, HaveTheirPlaceInEveryKindOfScalar) {
  const std::string message = " error: 'y' is unknown; ";
  const auto place = [&](const std::string& lines, const std::vector<std::string>& sets = {}) {
    const std::string all = wrong(lines, sets);
    return all.substr(0, all.find(message));
  };
  EXPECT_EQ(place("output: x + y"), "8:17:");
  EXPECT_EQ(place("output: \"x + y\""), "8:18:");
  EXPECT_EQ(place("output: 'x + y'"), "8:18:");
  EXPECT_EQ(place("output: \"x\\n + y\""), "8:20:");
  EXPECT_EQ(place("output: |\n  x\n    + y"), "10:11:");
  EXPECT_EQ(place("output: |-  # why\n\n\n  x + y"), "11:11:");
  EXPECT_EQ(place("output: |2+\n    x\n  + y\n\n"), "10:9:");
  EXPECT_EQ(place("initial: {phi: 'y'}"), "8:21:");
  EXPECT_EQ(place("initial:\n  phi: |\n    1\n    + y\n  r: 0"), "11:11:");
  EXPECT_EQ(place("output: >\n  x\n  + y"), "8:13:");  // a folded text has the place of its scalar
  EXPECT_EQ(place("output: x\n  + y"), "8:13:");
  EXPECT_EQ(place("output: x", {"cpg.model.output=x + y"}), "--set cpg.model.output=x + y:");
  EXPECT_EQ(place("output: x", {"cpg.model.initial.phi=y"}), "--set cpg.model.initial.phi=y:");
}

TEST_F(EquationTexts, HaveLimits) {
  std::string names, deep, wide, states;
  for (int k = 0; k < 70; ++k) {
    names += (k > 0 ? ", p" : "p") + std::to_string(k) + ": 1";
    if (k < 33) states += (k > 0 ? ", s" : "s") + std::to_string(k) + ": 1";
  }
  for (int k = 0; k < 64; ++k) deep += '(';
  for (int k = 0; k < 250; ++k) wide += "1+";
  EXPECT_EQ(output(deep.substr(1)), "8:76: error: found the end of the text; expected a number, a name or '('");
  EXPECT_EQ(output(deep), "8:77: error: nested deeper than 64 levels");
  EXPECT_EQ(output("0" + std::string(100, '-')), "8:79: error: nested deeper than 64 levels");
  EXPECT_EQ(output(wide.substr(2) + "1"), "no error");
  EXPECT_EQ(output(wide + "1"), "8:512: error: more than 500 numbers, names and operators");
  EXPECT_EQ(output("1" + std::string(4000, ' ') + "+ 1"), "8:4013: error: longer than 4000 characters");
  const auto at = [](std::size_t column, const std::string& text) {
    return "8:" + std::to_string(column) + ": error: " + text;
  };
  EXPECT_EQ(wrong("parameters: {" + names + "}"), at(18 + names.find("p64"), "more than 64 parameters"));
  EXPECT_EQ(wrong("states: {" + states + "}\noutput: s0"), at(14 + states.find("s32"), "more than 32 states"));
}

TEST_F(EquationTexts, ThatAreNotFiniteForThisRobotAreRefused) {
  EXPECT_EQ(wrong("parameters: {a: 1/depth}"),
            "6:9: error: cpg 'equations': parameter a of joint m0/h is inf; expected a finite number");
  EXPECT_EQ(wrong("initial: {phi: log(index - 1)}"),
            "6:9: error: cpg 'equations': initial phi of joint m0/h is nan; expected a finite number");
}

TEST_F(EquationTexts, SurviveTheResolvedScenario) {
  const Scenario s = read(
      fakes::kTwo +
      "cpg:\n  type: equations\n  model:\n    parameters: {a: 2, b: [1, 2], c: '3', d: depth, e: {default: 1, m0/h: 5}}\n"
      "    states:\n      phi: |\n        omega\n          + a*b\n      r: |-\n        c\n\n        + d\n      x: \"1\\n\"\n"
      "      y: \" 1\\n + 2\"\n      z: 0\n    output: phi\n      + r + e\n");
  expect_stable(s);
  const std::string text = resolved(s);
  EXPECT_NE(
      text.find(
          "    states:\n      phi: |\n        omega\n          + a*b\n      r: |-\n        c\n\n        + d\n      x: |\n"
          "        1\n      y: \" 1\\n + 2\"\n      z: \"0\"\n    parameters:\n      a: 2\n      b: [1, 2]\n      c: \"3\"\n"
          "      d: depth\n      e: [5, 1]\n    initial: {}\n    output: \"phi + r + e\"\n"),
      std::string::npos)
      << text;
}

}  // namespace
}  // namespace gaitlab::test
