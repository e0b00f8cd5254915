#include "core/settings/overlay.h"

#include <gtest/gtest.h>

#include "tests/core/scenario/fakes.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

const char* const kText =
    "physics: {step: 1e-4}\n"
    "docks:\n  - {orientation: 1}\n"
    "cpg:\n  frequency: 1\n  model: {rate: 3}\n"
    "duration: 1\n";

std::string after(const std::vector<std::string>& sets) {
  Node root = parse_yaml(kText, "f");
  Problems problems;
  apply_sets(root, sets, problems);
  problems.raise();
  return print_yaml(root);
}

std::string refused(const std::string& set) {
  return test::message_of([&] { after({set}); });
}

TEST(Overlay, ReplacesAddsAndCreatesMaps) {
  EXPECT_EQ(after({"physics.step=2e-4", "docks.0.orientation=3", "cpg.phase_lag=-1.2", "trace.columns=[a, b]", "x={y: 1}"}),
            "physics: {step: 2e-4}\n"
            "docks:\n  - {orientation: 3}\n"
            "cpg:\n  frequency: 1\n  model: {rate: 3}\n  phase_lag: -1.2\n"
            "duration: 1\n"
            "trace:\n  columns: [a, b]\n"
            "x: {y: 1}\n");
  EXPECT_EQ(after({"initial.angles.m3/passive=1", "duration=2"}).substr(89),
            "duration: 2\ninitial:\n  angles:\n    m3/passive: 1\n");
}

TEST(Overlay, ANumberIsTheDefaultOfAValuePerJoint) {
  EXPECT_EQ(after({"cpg.frequency.m3/active=0", "cpg.model.rate.*/passive=2", "cpg.amplitude.m1/x=4"}).substr(50),
            "cpg:\n  frequency:\n    default: 1\n    m3/active: 0\n"
            "  model: {rate: {default: 3, \"*/passive\": 2}}\n"
            "  amplitude:\n    m1/x: 4\n"
            "duration: 1\n");
  EXPECT_EQ(after({"cpg.frequency.default=4"}).substr(50, 33), "cpg:\n  frequency:\n    default: 4\n");
  EXPECT_EQ(after({"cpg.frequency=4", "cpg.frequency.m0/x=2"}).substr(50, 45),
            "cpg:\n  frequency:\n    default: 4\n    m0/x: 2\n");
}

TEST(Overlay, ThePlaceIsTheOption) {
  Node root = parse_yaml(kText, "f");
  Problems problems;
  apply_sets(root, {"a.b=1"}, problems);
  EXPECT_EQ(to_string(root.find("a")->find("b")->place), "--set a.b=1");
  EXPECT_EQ(to_string(root.find("a")->keys[0].second), "--set a.b=1");
}

TEST(Overlay, MalformedOptions) {
  EXPECT_EQ(refused("duration"),
            "--set duration: error: found no '='; expected KEY.PATH=VALUE, for example physics.step=2.5e-05");
  EXPECT_EQ(refused("=3"), "--set =3: error: found an empty key; expected KEY.PATH=VALUE, for example physics.step=2.5e-05");
  EXPECT_EQ(refused("a..b=3"),
            "--set a..b=3: error: found an empty key; expected KEY.PATH=VALUE, for example physics.step=2.5e-05");
  EXPECT_EQ(refused("duration.x=1"), "--set duration.x=1: error: duration is 1, a single value; it has no key 'x'");
  EXPECT_EQ(refused("docks.1.orientation=1"),
            "--set docks.1.orientation=1: error: docks is a list of 1; '1' is not an element (they are numbered from 0)");
  EXPECT_EQ(refused("docks.first=1"),
            "--set docks.first=1: error: docks is a list of 1; 'first' is not an element (they are numbered from 0)");
  EXPECT_EQ(refused("duration=[1"), "--set duration=[1: error: not valid YAML: the [ opened here is not closed; expected ]");
  EXPECT_EQ(refused("duration=1\nseed: 3"), "--set duration=1\\x0aseed: 3: error: the value has several lines; expected one");
  EXPECT_EQ(refused("duration=&a 1"),
            "--set duration=&a 1: error: found the anchor '&a'; anchors and aliases are not supported");
  EXPECT_EQ(refused("a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q=1"),
            "--set a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q=1: error: the path has 17 keys; expected at most 16");
}

class Retyping : public testing::Test {
 protected:
  Retyping() { fakes::fill(catalog_); }

  /// Text of the notes, and then of the tree with the settings.
  std::string after(const std::string& text, const std::vector<std::string>& sets) {
    Node root = parse_yaml(text, "f");
    Problems problems;
    const auto retyped = apply_sets(root, sets, problems);
    std::string out;
    for (const std::string& note : drop_old_keys(root, retyped, catalog_)) out += note + "\n";
    return out + print_yaml(root);
  }
  Catalog catalog_;
};

TEST_F(Retyping, KeepsCommonKeysAndDropsTheOldModel) {
  EXPECT_EQ(after("cpg:\n  frequency: 1\n  model: {rate: 3}\n", {"cpg.type=hopf"}),
            "cpg: type changed from phase_oscillator to hopf; dropped model.rate\ncpg:\n  frequency: 1\n  type: hopf\n");
  EXPECT_EQ(after("cpg: {frequency: 1}\n", {"cpg.type=hopf"}), "cpg: {frequency: 1, type: hopf}\n");
  EXPECT_EQ(after("cpg: {type: hopf, model: {mu: 1}}\n", {"cpg.type=hopf"}), "cpg: {type: hopf, model: {mu: 1}}\n");
}

TEST_F(Retyping, WhatIsSetItselfStays) {
  EXPECT_EQ(after("cpg: {model: {rate: 3}}\n", {"cpg.model.mu=2", "cpg.type=hopf"}),
            "cpg: type changed from phase_oscillator to hopf; dropped model.rate\ncpg: {model: {mu: 2}, type: hopf}\n");
}

TEST_F(Retyping, KeysTheNewTypeDoesNotKnowAreNamed) {
  EXPECT_EQ(after("controller: {type: pid, period: 0.01, Kp: 3}\n", {"controller.type=hold"}),
            "controller: type changed from pid to hold; dropped Kp\ncontroller: {type: hold, period: 0.01}\n");
  EXPECT_EQ(after("cpg: {frequency: 1, model: {rate: 3}}\n", {"cpg.type=picky"}),
            "cpg: type changed from phase_oscillator to picky; dropped model.rate, frequency\ncpg: {type: picky}\n");
  EXPECT_EQ(after("cpg: {frequency: 1, model: {rate: 3}}\n", {"cpg.type=unknown"}),
            "cpg: {frequency: 1, model: {rate: 3}, type: unknown}\n");
}

}  // namespace
}  // namespace gaitlab
