// The section `at`: segments, faults, --set, the resolved text, and messages for wrong input.
#include <gtest/gtest.h>

#include "core/scenario/change_section.h"
#include "core/scenario/schema.h"
#include "tests/core/scenario/fixture.h"
#include "tests/cpu_time.h"

namespace gaitlab {
namespace {

/// A CPG with as many states as a setting says.
struct Growing final : Cpg {
  struct Settings {
    std::int64_t size = 16;
    void fields(Fields& f) { f.integer("size", size, {"", 0, 100, "Number of states."}); }
  };
  Growing(const RobotInfo&, const Settings& s) : size_(static_cast<std::size_t>(s.size)) {}
  [[nodiscard]] std::size_t states() const override { return size_; }
  [[nodiscard]] std::string state_name(std::size_t i) const override { return "x" + std::to_string(i); }
  void output(double, In, Out) const override {}
  std::size_t size_;
};

class ChangesTest : public fakes::ScenarioTest {
 protected:
  ChangesTest() { add_cpg<Growing>(catalog_, "growing", "Grows."); }

  /// Scenario of 1 s of two modules, with joints m0/h and m1/h; the section is in line 6.
  static std::string with(const std::string& at, const std::string& cpg = "cpg: {type: phase_oscillator, frequency: 0.5}") {
    return fakes::kTwo + cpg + "\nat: " + at + "\n";
  }
  static double frequency(const PluginSelection& cpg) {
    return static_cast<const fakes::Phase::Settings*>(cpg.settings.get())->frequency.common;
  }
};

TEST_F(ChangesTest, NoneIsAnEmptyList) {
  const std::string none = resolved(read(fakes::kTwo));
  EXPECT_EQ(resolved(read(fakes::kTwo + "at: []\n")), none);
  EXPECT_EQ(none.find("\nat:"), std::string::npos);
}

TEST_F(ChangesTest, EachSegmentHasTheSettingsSoFar) {
  const Scenario s =
      read(with("[{t: 0.2, set: {cpg.frequency: 1, controller.Kp: 50}}, {t: 0.5, set: {cpg.amplitude: 0.3}}, "
                "{t: 0.7, fault: {joint: m1/h, kind: dead}}]"));
  ASSERT_EQ(s.changes.size(), 3U);
  EXPECT_EQ(frequency(s.cpg), 0.5);
  for (const Change& change : s.changes) {
    EXPECT_EQ(frequency(change.cpg), 1);
    EXPECT_EQ(static_cast<const fakes::Pid::Settings*>(change.controller.settings.get())->Kp, 50);
  }
  EXPECT_EQ(static_cast<const fakes::Phase::Settings*>(s.changes[2].cpg.settings.get())->amplitude.common, 0.3);
  EXPECT_EQ(static_cast<const fakes::Phase::Settings*>(s.changes[0].cpg.settings.get())->amplitude.common, 0.6);
  EXPECT_EQ(s.changes[2].faults.at(0).kind, FaultKind::dead);
  EXPECT_EQ(joints_of(s.changes[2].faults[0], *s.robot), (std::vector<std::size_t>{1}));
  EXPECT_TRUE(has_faults(s));
  EXPECT_EQ(s.trace.columns.back(), "segment");
  expect_stable(s);
}

TEST_F(ChangesTest, FaultsHaveTheirKeysOnly) {
  const Scenario s =
      read(with("[{t: 0, fault: [{joint: m0/h, kind: weak, share: 0.5}, {joint: [m1/h], kind: late, delay: 0.03}]}, "
                "{t: 0.3, fault: {joint: '*', kind: none}}]"));
  const std::string text = resolved(s);
  EXPECT_NE(text.find("at:\n  - t: 0\n    fault:\n      - joint: m0/h\n        kind: weak\n        share: 0.5\n"
                      "      - joint: m1/h\n        kind: late\n        delay: 0.03\n"
                      "  - t: 0.3\n    fault:\n      joint: \"*\"\n      kind: none\n"),
            std::string::npos)
      << text;
  expect_stable(s);
}

TEST_F(ChangesTest, ATemplateReadsTheSectionAgain) {
  const std::string path = folder_.write("t.yaml", with("[{t: 0.2, set: {cpg.amplitude: 0.3}}]"));
  const ScenarioTemplate text(path, {}, catalog_);
  EXPECT_EQ(frequency(text.with({"cpg.frequency=2"}).changes.at(0).cpg), 2);
  EXPECT_EQ(text.with({"at.0.t=0.4"}).changes.at(0).t, 0.4);
  EXPECT_EQ(text.with({"at=[]"}).changes.size(), 0U);
  EXPECT_EQ(resolved(text.with({"at=[]"})), resolved(read_scenario(path, {"at=[]"}, catalog_)));
  EXPECT_EQ(folder_.shown(test::message_of([&] { static_cast<void>(text.with({"duration=0.15"})); })),
            "DIR/t.yaml:6:10: error: t is 0.2 s, but the run ends at 0.15 s; expected an earlier time");
}

struct Wrong {
  const char* at;
  const char* column_and_text;
};

TEST_F(ChangesTest, WrongTimesAndForms) {
  for (const Wrong& one : {
           Wrong{"{t: 1}", "5: error: at is a map; expected a list of changes, such as [{t: 10, set: {cpg.frequency: 0.5}}]"},
           Wrong{"[soon]", "6: error: at[0] is 'soon'; expected a map"},
           Wrong{"[{set: {cpg.frequency: 1}}]", "6: error: missing key 't'"},
           Wrong{"[{t: 0.2}]", "6: error: at[0] changes nothing; expected set, fault or both"},
           Wrong{"[{t: 0.2, sets: {cpg.frequency: 1}}]", "15: error: unknown key 'sets'; did you mean 'set'?"},
           Wrong{"[{t: 0.5, set: {cpg.frequency: 1}}, {t: 0.2, set: {cpg.frequency: 2}}]",
                 "45: error: t is 0.2 s, not later than the change before it, at 0.5 s; expected rising times"},
           Wrong{"[{t: 0.5, set: {cpg.frequency: 1}}, {t: 0.5, set: {cpg.frequency: 2}}]",
                 "45: error: t is 0.5 s, not later than the change before it, at 0.5 s; expected rising times"},
           Wrong{"[{t: 25, set: {cpg.frequency: 1}}]",
                 "10: error: t is 25 s, but the run ends at 1 s; expected an earlier time"},
           Wrong{"[{t: 1, set: {cpg.frequency: 1}}]", "10: error: t is 1 s, but the run ends at 1 s; expected an earlier time"},
           Wrong{"[{t: -1, set: {cpg.frequency: 1}}]", "10: error: t is -1 s; expected 0 to 1000000 s"},
       }) {
    const std::string text = error(with(one.at));
    EXPECT_EQ(text.substr(0, text.find('\n')), std::string("DIR/s.yaml:6:") + one.column_and_text) << one.at;
  }
}

/// The cost is proportional to the number of entries: 16 times as many entries cost 16 times as much, not 256 times. This
/// includes entries with equal times, which are errors.
TEST_F(ChangesTest, TheCostGrowsWithTheNumberOfEntries) {
  const auto cost = [&](int entries) {
    std::string at;
    for (int k = 0; k < entries; ++k) at += "{t: 0.5, set: {cpg.amplitude: 0.5}}, ";
    return test::cost_of([&] { (void)error(with("[" + at + "]")); });
  };
  EXPECT_LT(cost(2048) / cost(128), 64);
}

TEST_F(ChangesTest, WrongSettings) {
  for (const Wrong& one : {
           Wrong{"[{t: 0.2, set: 3}]", "20: error: at[0].set is 3; expected settings by key, such as {cpg.frequency: 0.5}"},
           Wrong{"[{t: 0.2, set: {}}]",
                 "20: error: at[0].set is empty; expected settings by key, such as {cpg.frequency: 0.5}"},
           Wrong{"[{t: 0.2, set: {cpg: 1}}]", "21: error: cpg is a section; expected a key of it, such as cpg.frequency"},
           Wrong{"[{t: 0.2, set: {cpg.type: hopf}}]",
                 "21: error: cpg.type cannot change in a run, because it sets the plugins, their states or the control ticks"},
           Wrong{"[{t: 0.2, set: {controller.period: 0.01}}]",
                 "21: error: controller.period cannot change in a run, because it sets the plugins, their states or the "
                 "control ticks"},
           Wrong{"[{t: 0.2, set: {cpg.step: 0.01}}]",
                 "21: error: cpg.step cannot change in a run, because it sets the plugins, their states or the control ticks"},
           Wrong{"[{t: 0.2, set: {actuator.R: 5}}]",
                 "21: error: 'actuator.R' cannot change in a run; a fault of kind weak, open or dead changes a motor"},
           Wrong{"[{t: 0.2, set: {duration: 5}}]",
                 "21: error: 'duration' cannot change in a run; expected a key of cpg or controller"},
           Wrong{"[{t: 0.2, set: {cgp.frequency: 5}}]",
                 "21: error: 'cgp.frequency' cannot change in a run; expected a key of cpg or controller; did you mean "
                 "'cpg.frequency'?"},
           Wrong{"[{t: 0.2, set: {cpg.frequncy: 5}}]", "21: error: unknown key 'frequncy'; did you mean 'frequency'?"},
           Wrong{"[{t: 0.2, set: {cpg.frequency: 50}}]", "36: error: frequency is 50 Hz; expected 0 to 20 Hz"},
           Wrong{"[{t: 0.2, set: {cpg.frequency.m7/h: 5}}]", "21: error: no joint 'm7/h'; joints are m0/h, m1/h"},
       }) {
    const std::string text = error(with(one.at));
    EXPECT_EQ(text.substr(0, text.find('\n')), std::string("DIR/s.yaml:6:") + one.column_and_text) << one.at;
  }
  EXPECT_EQ(error(with("[{t: 0.2, set: {cpg.size: 32}}]", "cpg: {type: growing}")),
            "DIR/s.yaml:6:20: error: set changes the CPG's 16 states to 32 (size: Number of states); expected settings that "
            "keep the number of states");
}

TEST_F(ChangesTest, WrongFaults) {
  for (const Wrong& one : {
           Wrong{"[{t: 0.2, fault: m0/h}]", "22: error: at[0].fault is 'm0/h'; expected a map"},
           Wrong{"[{t: 0.2, fault: []}]", "22: error: at[0].fault is an empty list; expected {joint: NAME, kind: KIND}"},
           Wrong{"[{t: 0.2, fault: {joint: m0/h}}]", "22: error: missing key 'kind'"},
           Wrong{"[{t: 0.2, fault: {kind: dead}}]", "22: error: missing key 'joint'"},
           Wrong{"[{t: 0.2, fault: {joint: m0/h, kind: daed}}]", "42: error: kind 'daed' is unknown; did you mean 'dead'?"},
           Wrong{"[{t: 0.2, fault: {joint: m7/h, kind: dead}}]", "30: error: no joint 'm7/h'; joints are m0/h, m1/h"},
           Wrong{"[{t: 0.2, fault: {joint: 'm7/*', kind: dead}}]", "30: error: no joint matches 'm7/*'; did you mean 'm0/*'?"},
           Wrong{"[{t: 0.2, fault: {joint: [], kind: dead}}]", "30: error: joint names no joint; expected a name or a pattern"},
           Wrong{"[{t: 0.2, fault: {joint: m0/h, kind: weak}}]", "22: error: missing key 'share'"},
           Wrong{"[{t: 0.2, fault: {joint: m0/h, kind: weak, share: 2}}]", "55: error: share is 2; expected 0 to 1"},
           Wrong{"[{t: 0.2, fault: {joint: m0/h, kind: dead, share: 1}}]",
                 "48: error: unknown key 'share'; known keys: joint, kind"},
           Wrong{"[{t: 0.2, fault: {joint: m0/h, kind: late}}]", "22: error: missing key 'delay'"},
           Wrong{
               "[{t: 0.2, fault: {joint: m0/h, kind: late, delay: 0.02}}]",
               "55: error: delay is 0.02 s; expected a whole multiple of the control period 0.015 s: delay: 0.015 or 0.03, or "
               "controller.period: 0.01 or 0.02"},
       }) {
    const std::string text = error(with(one.at));
    EXPECT_EQ(text.substr(0, text.find('\n')), std::string("DIR/s.yaml:6:") + one.column_and_text) << one.at;
  }
}

}  // namespace
}  // namespace gaitlab
