// Tests of the identification of servos: numbers of a known servo found again in its own logs, the same bits for any number of
// threads, intervals, logs held out, the servo file, and refused logs.
#include "identify/identify.h"

#include <cmath>
#include <numbers>

#include "identify/findings.h"
#include "identify/log_check.h"
#include "identify/servo_text.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace identify;

constexpr double kTorque = 1.5, kDry = 0.08, kGain = 2;  // of the servo that makes the logs, N m; duty per rad
constexpr double kVoltage = 6;                           // V

/// A mass on an arm, and logs of it that the program makes itself.
class Bench : public ::testing::Test {
 protected:
  Bench() {
    folder_.write("lever.yaml",
                  "gaitlab_module: 1\nname: lever\nbodies:\n  base: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}\n"
                  "  arm: {mass: 0.5, com: [0, 0, -0.15], inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]}\n"
                  "hinges: [{name: hinge, parent: base, child: arm, axis: [0, 1, 0], range: free}]\n");
  }
  static std::string text(double torque, double dry, const std::string& more = {}) {
    return fmt::format(
        "gaitlab: 1\nrobot: {{modules: ./lever.yaml, base: fixed, position: [0, 0, 1]}}\nground: {{type: none}}\n"
        "contact: {{\"on\": none}}\nphysics: {{engine: articulated, estimate: off}}\nduration: 2\n"
        "actuator: {{type: servo, voltage: {}, stall_torque: {}, no_load_speed: 6, dry_friction: {}{}}}\n"
        "controller: {{type: rc_servo, gain: 2, period: 0.005}}\n",
        kVoltage, torque, dry, more);
  }
  static double goal(double t, double rate) { return 0.9 * std::sin(rate * t); }
  /// A log of the true servo for goals of this rate; angles in multiples of `unit` rad.
  void write_log(const std::string& name, double rate, double gain, double unit = 1) {
    std::string table = "t,goal\n";
    for (int k = 0; k <= 200; ++k) table += fmt::format("{},{}\n", 0.01 * k, goal(0.01 * k, rate));
    folder_.write("goal.csv", table);
    const Scenario servo = read_scenario(
        folder_.write("true.yaml", text(kTorque, kDry) + "cpg: {type: table, model: {file: goal.csv, time: t, columns: "
                                                         "{m0/hinge: goal}, interpolation: linear, repeat: false}}\n"),
        {"trace.period=0.01", fmt::format("controller.gain={}", gain)}, catalog());
    const Recording r = run(servo);
    const Table trace(r.trace);
    std::string log = "t,goal,angle,duty\n";
    constexpr double kTick = 2 * std::numbers::pi / 4096;  // an encoder of 12 bits
    for (std::size_t k = 0; k < r.trace.rows(); ++k) {
      const double angle = kTick * std::round(trace.at(k, "joint.0.angle") / kTick);
      const double duty = std::clamp(trace.at(k, "joint.0.voltage_command") / kVoltage, -1.0, 1.0);
      log += fmt::format("{},{},{},{:.3f}\n", r.trace.at(k, 0), goal(r.trace.at(k, 0), rate), unit * angle, duty);
    }
    folder_.write(name, log);
  }
  /// With a stall current that the true torque contradicts: 1.5 N m at 6 rad/s need 1.5 A at 6 V.
  void write_bench(double torque = 1.2, double dry = 0.05, const std::string& columns = "angle: angle") {
    folder_.write("bench.yaml",
                  text(torque, dry, ", stall_current: 1.3") +
                      "cpg: {type: table, model: {file: log.csv, time: t, columns: {m0/hinge: goal}, interpolation: "
                      "linear, repeat: false}}\nmeasured: {file: log.csv, columns: {m0/hinge: {" +
                      columns + "}}}\n");
  }
  std::vector<BenchLog> bench(const std::vector<std::string>& logs) {
    std::vector<std::string> files;
    for (const std::string& log : logs) files.push_back(folder_ / log);
    return read_bench(folder_ / "bench.yaml", {}, files, catalog());
  }
  Identified identified(const std::vector<BenchLog>& logs, const std::vector<Key>& keys, int threads = 1,
                        const std::vector<Logged>& kinds = {Logged::angle}) {
    std::atomic<bool> stop = false;
    ErrorModels models(logs, keys, kinds, threads, stop);
    return identify::identify(models, {.seed = 1, .choose = false, .drawn = 1});
  }
  void expect_refused(const std::function<void()>& work, const std::string& part) {
    try {
      work();
      ADD_FAILURE() << "nothing is refused; expected " << part;
    } catch (const InputError& error) {
      EXPECT_TRUE(contains(error.what(), part)) << error.what();
    }
  }
  Folder folder_;
};

TEST_F(Bench, FindsTheNumbersOfItsOwnLogs) {
  write_log("slow.csv", 2, 2);
  write_log("fast.csv", 5, 2);
  write_log("stiff.csv", 4, 4);
  folder_.write("logs.csv", "file,controller.gain\nslow.csv,2\nfast.csv,2\nstiff.csv,4\n");
  write_bench();
  std::vector<BenchLog> logs = bench({"logs.csv"});
  ASSERT_EQ(logs.size(), 3U);
  EXPECT_EQ(logs[0].group, logs[1].group);
  EXPECT_NE(logs[0].group, logs[2].group);
  EXPECT_NEAR(logs[0].scenario.duration, 2, 1e-9);
  check_logs(logs);
  hold_out(logs, {"stiff"}, 0, 1);
  const std::vector<Key> keys = fitted_keys(logs[0].scenario, {"actuator.stall_torque", "actuator.dry_friction"});
  const Identified made = identified(logs, keys);
  // A tick of the encoder is 2e-3 of the motion, and errors of some hundred rows average out; friction moves it a tenth as
  // much.
  EXPECT_NEAR(made.keys[0].value, kTorque, 0.005 * kTorque);
  EXPECT_NEAR(made.keys[1].value, kDry, 0.02 * kDry);
  EXPECT_LT(made.keys[0].low, made.keys[0].value);
  EXPECT_GT(made.keys[0].high, made.keys[0].value);
  EXPECT_LT(*mean_error(logs, made.after, Logged::angle, true), 0.1 * *mean_error(logs, made.before, Logged::angle, true));

  const Identified again = identified(logs, keys, 2);
  const auto servo = [&](const Identified& one) { return servo_text("own", folder_ / "bench.yaml", {}, one, logs, keys); };
  EXPECT_EQ(servo(again), servo(made));
  EXPECT_EQ(again.best.cost, made.best.cost);

  // The servo file is one: the bench with it gives the angles of the fit.
  folder_.write("own.yaml", servo(made));
  std::string text = read(folder_ / "bench.yaml");
  const std::size_t at = text.find("actuator: ");
  text.replace(at, text.find('\n', at) - at, "actuator: {type: servo, model: own.yaml}");
  folder_.write("bench.yaml", text);
  const std::vector<BenchLog> with = bench({"logs.csv"});
  const Identification& stated = with[0].scenario.identified;
  EXPECT_EQ(stated.logs, 2);
  EXPECT_EQ(stated.held_out_logs, 1);
  EXPECT_NEAR(stated.held_out, *mean_error(logs, made.after, Logged::angle, true), 0.005 * stated.held_out) << "three digits";
  EXPECT_GE(stated.speed, made.after[1].largest_speed);
  EXPECT_GE(stated.torque, made.after[1].largest_torque);
  EXPECT_LT(stated.torque, 1.01 * std::max(made.after[0].largest_torque, made.after[1].largest_torque));
  const std::vector<Key> own = fitted_keys(with[0].scenario, {"actuator.stall_torque"});
  std::atomic<bool> stop = false;
  ErrorModels models(with, own, {Logged::angle}, 1, stop);
  EXPECT_EQ(error_of(models.compared({})[0], Logged::angle), error_of(made.after[0], Logged::angle));

  // In a fit of one more key the others keep their source: they are not those of a data sheet.
  const std::string again_text = servo_text("again", folder_ / "bench.yaml", {}, identified(with, own), with, own);
  EXPECT_TRUE(contains(again_text, "of: [dry_friction], kind: identified, text: \"identified from 2 logs, fitted to "))
      << again_text;
  EXPECT_TRUE(contains(again_text, "of: [efficiency], kind: chosen, text: \"value of the bench; it does not follow"))
      << again_text;
  EXPECT_TRUE(contains(again_text, "kind: chosen, text: \"stated in the bench\"}")) << again_text;
  EXPECT_FALSE(contains(again_text, "data sheet")) << again_text;

  const std::vector<std::string> limits = findings(made, logs, keys);
  ASSERT_FALSE(limits.empty());
  EXPECT_TRUE(contains(limits[0], "angles alone are compared")) << limits[0];
}

TEST_F(Bench, TheDutySeparatesTheGainFromTheTorque) {
  write_log("slow.csv", 2, kGain);
  write_log("fast.csv", 5, kGain);
  write_bench(1.2, kDry, "angle: angle, duty: duty");
  const std::vector<BenchLog> logs =
      read_bench(folder_ / "bench.yaml", {"controller.gain=3"}, {folder_ / "slow.csv", folder_ / "fast.csv"}, catalog());
  const std::vector<Key> keys =
      fitted_keys(logs[0].scenario, {"actuator.stall_torque", "controller.gain", "actuator.no_load_speed"});
  // The angle follows from gain times stall_torque, and from stall_torque / no_load_speed.
  EXPECT_GT(std::abs(identified(logs, keys).keys[1].value / kGain - 1), 0.02);
  const Identified both = identified(logs, keys, 1, {Logged::angle, Logged::duty});
  // The duty has three digits, the angle 12 bits.
  EXPECT_NEAR(both.keys[0].value, kTorque, 0.005 * kTorque);
  EXPECT_NEAR(both.keys[1].value, kGain, 0.005 * kGain);
  for (const std::string& limit : findings(both, logs, keys)) EXPECT_FALSE(contains(limit, "angles alone")) << limit;
}

/// The interval of three logs is that of fits to two of them each: Student's t of two degrees of freedom is 4.303.
TEST_F(Bench, TheIntervalIsThatOfFitsWithoutALog) {
  const std::vector<std::string> names{"slow.csv", "fast.csv", "middle.csv"};
  write_log(names[0], 2, 2);
  write_log(names[1], 5, 2);
  write_log(names[2], 3.5, 2);
  write_bench(1.2, 0.3);  // wrong friction, so that each log asks for another torque
  const auto fit = [&](const std::vector<std::string>& some) {
    const std::vector<BenchLog> logs = bench(some);
    return identified(logs, fitted_keys(logs[0].scenario, {"actuator.stall_torque"})).keys[0];
  };
  const IdentifiedKey all = fit(names);
  const std::array changes{fit({names[1], names[2]}).value - all.value, fit({names[0], names[2]}).value - all.value,
                           fit({names[0], names[1]}).value - all.value};
  const double mean = (changes[0] + changes[1] + changes[2]) / 3;
  double squares = 0;
  for (const double change : changes) squares += (change - mean) * (change - mean);
  const double half = 4.303 * std::sqrt(2.0 / 3 * squares);
  // The program has a step of second-order models where this test has fits, and rounds to the digits of the interval.
  EXPECT_NEAR((all.high - all.low) / 2, half, 0.15 * half);
}

TEST_F(Bench, AKeyThatEarnsNothingStays) {
  write_log("slow.csv", 2, 2);
  write_log("fast.csv", 5, 2);
  write_bench(1.2, kDry);  // the dry friction of the bench is right
  std::vector<BenchLog> logs = bench({"slow.csv", "fast.csv"});
  hold_out(logs, {}, 0, 1);
  std::vector<Key> keys = fitted_keys(logs[0].scenario, {"actuator.stall_torque", "actuator.dry_friction"});
  std::atomic<bool> stop = false;
  ErrorModels models(logs, keys, {Logged::angle}, 1, stop);
  const Identified made = identify::identify(models, {.seed = 1, .choose = true, .drawn = 0});
  EXPECT_TRUE(made.keys[0].fitted);
  EXPECT_NEAR(made.keys[0].value, kTorque, 0.005 * kTorque);
  EXPECT_FALSE(made.keys[1].fitted);
  EXPECT_EQ(made.keys[1].value, kDry);
}

TEST_F(Bench, FarStartsEndInTheSamePlaceAndBoundsAreNamed) {
  write_log("slow.csv", 2, 2);
  write_log("fast.csv", 5, 2);
  write_bench(0.4, kDry);  // a quarter of the torque
  std::vector<BenchLog> logs = bench({"slow.csv", "fast.csv"});
  hold_out(logs, {}, 0, 1);
  const auto fitted = [&](const std::string& key) { return identified(logs, fitted_keys(logs[0].scenario, {key})); };
  EXPECT_NEAR(fitted("actuator.stall_torque").keys[0].value, kTorque, 0.005 * kTorque);
  const Identified bounded = fitted("actuator.stall_torque=0.5:1");
  EXPECT_EQ(bounded.keys[0].value, 1);
  EXPECT_TRUE(bounded.keys[0].at_bound);
  EXPECT_EQ(bounded.before[0].errors->joints[0].of(Logged::angle)->mae,
            fitted("actuator.stall_torque").before[0].errors->joints[0].of(Logged::angle)->mae);
}

TEST_F(Bench, RefusesLogsThatNoServoRecorded) {
  const auto refused = [&](double unit, const std::string& columns, const std::string& part, const std::string& edit = {}) {
    write_log("slow.csv", 2, 2, unit);
    write_bench(1.2, 0.05, columns);
    if (!edit.empty()) folder_.write("slow.csv", edit);
    expect_refused([&] { check_logs(bench({"slow.csv"})); }, part);
  };
  refused(57.3, "angle: angle", "which look like degrees");
  refused(1e-3, "angle: angle", "expected a motion");
  refused(1, "angle: angle, duty: {column: goal, scale: 0.01}", "the duty reaches 90");
  refused(1, "angle: angle, current: {column: goal, scale: 0.001}", "mA have 1000 as scale");
  refused(1, "angle: angle", "look like ticks", "t,goal,angle\n0,0,0\n0.1,0,300\n0.2,0,900\n");
  refused(1, "angle: angle", "at row 3, and stays there", "t,goal,angle\n0,0,0\n0.1,0,0.01\n0.2,0,6\n0.3,0,6.1\n0.4,0,6.2\n");
  refused(1, "angle: angle", "times must rise", "t,goal,angle\n0,0,0\n0.1,0,1\n0.1,0,1\n");
  refused(1, "angle: angle", "line 3, column 7", "t,goal,angle\n0,0,0\n0.1,0,nan\n");
  refused(1, "angle: angle", "expected cells between commas", "t;goal;angle\n0;0;0\n");
  refused(1, "angle: angle", "the table is empty", "\n");
  refused(1, "angle: angle", "expected times in s", "t,goal,angle\n0,0,0\n5,0,0.1\n10,0,0.2\n");
  write_log("slow.csv", 2, 2);
  write_bench();
  folder_.write("copy.csv", read(folder_ / "slow.csv"));
  expect_refused([&] { check_logs(bench({"slow.csv", "copy.csv"})); }, "name each log once");
}

/// Rows with other angles than the servo had: with them a log is refused, and without them it is the log before.
TEST_F(Bench, SpikesAreNamedAndLeftOut) {
  write_log("slow.csv", 2, 2);
  write_bench();
  const std::vector<BenchLog> clean = bench({"slow.csv"});
  const MeasuredLog& before = *clean[0].scenario.measured.log;
  std::istringstream rows(read(folder_ / "slow.csv"));
  std::string csv = "# a comment\n";
  std::string json = "{\"entries\": [";
  std::string row;
  std::getline(rows, row);
  csv += row + "\n";
  const std::vector<std::size_t> spikes{0, 50, 51, 120, 200};
  for (std::size_t k = 0; std::getline(rows, row); ++k) {
    std::vector<std::string> cells(1);
    for (const char c : row) c == ',' ? (void)cells.emplace_back() : cells.back().push_back(c);
    if (std::ranges::count(spikes, k) > 0) cells[2] = k == 120 ? "-9" : "7";
    csv += fmt::format("{}\n", fmt::join(cells, ","));
    json += fmt::format("{}{{\"t\": {}, \"goal\": {}, \"angle\": {}}}", k == 0 ? "" : ", ", cells[0], cells[1], cells[2]);
  }
  folder_.write("slow.csv", csv);
  folder_.write("slow.json", json + "]}");
  for (const std::string name : {"slow.csv", "slow.json"}) {
    expect_refused([&] { check_logs(bench({name})); },
                   "at rows 1, 51, 52, 121, 201; remove these rows, or leave them out with --drop-spikes");
    const std::vector<BenchLog> logs = read_bench(folder_ / "bench.yaml", {}, {folder_ / name}, catalog(), true);
    check_logs(logs);
    EXPECT_EQ(logs[0].left_out, spikes);
    EXPECT_NE(logs[0].hash, clean[0].hash) << "the hash is that of the file";
    const MeasuredLog& left = *logs[0].scenario.measured.log;
    for (std::size_t k = 0, to = 0; k < before.t.size(); ++k) {
      if (std::ranges::count(spikes, k) > 0) continue;
      ASSERT_LT(to, left.t.size());
      EXPECT_NEAR(left.t[to], before.t[k] - before.t[1], 1e-12);
      EXPECT_EQ(left.joints[0].of(Logged::angle)[to++], before.joints[0].of(Logged::angle)[k]);
    }
  }
}

TEST_F(Bench, RefusesWhatCannotBeFitted) {
  write_log("slow.csv", 2, 2);
  write_log("fast.csv", 5, 2);
  write_bench();
  std::vector<BenchLog> logs = bench({"slow.csv", "fast.csv"});
  expect_refused([&] { hold_out(logs, {"none*"}, 0, 1); }, "no log matches 'none*'");
  expect_refused([&] { hold_out(logs, {"fast"}, 0, 1); }, "1 of 2 logs would be fitted; expected at least 2");
  expect_refused([&] { hold_out(logs, {}, 0.5, 1); }, "expected at least 2");
  hold_out(logs, {}, 0.25, 1);
  const std::vector<Key> usual = fitted_keys(logs[0].scenario, {});
  std::vector<Key> many;
  for (int k = 0; k < 4; ++k) many.insert(many.end(), usual.begin(), usual.end());
  expect_refused([&] { check_fit(logs, Logged::angle, many); }, "24 keys cannot follow from");
  expect_refused([&] { check_fit(logs, Logged::torque, {usual[0]}); }, "no column of the bench has the torque");
  logs[0].of_table = {"actuator.stall_torque=1"};
  expect_refused([&] { check_fit(logs, Logged::angle, {usual[0]}); }, "actuator.stall_torque has a value per log in the table");
  const auto keys = [&](const std::string& asked) { return fitted_keys(logs[0].scenario, {asked}); };
  expect_refused([&] { keys("actuator.stal_torque"); }, "did you mean 'actuator.stall_torque'?");
  expect_refused([&] { keys("controller.latency"); }, "expected a range, as in --fit controller.latency=LOW:HIGH");
  expect_refused([&] { keys("actuator.stall_torque=3:1"); }, "expected LOW:HIGH with LOW below HIGH");
  EXPECT_EQ(keys("actuator.stall_torque=1:3")[0].high, 3);
  folder_.write("bench.yaml", text(1, 0.05) + "cpg: {type: none}\n");
  expect_refused([&] { bench({"slow.csv"}); }, "the bench has no measured.file");
}

}  // namespace
}  // namespace gaitlab::test
