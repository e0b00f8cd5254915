// The section `groups`: names for several joints, wherever a pattern may stand, and messages for wrong groups.
#include <gtest/gtest.h>

#include "core/scenario/change_section.h"
#include "core/scenario/schema.h"
#include "tests/core/scenario/fixture.h"

namespace gaitlab {
namespace {

using fakes::kTwo;

class GroupsTest : public fakes::ScenarioTest {
 protected:
  /// Scenario of two modules with joints m0/h and m1/h; the section is in line 5.
  static std::string with(const std::string& groups, const std::string& more = "") {
    return kTwo + "groups: " + groups + "\n" + more;
  }
};

TEST_F(GroupsTest, StandWherePatternsStand) {
  const std::string groups = "{both: \"*/h\", last: [m1/h]}";
  const auto same = [&](const std::string& by_group, const std::string& by_name) {
    EXPECT_EQ(resolved(read(with(groups, by_group))), resolved(read(with(groups, by_name)))) << by_group;
  };
  same("actuator: {R: {both: 3}}\n", "actuator: {R: [3, 3]}\n");
  same("actuator: {R: {default: 2, last: 3}}\n", "actuator: {R: [2, 3]}\n");
  same("actuator: {R: {both: 3, m1/h: 5}}\n", "actuator: {R: [3, 5]}\n");
  same("actuator: {R: {last: 3, \"m0/*\": 5}}\n", "actuator: {R: [5, 3]}\n");
  same("initial: {angles: {both: 0.5}}\n", "initial: {angles: [0.5, 0.5]}\n");
  same("cpg: {type: phase_oscillator, amplitude: {default: 0.1, last: 0.2}}\n",
       "cpg: {type: phase_oscillator, amplitude: [0.1, 0.2]}\n");
  same("figure: {joints: [last, both]}\n", "figure: {joints: [m1/h, m0/h]}\n");
  same("at: [{t: 0.5, fault: {joint: both, kind: dead}}]\n", "at: [{t: 0.5, fault: {joint: [m0/h, m1/h], kind: dead}}]\n");
  same("at: [{t: 0.5, fault: {joint: [last, m0/h], kind: dead}}]\n",
       "at: [{t: 0.5, fault: {joint: [m1/h, m0/h], kind: dead}}]\n");
  same("cpg: {type: phase_oscillator, amplitude: 0.1}\nat: [{t: 0.5, set: {cpg.amplitude.last: 0.3}}]\n",
       "cpg: {type: phase_oscillator, amplitude: 0.1}\nat: [{t: 0.5, set: {cpg.amplitude: [0.1, 0.3]}}]\n");
}

TEST_F(GroupsTest, OnTheCommandLineAndInStudies) {
  const std::string text = with("{both: \"*/h\", last: [m1/h]}", "actuator: {R: 2}\n");
  EXPECT_EQ(resolved(read(text, {"actuator.R.last=5"})), resolved(read(text, {"actuator.R=[2, 5]"})));
  EXPECT_EQ(resolved(read(kTwo + "actuator: {R: 2}\n", {"groups.last=m1/h", "actuator.R.last=5"})),
            resolved(read(kTwo + "groups: {last: m1/h}\nactuator: {R: [2, 5]}\n")));
  const std::string path = folder_.write("t.yaml", text);
  const ScenarioTemplate file(path, {}, catalog_);
  EXPECT_EQ(resolved(file.with({"actuator.R.last=5"})), resolved(read_scenario(path, {"actuator.R=[2, 5]"}, catalog_)));
  EXPECT_EQ(resolved(file.with({"groups.last=m0/h", "actuator.R.last=5"})),
            resolved(read_scenario(path, {"groups.last=m0/h", "actuator.R=[5, 2]"}, catalog_)));
}

TEST_F(GroupsTest, TheResolvedScenarioHasThemByName) {
  const Scenario s = read(with("{all: \"m[0-1]/h\"}", "actuator: {R: {all: 3}}\n"));
  EXPECT_EQ(s.groups, (JointGroups{{"all", {"m0/h", "m1/h"}}}));
  EXPECT_NE(resolved(s).find("\ngroups:\n  all: [m0/h, m1/h]\n"), std::string::npos) << resolved(s);
  expect_stable(s);
  EXPECT_EQ(resolved(read(kTwo)).find("groups"), std::string::npos);
  EXPECT_EQ(resolved(read(with("{}"))), resolved(read(kTwo)));
  EXPECT_NE(scenario_schema(catalog_).find("\"groups\""), std::string::npos);
}

TEST_F(GroupsTest, WrongGroups) {
  EXPECT_EQ(error(with("hips")), "DIR/s.yaml:5:9: error: groups is 'hips'; expected a map NAME: [JOINT, ...]");
  EXPECT_EQ(error(with("{m0/h: [m1/h]}")),
            "DIR/s.yaml:5:10: error: 'm0/h' is the name of a joint; expected another name for the group");
  EXPECT_EQ(error(with("{default: [m1/h]}")),
            "DIR/s.yaml:5:10: error: 'default' is not a name of a group; expected a letter, then letters, digits, `_` and `-`, "
            "but not `default`");
  EXPECT_EQ(error(with("{none: []}")), "DIR/s.yaml:5:16: error: group 'none' has no joint");
  EXPECT_EQ(error(with("{a: {b: 1}}")),
            "DIR/s.yaml:5:13: error: group a is a map; expected joints: [m3/hinge, \"m[4-6]/hinge\"]");
  EXPECT_EQ(error(with("{a: [m0/h, m7/h], b: [\"*/x\"]}")),
            "DIR/s.yaml:5:20: error: no joint 'm7/h'; joints are m0/h, m1/h\n"
            "DIR/s.yaml:5:31: error: no joint matches '*/x'; did you mean '*/h'?");
  EXPECT_EQ(error(with("{m1: [m0/h]}")),
            "DIR/s.yaml:5:10: error: 'm1' is the name of a module; expected another name for the group");
}

TEST_F(GroupsTest, AGroupWithAFaultIsReportedOnce) {
  const std::string group = "DIR/s.yaml:5:14: error: 'a' is a group; expected a joint or a pattern";
  EXPECT_EQ(error(with("{a: [a]}")), "DIR/s.yaml:5:14: error: 'a' is a group; expected a joint or a pattern");
  EXPECT_EQ(error(with("{a: [a]}", "actuator: {R: {a: 3}}\nfigure: {joints: [a]}\n")), group);
  EXPECT_EQ(error(with("{a: [a]}", "at: [{t: 0.5, fault: {joint: a, kind: dead}}]\n")), group);
  EXPECT_EQ(error(with("{b: [m0/h], c: [b, m1/h]}", "actuator: {R: {c: 3}}\n")),
            "DIR/s.yaml:5:25: error: 'b' is a group; expected a joint or a pattern");
}

TEST_F(GroupsTest, WrongUses) {
  const std::string groups = "{hips: [m0/h], knees: [m0/h, m1/h]}";
  const auto wrong = [&](const std::string& more) { return error(with(groups, more)); };
  EXPECT_EQ(wrong("actuator: {R: {hip: 3}}\n"), "DIR/s.yaml:6:16: error: no joint 'hip'; did you mean 'hips'?");
  EXPECT_EQ(wrong("figure: {joints: [kneees]}\n"), "DIR/s.yaml:6:19: error: no joint 'kneees'; did you mean 'knees'?");
  EXPECT_EQ(wrong("actuator: {R: {zzzzz: 3}}\n"),
            "DIR/s.yaml:6:16: error: no joint 'zzzzz'; known joints and groups: m0/h, m1/h, hips, knees");
  EXPECT_EQ(wrong("at: [{t: 0.5, fault: {joint: knes, kind: dead}}]\n"),
            "DIR/s.yaml:6:30: error: no joint 'knes'; did you mean 'knees'?");
  EXPECT_EQ(wrong("actuator: {R: {hips: 3, knees: 4}}\n"),
            "DIR/s.yaml:6:25: error: joint 'm0/h' is given 3 by 'hips' and 4 by 'knees'; give it by its name, which beats "
            "patterns\nDIR/s.yaml:6:16: note: 'hips' is here");
  EXPECT_EQ(wrong("initial: {angles: {hips: 2}}\n"),
            "DIR/s.yaml:6:26: error: the initial angle of joint 'm0/h' is 2 rad; expected -1.5 to 1.5 rad");
}

}  // namespace
}  // namespace gaitlab
