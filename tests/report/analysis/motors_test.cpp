// Tests of the source of motor data: module types, the scenario, or defaults of an actuator.
#include "report/analysis/motors.h"

#include <algorithm>

#include "core/scenario/resolved.h"
#include "report/verdict/verdict.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using report::chosen;
using report::figures_sentence;
using report::motor_source;

constexpr const char* kServo =
    "type: servo, voltage: 5, stall_torque: 1, no_load_speed: 6, load_friction: 0, dry_friction: 0, viscous_friction: 0, "
    "rotor_inertia: 0";
const std::string kDefaults =
    "R 4.3 ohm, Kt 0.00395 N m/A, Ks 0.00395 V s/rad, gear 594, efficiency 0.7, u_max 7.4 V, i_max 1.2 A";

/// Module type of two bodies and a hinge. `motor` is its actuator and `hinge` further keys of its
/// hinge, both in YAML.
std::string type_with(const std::string& name, const std::string& motor, const std::string& hinge = "") {
  return fmt::format(R"(    {0}:
      gaitlab_module: 1
      name: {0}
      bodies:
        tail: {{mass: 0.09, com: [-0.015, 0, 0], inertia: [5e-05, 3e-05, 3e-05, 0, 0, 0]}}
        head: {{mass: 0.05, com: [0.015, 0, 0], inertia: [3e-05, 2e-05, 2e-05, 0, 0, 0]}}
      hinges: [{{name: hinge, parent: tail, child: head, axis: [0, 1, 0], range: [-1.5, 1.5]{2}}}]
      faces:
        - {{id: 0, body: tail, gender: active, origin: [-0.03, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}}
        - {{id: 1, body: head, gender: passive, origin: [0.03, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}}
      contacts: {{feet: [{{body: head, point: [0.03, 0, -0.03]}}, {{body: tail, point: [-0.03, 0, -0.03]}}]}}
{1})",
                     name, motor.empty() ? "" : "      actuator: {" + motor + "}\n", hinge);
}

/// Scenario text of a row of modules, one of each type. `more` is further sections.
std::string row_of(const std::vector<std::string>& types, const std::string& modules, const std::string& more = "") {
  std::string docks;
  for (std::size_t m = 1; m < types.size(); ++m) docks += fmt::format("{}[0, {}, 1, {}, 0]", m > 1 ? ", " : "", m, m - 1);
  return fmt::format("robot:\n  modules: {}\n  docks: [{}]\n  types:\n{}physics: {{engine: articulated}}\nduration: 0.1\n{}",
                     modules, docks, fmt::join(types, ""), more);
}

std::string one(const std::string& motor, const std::string& more = "", const std::string& hinge = "") {
  return row_of({type_with("a", motor, hinge)}, "a", more);
}

Scenario with_type(const std::string& motor, const std::string& actuator, const std::vector<std::string>& sets = {}) {
  const bool torque = contains(actuator, "torque,") || actuator.ends_with("torque");
  return scenario(one(motor, "actuator: {" + actuator + "}\n" + (torque ? "controller: {unit: N m}\n" : "")), sets);
}

std::string source(const std::string& text) { return motor_source(scenario(text)); }

/// Notes of a scenario as printed, without the folder.
std::vector<std::string> notes(const Scenario& s) {
  std::vector<std::string> all;
  for (const Note& note : s.notes) {
    const std::string line = to_string(note.place) + ": note: " + note.text;
    all.push_back(line.starts_with('/') ? line.substr(line.find("test.yaml")) : line);
  }
  return all;
}

report::Verdict judged(const Scenario& s) {
  const Recording record = run(s);
  return report::verdict(s, record, report::summarise(s, record, 0), report::overlaps(s, record));
}

TEST(MotorSource, AnotherTypeDropsTheFiguresOfTheModuleTypeAndSaysSo) {
  const Scenario s =
      shipped("library/dtto-caterpillar.yaml", {"actuator.type=dc_motor", "duration=0.3", "physics.engine=articulated"});
  EXPECT_EQ(
      notes(s).at(0),
      "--set actuator.type=dc_motor: note: the module type dtto states voltage, stall_torque, no_load_speed, i_continuous "
      "for actuator servo, which are dropped: actuator dc_motor takes its own defaults " +
          kDefaults + "; give these and source under actuator, or leave type out");
  EXPECT_EQ(motor_source(s), "chosen: no source stated");
  const report::Verdict made = judged(s);
  EXPECT_TRUE(made.chosen_motors);
  EXPECT_EQ(made.figures, "motors: chosen figures (no source stated)");
  EXPECT_TRUE(contains(to_json(made), "\"figures\": \"motors: chosen figures (no source stated)\""));
}

TEST(MotorSource, TheNoteStandsWhereTheTypeDoes) {
  const std::string text = one(kServo, "actuator:\n  type: dc_motor\n");
  const std::size_t line = static_cast<std::size_t>(std::ranges::count(text.substr(0, text.find("dc_motor")), '\n')) + 1;
  EXPECT_EQ(notes(scenario(text)),
            (std::vector<std::string>{fmt::format(
                "test.yaml:{}:9: note: the module type a states voltage, stall_torque, no_load_speed, load_friction, "
                "dry_friction, viscous_friction, rotor_inertia for actuator servo, which "
                "are dropped: actuator dc_motor takes its own defaults {}; give these and source under actuator, or leave "
                "type out",
                line, kDefaults)}));
}

TEST(MotorSource, DefaultsThatFollowFromOtherFiguresAreNamedWithoutANumber) {
  const std::vector<std::string> all =
      notes(with_type("type: dc_motor, R: 2, gear: 50", "type: servo, voltage: 6, stall_torque: 1, no_load_speed: 6"));
  ASSERT_FALSE(all.empty());
  EXPECT_TRUE(contains(all[0], "its own defaults load_friction, dry_friction, viscous_friction, rotor_inertia; give"))
      << all[0];
}

/// If the scenario states all motor data, there is no note.
TEST(MotorSource, OfFiguresThatTheScenarioGivesThereIsNoNote) {
  EXPECT_EQ(notes(with_type(kServo, "type: dc_motor, R: 2, Kt: 0.01, Ks: 0.01, gear: 50, efficiency: 0.8, u_max: 12")),
            std::vector<std::string>{
                "test.yaml:19:18: note: the module type a states voltage, stall_torque, no_load_speed, load_friction, "
                "dry_friction, viscous_friction, rotor_inertia for actuator servo, which "
                "are dropped: actuator dc_motor takes its own default i_max 1.2 A; give this and source under actuator, or "
                "leave type out"});
  const std::string all = "type: dc_motor, R: 2, Kt: 0.01, Ks: 0.01, gear: 50, efficiency: 0.8, u_max: 12, i_max: 2";
  EXPECT_TRUE(notes(with_type(kServo, all)).empty());
  EXPECT_EQ(motor_source(with_type(kServo, all)), "chosen: no source stated");
  EXPECT_EQ(motor_source(with_type(kServo, all + ", source: maxon 118752")), "maxon 118752");
  EXPECT_FALSE(chosen(motor_source(with_type(kServo, all + ", source: maxon 118752"))));
  EXPECT_TRUE(notes(with_type(kServo, "type: torque, limit: 2")).empty());
  EXPECT_EQ(notes(with_type(kServo, "type: torque")).size(), 1U) << "of an ideal source without a limit";
  EXPECT_TRUE(notes(with_type(kServo, "type: servo, u_max: 4")).empty()) << "the same type";
  EXPECT_TRUE(notes(with_type(kServo, "type: none")).empty());
  EXPECT_EQ(motor_source(with_type(kServo, "type: none")), "");
}

/// A source in the scenario applies to the values of the scenario. Defaults of the actuator count as chosen.
TEST(MotorSource, DefaultsOfAnotherTypeAreChosen) {
  const Scenario s = with_type(kServo, "type: dc_motor, R: 2, Kt: 0.01, Ks: 0.01, u_max: 12, i_max: 2, source: maxon 118752");
  EXPECT_EQ(motor_source(s), "chosen: gear, efficiency by default of dc_motor; the rest: maxon 118752");
  EXPECT_EQ(notes(s).size(), 1U);
  EXPECT_EQ(motor_source(with_type(kServo, "type: torque, source: bench")), "bench") << "no limit is no figure";
}

TEST(MotorSource, OfFiguresThatTheScenarioGivesInstead) {
  const std::string stated = std::string(kServo) + ", source: data sheet 17";
  EXPECT_EQ(motor_source(with_type(stated, "u_max: 4")),
            "chosen: no source stated for u_max of the scenario; the rest: data "
            "sheet 17");
  EXPECT_EQ(motor_source(with_type(stated, "u_max: 4, source: supply X")),
            "u_max of the scenario: supply X; the rest: data "
            "sheet 17");
  EXPECT_EQ(motor_source(with_type(stated, "voltage: 5, source: supply X")), "data sheet 17") << "the same number";
  const std::string unsure = std::string(kServo) + ", source: 'Chosen: a guess'";
  EXPECT_EQ(motor_source(with_type(unsure, "u_max: 4, source: supply X")), "Chosen: a guess; u_max of the scenario: supply X");
  EXPECT_TRUE(chosen(motor_source(with_type(unsure, "u_max: 4, source: supply X"))));
  EXPECT_EQ(judged(with_type(stated, "u_max: 4")).figures,
            "motors: chosen figures (no source stated for u_max of the scenario)");
  EXPECT_FALSE(judged(with_type(stated, "u_max: 4, source: supply X")).chosen_motors);
}

/// A source in the file does not apply to values of --set.
TEST(MotorSource, OfTheFileIsNotThatOfSet) {
  const std::string stated = std::string(kServo) + ", source: data sheet 17";
  const Scenario other = with_type(stated, "u_max: 4, source: supply X", {"actuator.u_max=5"});
  EXPECT_TRUE(chosen(motor_source(other)));
  EXPECT_TRUE(
      contains(notes(other).at(0), "test.yaml: note: actuator: dropped source, which does not cover --set actuator.u_max=5"));
  EXPECT_EQ(motor_source(with_type(stated, "u_max: 4", {"actuator.u_max=5", "actuator.source=supply Y"})),
            "u_max of the scenario: supply Y; the rest: data sheet 17");
  EXPECT_TRUE(chosen(motor_source(with_type(stated, "source: supply X", {"actuator.type=dc_motor"}))));
  EXPECT_EQ(motor_source(with_type(stated, "u_max: 4, source: supply X", {"duration=0.2"})),
            "u_max of the scenario: supply X; the rest: data sheet 17");
}

/// Data without a source count as chosen. (Data of a servo without a source once counted as the manufacturer's.)
TEST(MotorSource, AMissingOneMeansChosen) {
  EXPECT_TRUE(chosen(""));
  EXPECT_EQ(source(one(kServo)), "chosen: no source stated");
  EXPECT_EQ(source(one("")), "chosen: no source stated") << "the defaults of dc_motor";
  EXPECT_EQ(source(one(std::string(kServo) + ", source: ''")), "chosen: no source stated");
  EXPECT_TRUE(judged(scenario(one(kServo))).chosen_motors);
  const report::Verdict made = judged(scenario(one(std::string(kServo) + ", source: data sheet 17")));
  EXPECT_FALSE(made.chosen_motors);
  EXPECT_EQ(made.figures, "motors: data sheet 17");
}

/// The settings of a hinge replace those of its module type key by key, and sources follow the values.
TEST(MotorSource, OfHingesIsTheirTypesWhereTheyHaveNone) {
  const std::string stated = std::string(kServo) + ", source: data sheet 17";
  EXPECT_EQ(source(one(stated, "", ", actuator: {stall_torque: 2}")), "data sheet 17");
  EXPECT_EQ(source(one(stated, "", ", actuator: {stall_torque: 2, source: bench}")), "data sheet 17; bench");
  EXPECT_EQ(source(one(kServo, "", ", actuator: {stall_torque: 2, source: bench}")), "chosen: no source stated; bench");
  EXPECT_EQ(source(one("type: dc_motor", "", ", actuator: {R: 2, Kt: 0.01, source: bench}")),
            "chosen: Ks, gear, efficiency, u_max, i_max by default of dc_motor; bench");
  const std::string rest = "Ks: 0.01, gear: 50, efficiency: 0.8, u_max: 12, i_max: 2";
  EXPECT_EQ(source(one("type: dc_motor", "", ", actuator: {R: 2, Kt: 0.01, source: bench, " + rest + "}")), "bench");
  EXPECT_EQ(
      source(one("type: dc_motor", "actuator: {source: mine, " + rest + "}\n", ", actuator: {R: 2, Kt: 0.01, source: bench}")),
      "Ks, gear, efficiency, u_max, i_max of the scenario: mine; the rest: bench");
  EXPECT_EQ(
      notes(scenario(one("type: dc_motor, gear: 50", "actuator: {type: torque}\ncontroller: {unit: N m}\n",
                         ", actuator: {R: 2, Kt: 0.01}"))),
      std::vector<std::string>{
          "test.yaml:19:18: note: the module type a states gear, R, Kt for actuator dc_motor, which are dropped: actuator "
          "torque takes its own default limit 0 N m; give this and source under actuator, or leave type out"});
}

/// If the module types state no motor, all motor data have the source of the scenario.
TEST(MotorSource, OfTheScenarioAlone) {
  const std::string most = "R: 2, Kt: 0.01, Ks: 0.01, gear: 50, efficiency: 0.7, u_max: 12";
  EXPECT_EQ(motor_source(with_type("", most + ", i_max: 2, source: maxon 118752")), "maxon 118752") << "0.7 is stated";
  EXPECT_EQ(motor_source(with_type("", most + ", source: maxon 118752")),
            "chosen: i_max by default of dc_motor; the rest: maxon 118752");
  EXPECT_EQ(motor_source(with_type("", std::string(kServo) + ", source: data sheet 17")), "data sheet 17");
  EXPECT_EQ(motor_source(with_type("", kServo)), "chosen: no source stated");
  EXPECT_TRUE(notes(with_type("", "type: dc_motor")).empty()) << "nothing is dropped";
}

TEST(MotorSource, OfSeveralModuleTypes) {
  const std::string stated = std::string(kServo) + ", source: data sheet 17";
  const auto pair = [&](const std::string& second, const std::string& more = "", const std::string& hinge = "") {
    return row_of({type_with("a", stated), type_with("b", second, hinge)}, "{0: a, 1: b}", more);
  };
  EXPECT_EQ(source(pair(stated)), "data sheet 17");
  EXPECT_EQ(source(pair(std::string(kServo) + ", source: bench")), "data sheet 17; bench");
  EXPECT_EQ(source(pair(kServo)), "chosen: no source stated; data sheet 17");
  EXPECT_EQ(source(pair("", "", ", drive: none")), "data sheet 17") << "no motor, no figure";
  const std::vector<std::string> both = notes(scenario(pair(kServo, "actuator: {type: dc_motor}\n")));
  ASSERT_EQ(both.size(), 2U) << "once for each type";
  EXPECT_TRUE(contains(both[0],
                       "the module type a states voltage, stall_torque, no_load_speed, load_friction, dry_friction, "
                       "viscous_friction, rotor_inertia for actuator servo"));
  EXPECT_TRUE(contains(both[1],
                       "the module type b states voltage, stall_torque, no_load_speed, load_friction, dry_friction, "
                       "viscous_friction, rotor_inertia for actuator servo"));
}

/// If the module types have different actuators and the scenario another one, the data of all types are dropped, also of types
/// with the actuator of the scenario.
TEST(MotorSource, OfModuleTypesThatDisagree) {
  const Scenario s = scenario(row_of({type_with("a", std::string(kServo) + ", source: data sheet 17"),
                                      type_with("b", "type: dc_motor, gear: 50, source: maxon 118752")},
                                     "{0: a, 1: b}", "actuator: {type: dc_motor}\n"));
  EXPECT_EQ(motor_source(s), "chosen: no source stated");
  ASSERT_EQ(notes(s).size(), 2U);
  EXPECT_TRUE(
      contains(notes(s)[0], "for actuator servo, which are dropped because the module types have different actuators: "));
  EXPECT_EQ(
      notes(s)[1].substr(notes(s)[1].find("note:")),
      "note: the module type b states gear for actuator dc_motor, which is dropped because the module types have different "
      "actuators: actuator dc_motor takes its own defaults " +
          kDefaults + "; give these and source under actuator");
}

/// The resolved scenario has the same motor data and sources, and no note.
TEST(MotorSource, SurvivesTheResolvedScenario) {
  const std::string stated = std::string(kServo) + ", source: data sheet 17";
  for (const char* actuator : {"u_max: 4", "u_max: 4, source: supply X", "type: dc_motor", "type: torque, source: 'bench: 2'",
                               "type: dc_motor, R: 2, source: maxon 118752"}) {
    const Scenario s = with_type(stated, actuator);
    const Scenario again = scenario(resolved(s));
    EXPECT_EQ(motor_source(again), motor_source(s)) << actuator;
    EXPECT_TRUE(notes(again).empty()) << actuator;
    EXPECT_EQ(resolved(again), resolved(s)) << actuator;
  }
  EXPECT_FALSE(contains(resolved(scenario(one(stated, "actuator: {u_max: 4}\n"))), "  source: ''"));
}

/// Actuator of a plugin, without default data of a real motor.
struct Pushes final : Actuator {
  struct Settings {
    double most = 2;
    void fields(Fields& f) { f.number("most", most, {"N m", 0, 10, "Largest torque."}); }
  };
  Pushes(const RobotInfo& robot, const std::vector<const Settings*>&) : limit_(robot.joints.size(), 2) {}
  [[nodiscard]] std::string_view command_unit() const override { return "V"; }
  [[nodiscard]] In command_limit() const override { return limit_; }
  void effort(In, In, Out, Out) const override {}
  void electrical(In, In, Electrical) const override {}
  std::vector<double> limit_;
};

TEST(MotorSource, OfPlugins) {
  Catalog all = app::standard_catalog();
  add_actuator<Pushes>(all, "pushes", "Pushes.");
  const Folder folder;
  const auto with = [&](const std::string& motor, const std::string& more) {
    return read_scenario(folder.write("test.yaml", one(motor, more)), {}, all);
  };
  EXPECT_EQ(motor_source(with("type: pushes, most: 3", "")), "chosen: no source stated");
  EXPECT_EQ(motor_source(with("type: pushes, most: 3, source: bench", "")), "bench");
  EXPECT_EQ(motor_source(with("type: pushes, most: 3, source: bench", "actuator: {most: 4}\n")),
            "chosen: no source stated for most of the scenario")
      << "it has no other figure";
  EXPECT_EQ(notes(with(kServo, "actuator: {type: pushes}\n")),
            std::vector<std::string>{
                "test.yaml:19:18: note: the module type a states voltage, stall_torque, no_load_speed, load_friction, "
                "dry_friction, viscous_friction, rotor_inertia for actuator servo, which "
                "are dropped: actuator pushes has none of them; give its keys and source under actuator, or leave type out"});
  EXPECT_TRUE(notes(with(kServo, "actuator: {type: pushes, most: 3}\n")).empty());
}

TEST(MotorSource, DefaultsThatDoNotCountAreNamed) {
  const auto defaults = [](const std::string& motor, const std::string& more) {
    return report::silent_defaults(scenario(one(motor, more)));
  };
  const std::string rotor = "rotor_inertia 0 (0.002 kg m^2 for a servo of 1 N m)";
  EXPECT_EQ(defaults("type: dc_motor", ""), "by default: " + rotor);
  EXPECT_EQ(defaults("type: dc_motor, rotor_inertia: 0", ""), "") << "a stated 0";
  EXPECT_EQ(defaults("type: dc_motor", "actuator: {rotor_inertia: 0.001}\n"), "");
  EXPECT_EQ(defaults(kServo, ""), "by default: efficiency 0.7");
  EXPECT_EQ(defaults(std::string(kServo) + ", stall_current: 2", ""), "");
  EXPECT_EQ(defaults(kServo, "actuator: {type: none}\n"), "");
}

TEST(MotorSource, InAFewWords) {
  using Sources = std::vector<std::string>;
  EXPECT_EQ(figures_sentence({"maxon catalogue 118752"}, {"chosen: after the M-TRAN"}),
            "motors: maxon catalogue 118752; docks: chosen figures");
  EXPECT_EQ(figures_sentence({}, {"rofi.fi.muni.cz", "rofi.fi.muni.cz"}), "docks: rofi.fi.muni.cz");
  EXPECT_EQ(figures_sentence({}, {"ours", "theirs"}), "docks: ours, theirs");
  EXPECT_EQ(figures_sentence({}, {"ours", "chosen: no source stated"}), "docks: chosen figures (no source stated)");
  EXPECT_EQ(figures_sentence({"table 1; a Dynamixel AX-12"}, {}), "motors: table 1");
  EXPECT_EQ(figures_sentence({"SG92R: README; i_continuous chosen: usable"}, {}), "motors: chosen figures");
  EXPECT_EQ(figures_sentence({"at 5 V, between 9.4 and 11 kgf cm, 0.17 and 0.14 s/60 degrees at 4.8 and 6.0 V"}, {}),
            "motors: at 5 V, between 9.4 and 11 kgf cm, 0.17 and 0.14 s/60 ...");
  EXPECT_EQ(figures_sentence({}, Sources{}), "");
}

}  // namespace
}  // namespace gaitlab::test
