// Tests of Reader, Writer and Explainer with the same settings structs.
#include "core/settings/reader.h"

#include <gtest/gtest.h>

#include "core/settings/explainer.h"
#include "core/settings/writer.h"
#include "tests/core/scenario/fakes.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

const std::vector<std::string> kJoints{"m0/active", "m0/passive", "m1/active"};

struct Gains {
  double stiffness = 10;
  std::array<double, 2> window{0, 1};
  std::int64_t order = 3, leader = -1;
  bool on = false;
  enum class Mode { slow, fast } mode = Mode::slow;
  void fields(Fields& f) {
    static constexpr const char* kModes[] = {"slow", "fast"};
    f.number("stiffness", stiffness, {"N/m", 0, 1e4, "Of the spring."});
    f.vector("window", window, {"s", 0, 10, "From, to."});
    f.integer("order", order, {"", 1, 5, "Of the filter."});
    f.joint("leader", leader, "Who leads.");
    f.flag("on", on, "Whether.");
    f.choice("mode", mode, kModes, "How.");
  }
};

/// Messages on reading `text` into settings. The settings keep the values that are read before an error.
template <class T>
std::string read(const std::string& text, T& settings, JointNames joints = &kJoints) {
  const Node node = parse_yaml(text, "f");
  Problems problems;
  Reader reader(node, "settings", problems, joints);
  settings.fields(reader);
  reader.finish();
  return test::message_of([&] { problems.raise(); });
}

template <class T>
std::string write(T& settings) {
  Writer writer(kJoints);
  settings.fields(writer);
  return print_yaml(writer.take());
}

TEST(Reader, EntriesOfAVectorByNumber) {
  Gains s;
  EXPECT_EQ(read("window: {1: 2}\n", s), test::kNoError);
  EXPECT_EQ(s.window, (std::array<double, 2>{0, 2})) << "the other entry keeps its default";
  EXPECT_EQ(read("window: {2: 2, x: 1, 0: 11}\n", s),
            "f:1:10: error: window is a list of 2 numbers in s; '2' is not an element (they are numbered from 0)\n"
            "f:1:16: error: window is a list of 2 numbers in s; 'x' is not an element (they are numbered from 0)\n"
            "f:1:25: error: window[0] is 11 s; expected 0 to 10 s");
}

TEST(Reader, ReadsWhatIsThereAndKeepsDefaults) {
  Gains s;
  EXPECT_EQ(read("window: [0.5, 2]\nleader: m1/active\non: true\nmode: fast\n", s), test::kNoError);
  EXPECT_EQ(s.stiffness, 10);
  EXPECT_EQ(s.window[1], 2);
  EXPECT_EQ(s.leader, 2);
  EXPECT_TRUE(s.on);
  EXPECT_EQ(s.mode, Gains::Mode::fast);
  EXPECT_EQ(read("leader: 1\n", s), test::kNoError);
  EXPECT_EQ(s.leader, 1);
}

TEST(Reader, UnknownKeysOfferTheNearestOrAll) {
  Gains s;
  EXPECT_EQ(read("stifness: 2\n", s), "f:1:1: error: unknown key 'stifness'; did you mean 'stiffness'?");
  EXPECT_EQ(read("colour: 2\n", s),
            "f:1:1: error: unknown key 'colour'; known keys: stiffness, window, order, leader, on, mode");
  EXPECT_EQ(read("{on: true, order:2}\n", s), "f:1:12: error: unknown key 'order:2'; put a space after the colon");
  EXPECT_EQ(read("<<: {on: true}\n", s).substr(0, 31), "f:1:1: error: unknown key '<<';");
}

TEST(Reader, AnUnknownKeyIsAValueOfItsProblem) {
  const Node node = parse_yaml("{colour: 2, order: 9}\n", "f");
  Problems problems;
  Gains s;
  Reader reader(node, "settings", problems, &kJoints);
  s.fields(reader);
  reader.finish();
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems.list()[0].unknown_key, "") << "a wrong value";
  EXPECT_EQ(problems.list()[1].unknown_key, "colour");
}

TEST(Reader, WrongTypesAndRanges) {
  Gains s;
  EXPECT_EQ(read("stiffness: stiff\norder: 9\nwindow: [1, .nan]\non: yes\nmode: fst\nleader: m0/pasive\n", s),
            "f:1:12: error: stiffness is 'stiff'; expected a number in N/m\n"
            "f:3:13: error: window[1] is .nan; expected a finite number in s\n"
            "f:2:8: error: order is 9; expected 1 to 5\n"
            "f:6:9: error: no joint 'm0/pasive'; did you mean 'm0/passive'?\n"
            "f:4:5: error: on is 'yes'; expected true or false\n"
            "f:5:7: error: mode 'fst' is unknown; did you mean 'fast'?");
  EXPECT_EQ(read("stiffness: -1\n", s), "f:1:12: error: stiffness is -1 N/m; expected 0 to 10000 N/m");
  EXPECT_EQ(read("stiffness:\n", s), "f:1:1: error: stiffness is empty; expected a number in N/m");
  EXPECT_EQ(read("window: [1]\n", s), "f:1:9: error: window has 1 number; expected a list of 2 numbers in s");
  EXPECT_EQ(read("window: 1\n", s), "f:1:9: error: window is 1; expected a list of 2 numbers in s");
  EXPECT_EQ(read("mode: [slow]\n", s), "f:1:7: error: mode is a list; expected one of slow, fast");
  EXPECT_EQ(read("mode: other\n", s), "f:1:7: error: mode 'other' is unknown; known names: slow, fast");
  EXPECT_EQ(read("leader: 3\n", s), "f:1:9: error: leader is 3; the robot has 3 joints, numbered from 0");
  EXPECT_EQ(read("leader: m9/x\n", s), "f:1:9: error: no joint 'm9/x'; known joints: m0/active, m0/passive, m1/active");
}

TEST(Reader, PerJointValues) {
  fakes::CommonKeys s;
  EXPECT_EQ(read("frequency: 1\namplitude: [1, 2, 3]\n", s), test::kNoError);
  EXPECT_EQ(s.frequency[2], 1);
  EXPECT_EQ(s.amplitude[2], 3);
  EXPECT_EQ(read("amplitude: {default: 0.5, m1/active: 0.25}\nfrequency: {m0/active: 2}\n", s), test::kNoError);
  EXPECT_EQ(s.amplitude.each, (std::vector<double>{0.5, 0.5, 0.25}));
  EXPECT_EQ(s.frequency.each, (std::vector<double>{2, 1, 1}));
  EXPECT_EQ(read("amplitude: {default: 0.5}\nfrequency: 3\n", s), test::kNoError);
  EXPECT_TRUE(s.amplitude.each.empty());
  EXPECT_TRUE(s.frequency.each.empty());
}

TEST(Reader, PerJointErrors) {
  fakes::CommonKeys s;
  EXPECT_EQ(read("frequency: 25\n", s), "f:1:12: error: frequency is 25 Hz; expected 0 to 20 Hz");
  EXPECT_EQ(read("frequency: [1, 2]\n", s),
            "f:1:12: error: frequency has 2 numbers; expected one for each of the robot's 3 joints");
  EXPECT_EQ(read("frequency: [1, 2, -3]\n", s), "f:1:19: error: frequency[2] is -3 Hz; expected 0 to 20 Hz");
  EXPECT_EQ(read("frequency: {default: x, m0/active: 30, m1/actve: 1}\n", s),
            "f:1:22: error: frequency.default is 'x'; expected a number in Hz\n"
            "f:1:36: error: frequency of 'm0/active' is 30 Hz; expected 0 to 20 Hz\n"
            "f:1:40: error: no joint 'm1/actve'; did you mean 'm1/active'?");
  EXPECT_EQ(read("frequency:\n", s), "f:1:1: error: frequency is empty; expected a number in Hz, a list, or a map of joints");
  EXPECT_EQ(read("frequency: {m0/active: 30, x: 1}\namplitude: [1]\n", s, nullptr),
            "f:1:24: error: frequency of 'm0/active' is 30 Hz; expected 0 to 20 Hz");
}

TEST(Reader, PatternsOfJoints) {
  fakes::CommonKeys s;
  // A name overrides patterns, and patterns override the default, in any order.
  EXPECT_EQ(read("frequency: {m0/active: 3, \"*/active\": 2, default: 1}\namplitude: {\"m?/active\": 0.25}\n", s),
            test::kNoError);
  EXPECT_EQ(s.frequency.each, (std::vector<double>{3, 1, 2}));
  EXPECT_EQ(s.amplitude.each, (std::vector<double>{0.25, 0.6, 0.25}));
  // Patterns may give equal values, or different values for a joint whose name is also given.
  EXPECT_EQ(read("frequency: {\"*/active\": 2, m0/*: 2, m0/passive: 5}\n", s), test::kNoError);
  EXPECT_EQ(s.frequency.each, (std::vector<double>{2, 5, 2}));
  EXPECT_EQ(read("frequency: {\"*/active\": 2, m0/*: 4, m0/active: 3}\n", s), test::kNoError);
  EXPECT_EQ(s.frequency.each, (std::vector<double>{3, 4, 2}));
  EXPECT_EQ(read("frequency: {\"*\": 7}\n", s), test::kNoError);
  EXPECT_EQ(s.frequency.each, (std::vector<double>{7, 7, 7}));
}

TEST(Reader, PatternErrors) {
  fakes::CommonKeys s;
  EXPECT_EQ(read("frequency: {\"*/active\": 2, m0/*: 3}\n", s),
            "f:1:28: error: joint 'm0/active' is given 2 by '*/active' and 3 by 'm0/*'; give it by its name, which beats "
            "patterns\nf:1:13: note: '*/active' is here");
  EXPECT_EQ(
      read("frequency: {\"*/active\": 2, \"*\": 3}\n", s),
      "f:1:28: error: joint 'm0/active' is given 2 by '*/active' and 3 by '*' (and so 1 joint more); give it by its name, "
      "which beats patterns\nf:1:13: note: '*/active' is here");
  // If three patterns conflict, each later pattern is reported together with the first.
  EXPECT_EQ(read("frequency: {\"*/p*\": 1, m0/p*: 2, \"*ssive\": 3}\n", s),
            "f:1:24: error: joint 'm0/passive' is given 1 by '*/p*' and 2 by 'm0/p*'; give it by its name, which beats "
            "patterns\nf:1:13: note: '*/p*' is here\n"
            "f:1:34: error: joint 'm0/passive' is given 1 by '*/p*' and 3 by '*ssive'; give it by its name, which beats "
            "patterns\nf:1:13: note: '*/p*' is here");
  EXPECT_EQ(read("frequency: {\"*/activ\": 2}\n", s), "f:1:13: error: no joint matches '*/activ'; did you mean '*/active'?");
  EXPECT_EQ(read("frequency: {m7/*: 2}\n", s), "f:1:13: error: no joint matches 'm7/*'; did you mean 'm0/*'?");
  EXPECT_EQ(read("frequency: {\"*hip*\": 2}\n", s),
            "f:1:13: error: no joint matches '*hip*'; known joints: m0/active, m0/passive, m1/active");
  EXPECT_EQ(read("frequency: {\"*/active\": 30}\n", s), "f:1:25: error: frequency of '*/active' is 30 Hz; expected 0 to 20 Hz");
  EXPECT_EQ(read("frequency: {\"*/x\": 30}\n", s, nullptr), "f:1:20: error: frequency of '*/x' is 30 Hz; expected 0 to 20 Hz");
  const std::string quotes = "; a pattern goes in quotes: \"*/active\"";
  const auto unquoted = [](const std::string& text) { return test::message_of([&] { parse_yaml(text, "f"); }); };
  EXPECT_EQ(unquoted("frequency: {*/active: 2}\n"), "f:1:13: error: not valid YAML: found * outside of quotes" + quotes);
  EXPECT_EQ(unquoted("frequency: {m?/active: 2}\n"), "f:1:14: error: not valid YAML: found ? outside of quotes" + quotes);
  Gains gains;
  EXPECT_EQ(read("leader: \"*/active\"\n", gains), "f:1:9: error: '*/active' is a pattern; expected the name of one joint");
}

/// Settings with a required value.
struct Required {
  PerJoint torque;
  void fields(Fields& f) { f.required("torque", torque, {"N m", kPositive, 10, "At rest; required."}); }
};

TEST(Reader, RequiredPerJoint) {
  Required s;
  EXPECT_EQ(read("{}\n", s), "f:1:1: error: missing key 'torque'");
  EXPECT_EQ(read("torque: 0\n", s), "f:1:9: error: torque is 0 N m; expected more than 0 and up to 10 N m");
  EXPECT_EQ(read("torque: {m0/active: 1, m1/*: 2}\n", s),
            "f:1:9: error: torque is missing for joint 'm0/passive'; add it, or default:");
  EXPECT_EQ(read("torque: {default: 1, m1/*: 2}\n", s), test::kNoError);
  EXPECT_EQ(read("{}\n", s), test::kNoError) << "given before, by the module type";
  s = {};
  EXPECT_EQ(read("torque: {\"*/active\": 1, \"*/passive\": 2}\n", s), test::kNoError);
  EXPECT_EQ(s.torque.each, (std::vector<double>{1, 2, 1}));
}

TEST(Reader, RuleOrList) {
  fakes::CommonKeys s;
  EXPECT_EQ(read("couplings: [{from: m0/active, to: 1, weight: 2}, {to: 2}]\n", s), test::kNoError);
  EXPECT_FALSE(s.rule.has_value());
  EXPECT_EQ(s.couplings.at(0).to, 1);
  EXPECT_EQ(s.couplings.at(1).weight, 1);
  EXPECT_EQ(read("couplings: chain\n", s), test::kNoError);
  EXPECT_EQ(s.rule, fakes::CommonKeys::Rule::chain);
  EXPECT_TRUE(s.couplings.empty());
  EXPECT_EQ(read("couplings: chian\n", s), "f:1:12: error: couplings 'chian' is unknown; did you mean 'chain'?");
  EXPECT_EQ(read("couplings: {from: 0}\n", s), "f:1:12: error: couplings is a map; expected chain or a list");
  EXPECT_EQ(read("couplings: [{form: 0}, 3]\n", s),
            "f:1:14: error: unknown key 'form'; did you mean 'from'?\n"
            "f:1:24: error: couplings[1] is 3; expected a map");
  const std::vector<std::string> none;
  EXPECT_EQ(read("couplings: [{weight: 1}]\n", s, &none), "f:1:13: error: missing key 'from'\nf:1:13: error: missing key 'to'");
}

/// Structs by name, a required key, a word instead of a value, and a value that other code reads.
struct Marks {
  struct Limb {
    std::string name;
    double mass = 0;
    void fields(Fields& f) { Marked(f, Need::required).number("mass", mass, {"kg", kPositive, 9, "Mass."}); }
  };
  std::vector<Limb> limbs;
  double range[2] = {0, 1};
  bool free = false;
  void fields(Fields& f) {
    Marked(f, Need::required).by_name("limbs", limbs, "{mass: ...}", "Limbs.");
    Marked(f, Need::preset, "free", &free).vector("range", range, {"", -9, 9, "Range."});
    f.other("pairs", {"list of pairs", R"({"type": "array"})", "[]"}, "Pairs.");
  }
};

TEST(Reader, MarkedFieldsAndStructsByName) {
  Marks s;
  EXPECT_EQ(read("limbs: {leg: {mass: 2}, arm: {mass: 1}}\nrange: free\npairs: 3\n", s), test::kNoError);
  EXPECT_EQ(s.limbs.at(1).name, "arm");
  EXPECT_EQ(s.limbs.at(0).mass, 2);
  EXPECT_TRUE(s.free);
  const std::vector<std::string> joints;
  Writer writer(joints);
  s.fields(writer);
  EXPECT_EQ(print_yaml(writer.take()), "limbs:\n  leg: {mass: 2}\n  arm: {mass: 1}\nrange: free\n");
  EXPECT_EQ(read("limbs: {leg: {mass: 2}}\nrange: [2, 3]\n", s), test::kNoError);
  EXPECT_EQ(s.range[1], 3);
  EXPECT_FALSE(s.free) << "given before";
  EXPECT_EQ(read("{}\n", s), "f:1:1: error: missing key 'limbs'");
  EXPECT_EQ(read("limbs: {leg: {mas: 2}, arm: 3}\nrange: loose\n", s),
            "f:1:15: error: unknown key 'mas'; did you mean 'mass'?\n"
            "f:1:29: error: 'arm' is 3; expected a map\n"
            "f:2:8: error: range is 'loose'; expected a list of 2 numbers, or free");
  EXPECT_EQ(read("limbs: {}\n", s), "f:1:8: error: limbs is an empty map; expected a map with at least one NAME: {mass: ...}");
}

TEST(Reader, GroupsAndChecksAcrossFields) {
  fakes::Hopf::Settings s;
  EXPECT_EQ(read("model: {mu: 3}\ntable: [1, 2]\nlabels: [a, 'b c']\n", s), test::kNoError);
  EXPECT_EQ(s.model.mu, 3);
  EXPECT_EQ(s.labels[1], "b c");
  EXPECT_EQ(read("model: {mu: 60}\n", s), "f:1:8: error: mu and the table do not go together");
  EXPECT_EQ(read("model: 3\n", s = {}), "f:1:8: error: model is 3; expected a map");
  EXPECT_EQ(read("model: {my: 3}\ntable: {a: 1}\nlabels: [[]]\nexpression: [x]\n", s),
            "f:1:9: error: unknown key 'my'; did you mean 'mu'?\n"
            "f:2:8: error: table is a map; expected a list of numbers in rad\n"
            "f:3:10: error: labels[0] is a list; expected a text\n"
            "f:4:13: error: expression is a list; expected a text");
}

TEST(Writer, EveryDefaultIsWrittenAndReadsBack) {
  fakes::Hopf::Settings s;
  s.couplings = {{0, 1, 2}, {1, 2, 0.5}};
  s.rule = std::nullopt;
  s.amplitude.each = {0.1, 0.2, 0.3};
  const std::string text = write(s);
  EXPECT_EQ(text,
            "frequency: 0.25\n"
            "amplitude: [0.1, 0.2, 0.3]\n"
            "couplings:\n"
            "  - {from: m0/active, to: m0/passive, weight: 2}\n"
            "  - {from: m0/passive, to: m1/active, weight: 0.5}\n"
            "model:\n"
            "  mu: 1\n"
            "table: []\n"
            "labels: [\"a b\", \"5\"]\n"
            "expression: \"x + 1\"\n");
  fakes::Hopf::Settings back;
  EXPECT_EQ(read(text, back), test::kNoError);
  EXPECT_EQ(write(back), text);
}

TEST(Explainer, ListsKeysWithUnitDefaultRangeAndSentence) {
  fakes::Hopf::Settings s;
  Explainer explainer;
  s.fields(explainer);
  EXPECT_EQ(table(explainer.rows()),
            "frequency (Hz): default 0.25; 0 to 20, per joint\n    Own frequency.\n"
            "amplitude (rad): default 0.6; 0 to 3.2, per joint\n    Peak set point.\n"
            "couplings: default chain; chain | list\n    chain, or a list.\n"
            "couplings[].from: default 0; joint name or number\n    The joint that is followed.\n"
            "couplings[].to: default 0; joint name or number\n    The joint that follows.\n"
            "couplings[].weight (1/s): default 1; -1000 to 1000\n    Pull.\n"
            "model:\n    Keys of this model.\n"
            "    mu: default 1; 0 to 100\n        Size.\n"
            "table (rad): default []; list of numbers, -10 to 10\n    Numbers.\n"
            "labels: default [a b, 5]; list of texts\n    Texts.\n"
            "expression: default x + 1; text\n    A text.\n");
  EXPECT_TRUE(s.couplings.empty());
  EXPECT_EQ(explainer.keys(),
            (std::vector<std::string>{"frequency", "amplitude", "couplings", "model", "table", "labels", "expression"}));
}

}  // namespace
}  // namespace gaitlab
