// Tests of servo files with the logs of their numbers: the verdict names these logs, and warns beyond their speeds and torques.
#include "core/robot_files/identification.h"

#include "core/scenario/resolved.h"
#include "report/analysis/motors.h"
#include "report/verdict/verdict.h"
#include "tests/program/fixture.h"
#include "tests/program/rod.h"

namespace gaitlab::test {
namespace {

/// A servo of 40 N m moves a rod of 1 kg and 1 m, from scenarios that name its file.
class Identified : public ::testing::Test {
 protected:
  Identified() { write("logs: 8, held_out_logs: 4, held_out: 0.0436, speed: 50, torque: 100"); }
  void write(const std::string& identified, const std::string& source = "source: a bench") {
    folder_.write("mine.yaml", "gaitlab_servo: 1\nname: mine\n" + source + "\nidentified: {" + identified +
                                   "}\nactuator: {type: servo, voltage: 6, stall_torque: 40, no_load_speed: 20, "
                                   "dry_friction: 1, viscous_friction: 0.1, load_friction: 0.1, rotor_inertia: 0.01}\n");
  }
  Scenario with(const std::string& actuator, const std::string& of_module = {}, const std::string& of_hinge = {},
                const std::vector<std::string>& sets = {}) {
    std::string text = rod(of_hinge.empty() ? "" : ", actuator: {" + of_hinge + "}");
    const std::string name = "    name: rod\n";
    if (!of_module.empty()) text.replace(text.find(name), name.size(), name + "    actuator: {" + of_module + "}\n");
    if (!actuator.empty()) text += "actuator: {" + actuator + "}\n";
    return read_scenario(folder_.write("s.yaml", text + "cpg: {type: sine, frequency: 0.5, amplitude: 0.5}\nduration: 6\n"
                                                        "contact: {\"on\": none}\nground: {type: none}\n"
                                                        "physics: {engine: articulated, estimate: off}\n"),
                         sets, catalog());
  }
  static std::int64_t logs(const Scenario& s) { return report::identifications(s)[0].logs; }
  static report::Verdict judged(const Scenario& s) {
    const Recording record = run(s);
    return report::verdict(s, record, report::summarise(s, record, 0), report::overlaps(s, record));
  }
  Folder folder_;
  const std::string model_ = "type: servo, model: " + (folder_ / "mine.yaml");
};

TEST_F(Identified, TheVerdictNamesTheLogs) {
  for (const Scenario& s : {with(model_), with("", model_),
                            with("", "type: servo, voltage: 6, stall_torque: 1, no_load_speed: 6, source: a sheet",
                                 "model: " + (folder_ / "mine.yaml"))}) {
    EXPECT_EQ(logs(s), 8);
    const report::Verdict made = judged(s);
    EXPECT_EQ(made.figures, "motors: identified from 8 logs (held-out MAE 43.6 mrad)");
    EXPECT_FALSE(made.chosen_motors);
    EXPECT_TRUE(contains(to_json(made), "\"figures\": \"motors: identified from 8 logs (held-out MAE 43.6 mrad)\""));
    const report::Check& check = *std::ranges::find(made.checks, "identified", &report::Check::id);
    EXPECT_EQ(check.status, report::CheckStatus::pass) << check.text;
    EXPECT_TRUE(check.concerns);
  }
  EXPECT_EQ(judged(with(model_ + ", u_max: 5")).figures,
            "motors: identified from 8 logs (held-out MAE 43.6 mrad); the rest: chosen figures");
  write("logs: 1");
  EXPECT_EQ(judged(with(model_)).figures, "motors: identified from 1 log (none held out)");
  write("logs: 8, held_out_logs: 4, held_out: 0.05, held_out_before: 0.04");
  EXPECT_EQ(judged(with(model_)).figures,
            "motors: identified from 8 logs (held-out MAE 50 mrad, worse than 40 mrad before the fit)");
  EXPECT_THROW(with("", model_ + ", identified: {logs: 3, error: -1}"), InputError);
  EXPECT_THROW(with("", model_ + ", identified: {logs: 3, foo: 1}"), InputError);
  EXPECT_THROW(with("", model_ + ", identified: {logs: 3, held_out_logs: 1}"), InputError);
  EXPECT_THROW(with(model_ + ", identified: {logs: 3, held_out_logs: 1}"), InputError);
}

/// A number in the place of an identified one ends the identification; a limit, or a number of currents, does not.
TEST_F(Identified, AnotherNumberEndsIt) {
  EXPECT_EQ(logs(with(model_ + ", stall_torque: 30")), 0);
  EXPECT_EQ(logs(with(model_ + ", i_max: 3, efficiency: 0.5")), 8);
  EXPECT_EQ(logs(with("dry_friction: 0.5", model_)), 0);
  EXPECT_EQ(logs(with("u_max: 5, source: the supply", model_)), 8);
  EXPECT_EQ(logs(with("", model_, "viscous_friction: 0.2")), 0);
  EXPECT_EQ(logs(with(model_, "", "", {"actuator.rotor_inertia=0.02"})), 0);
  EXPECT_EQ(logs(with("type: servo, voltage: 6, stall_torque: 40, no_load_speed: 20, source: a sheet")), 0);
  EXPECT_TRUE(judged(with(model_ + ", stall_torque: 30")).figures.starts_with("motors: chosen figures"));
}

/// A hinge with a number of its own has no logs, and its number no source; other numbers than those of logs are the rest.
TEST_F(Identified, TheRestIsThatOfJointsWithoutLogs) {
  const auto figures = [&](const std::string& type, const std::string& hinge) {
    const std::string body = ": {mass: 0.1, com: [0, 0, -0.1], inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]}\n";
    const std::string joint = ", parent: base, axis: [0, 1, 0], range: free";
    return judged(read_scenario(
                      folder_.write("two.yaml",
                                    "gaitlab: 1\nrobot:\n  base: fixed\n  modules:\n    gaitlab_module: 1\n    name: two\n"
                                    "    actuator: {" +
                                        type + "}\n    bodies:\n      base" + body + "      a" + body + "      b" + body +
                                        "    hinges:\n      - {name: one, child: a" + joint + ", actuator: {" + hinge +
                                        "}}\n      - {name: other, child: b" + joint +
                                        "}\ncontroller: {type: rc_servo, gain: 3}\n"
                                        "cpg: {type: sine, frequency: 0.5, amplitude: 0.5}\nduration: 6\n"
                                        "contact: {\"on\": none}\nground: {type: none}\n"
                                        "physics: {engine: articulated, estimate: off}\n"),
                      {}, catalog()))
        .figures;
  };
  const std::string logs = "motors: identified from 8 logs (held-out MAE 43.6 mrad)";
  const std::string sheet =
      "type: servo, voltage: 6, stall_torque: 40, no_load_speed: 20, dry_friction: 1, viscous_friction: 0.1, "
      "load_friction: 0.1, rotor_inertia: 0.01, source: a sheet";
  EXPECT_EQ(figures(model_, "u_max: 5, source: the supply"), logs);
  EXPECT_EQ(figures(model_, "dry_friction: 2"), logs + "; the rest: chosen figures (no source stated)");
  EXPECT_EQ(figures(sheet, "model: " + (folder_ / "mine.yaml")), logs + "; the rest: a sheet");
}

/// A setting of the controller that the servo has from logs belongs to the motor.
TEST_F(Identified, AnotherControllerEndsIt) {
  folder_.write("mine.yaml",
                "gaitlab_servo: 1\nname: mine\nidentified: {logs: 8}\n"
                "sources:\n  - {of: [voltage, stall_torque, no_load_speed, latency], kind: identified, text: a bench}\n"
                "  - {of: [gain], kind: data sheet, text: a sheet}\n"
                "actuator: {type: servo, voltage: 6, stall_torque: 40, no_load_speed: 20}\n"
                "controller: {type: rc_servo, gain: 3, latency: 0.007}\n");
  const auto read = [&](const std::string& controller, const std::vector<std::string>& sets = {}) {
    return with(model_ + "}\ncontroller: {" + controller, "", "", sets);
  };
  const std::string model = "model: " + (folder_ / "mine.yaml");
  EXPECT_EQ(logs(read(model)), 8);
  EXPECT_EQ(logs(read(model + ", gain: 5, latency: 0.007")), 8);
  EXPECT_EQ(logs(read(model + ", latency: 0.02")), 0);
  EXPECT_EQ(logs(read("type: rc_servo, gain: 3, latency: 0.02")), 0);
  EXPECT_EQ(logs(read(model, {"controller.latency=0.01"})), 0);
  const std::string text = resolved(read(model));
  EXPECT_EQ(logs(read_record(text, folder_ / "resolved.yaml", {"controller.gain=4"}, catalog())), 8);
  EXPECT_EQ(logs(read_record(text, folder_ / "resolved.yaml", {"controller.latency=0.01"}, catalog())), 0);
}

TEST_F(Identified, ARecordKeepsItAndASetEndsIt) {
  for (const Scenario& s : {with(model_), with("", model_)}) {
    const std::string text = resolved(s);
    const Scenario record = read_record(text, folder_ / "resolved.yaml", {}, catalog());
    EXPECT_EQ(report::identifications(record)[0], report::identifications(s)[0]);
    EXPECT_EQ(resolved(record), text);
    EXPECT_EQ(logs(read_record(text, folder_ / "resolved.yaml", {"actuator.stall_torque=30"}, catalog())), 0);
  }
  EXPECT_FALSE(contains(resolved(with("type: servo, voltage: 6, stall_torque: 40, no_load_speed: 20")), "identified"));
}

TEST_F(Identified, BeyondTheLogsTheVerdictWarns) {
  for (const auto& [identified, part] :
       {std::pair{"speed: 0.4, torque: 50", ", beyond the speed of the 8 logs of its motor: up to 0.4 rad/s"},
        {"speed: 50, torque: 0.7", ", beyond the torque of the 8 logs of its motor: up to 0.7 N m"},
        {"torque: 0.7", ", beyond the torque of the 8 logs of its motor: up to 0.7 N m"}}) {
    write(std::string("logs: 8, ") + identified);
    const report::Verdict made = judged(with(model_));
    EXPECT_EQ(made.figures, "motors: identified from 8 logs (none held out), which this run exceeds");
    const report::Check& check = *std::ranges::find(made.checks, "identified", &report::Check::id);
    EXPECT_EQ(check.status, report::CheckStatus::warn);
    EXPECT_TRUE(contains(check.text, part)) << check.text;
    EXPECT_LT(check.margin, 0);
    EXPECT_EQ(check.worst, "m0/swing");
  }
  write("logs: 8");
  const report::Verdict made = judged(with(model_));
  EXPECT_EQ(std::ranges::find(made.checks, "identified", &report::Check::id)->status, report::CheckStatus::not_judged);
}

TEST_F(Identified, FaultyKeysAreRefused) {
  const auto refused = [&](const std::string& identified, const std::string& part) {
    write(identified);
    try {
      with(model_);
      ADD_FAILURE() << identified;
    } catch (const InputError& error) {
      EXPECT_TRUE(contains(error.what(), part)) << error.what();
    }
  };
  refused("held_out: 0.04", "mine.yaml:4:13: error: identified has no logs; expected their number, as in {logs: 8}");
  refused("logs: 8, speeds: 3", "mine.yaml:4:23: error: unknown key 'speeds'; did you mean 'speed'?");
  refused("logs: -1", "mine.yaml:4:20");
  refused("logs: 8, held_out_logs: 4",
          "mine.yaml:4:38: error: held_out_logs has no held_out; expected the error of these logs");
  refused("logs: 8, held_out: 0.04", "mine.yaml:4:33: error: held_out has no held_out_logs; expected their number");
}

TEST(Identification, TextsHaveTheirUnits) {
  Identification one{.logs = 8, .held_out_logs = 8, .error = 0.0245, .held_out = 0.0436, .held_out_before = 0.0452};
  EXPECT_EQ(short_text(one), "identified from 8 logs (held-out MAE 43.6 mrad)");
  one.speed = 13.2;
  one.torque = 0.5;
  one.by = "Rhoban/bam";
  EXPECT_EQ(
      long_text(one),
      "identified from 8 logs of Rhoban/bam, fitted to 24.5 mrad, held-out error 43.6 mrad on 8 logs (45.2 mrad before the "
      "fit), speeds up to 13.2 rad/s, torques up to 0.5 N m");
  one.quantity = Identification::Quantity::torque;
  EXPECT_EQ(short_text(one), "identified from 8 logs (held-out MAE 0.0436 N m)");
}

}  // namespace
}  // namespace gaitlab::test
