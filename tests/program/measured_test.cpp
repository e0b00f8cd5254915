// Tests of the section `measured`: differences from a log recomputed from trace and log, interpolation against an analytic
// motion, torque that is switched off, quantities of studies, replayed commands, refused logs.
#include "report/analysis/measured.h"

#include <cmath>

#include "core/scenario/resolved.h"
#include "report/analysis/collisions.h"
#include "report/verdict/measure.h"
#include "report/verdict/verdict.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"
#include "tests/program/rod.h"

namespace gaitlab::test {
namespace {

using namespace report;

const std::string kBench =
    "ground: {type: none}\ncontact: {on: none}\nphysics: {engine: articulated, estimate: off}\n"
    "actuator: {type: servo, voltage: 6, stall_torque: 8, no_load_speed: 6, stall_current: 12}\n"
    "cpg: {type: sine, frequency: 0.5, amplitude: 0.6}\nduration: 2\n";
const std::string kLoop = "controller: {type: rc_servo, gain: 4, period: 0.01}\n";

/// A log as inline text, with rows every `step` seconds from `start` on: goal-like angle, duty in 885ths and torque switch.
std::string log_text(double step, double start = 0, double off_at = 1e9) {
  std::string text = "    clock,angle,pwm,on\n";
  for (int k = 0; k * step <= 2.5; ++k) {
    const double t = k * step;
    text += fmt::format("    {:.17g},{:.17g},{},{}\n", start + t, 0.5 * std::sin(3 * t), t > 0.5 && t < 0.75 ? 885 : 100,
                        t < off_at ? 1 : 0);
  }
  return text;
}

std::string measured(const std::string& log, const std::string& keys = {}) {
  return "measured:\n  time: clock\n" + keys +
         "  columns: {m0/swing: {angle: angle, duty: {column: pwm, scale: 885}}}\n  file: |\n" + log;
}

TEST(Measured, ErrorsAreThoseOfTraceAndLog) {
  constexpr double kRow = 0.005;  // rows of the log are rows of the trace, so that nothing is interpolated
  const Scenario s = scenario(rod() + kBench + kLoop + measured(log_text(kRow, 12.25)));
  const Recording r = run(s);
  const Table row(r.trace);
  double sum = 0;
  double square = 0;
  double most = 0;
  double duty = 0;
  std::size_t at_limit = 0;
  constexpr std::size_t kRows = 401;  // from 0 to 2 s; the log goes on to 2.5 s
  ASSERT_EQ(r.trace.rows(), kRows);
  for (std::size_t k = 0; k < kRows; ++k) {
    const double off = row.at(k, "joint.0.angle") - 0.5 * std::sin(3 * kRow * static_cast<double>(k));
    sum += std::abs(off);
    square += off * off;
    most = std::max(most, std::abs(off));
    const double command = std::clamp(row.at(k, "joint.0.voltage_command") / 6, -1.0, 1.0);
    duty += std::abs(command - (k > 100 && k < 150 ? 1 : 100.0 / 885));
    if (std::abs(command) >= 0.999) ++at_limit;
  }
  const std::optional<LogErrors> errors = log_errors(s, r);
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->rows, kRows);
  const LogError& angle = *errors->joints[0].of(Logged::angle);
  constexpr double kRounding = 1e-12;  // of times from the log's own start, times a speed of some rad/s
  EXPECT_NEAR(angle.mae, sum / kRows, kRounding);
  EXPECT_NEAR(angle.rms, std::sqrt(square / kRows), kRounding);
  EXPECT_NEAR(angle.peak, most, kRounding);
  EXPECT_NEAR(errors->joints[0].of(Logged::duty)->mae, duty / kRows, kRounding);
  EXPECT_NEAR(*errors->joints[0].at_limit, static_cast<double>(at_limit) / kRows, 1e-12);
  EXPECT_NEAR(*errors->joints[0].measured_at_limit, 49.0 / kRows, 1e-12);  // rows 101 to 149
}

TEST(Measured, ADutyIsAShareOfTheBusWhateverTheTraceKeeps) {
  const auto duty = [](const std::string& columns) {
    const Scenario s = scenario(rod() + kBench + kLoop + measured(log_text(0.005)) +
                                "supply: {voltage: 3}\ntrace: {columns: " + columns + "}\n");
    return log_errors(s, run(s))->joints[0].of(Logged::duty)->mae;
  };
  const double all = duty("[joint.*, supply.*]");
  EXPECT_EQ(duty("[joint.*]"), all);
  EXPECT_EQ(duty("[t]"), all);
}

TEST(Measured, InterpolatesTheAngleByTheCubicOfAnglesAndSpeeds) {
  Scenario s = scenario(rod() + kBench + kLoop + measured(log_text(0.0013)));
  Recording r;
  for (const char* name : {"t", "joint.0.angle", "joint.0.speed", "joint.0.voltage_command"})
    r.trace.columns.push_back({name, "", ""});
  constexpr double kRow = 0.02;
  constexpr double kRate = 7;
  for (int k = 0; k <= 100; ++k) {
    const double t = kRow * k;
    for (const double value : {t, std::sin(kRate * t), kRate * std::cos(kRate * t), 0.0}) r.trace.values.push_back(value);
  }
  const std::vector<double> angles = at_log(s, r, 0, Logged::angle);
  const MeasuredLog& log = *s.measured.log;
  ASSERT_EQ(angles.size(), 1539U);                       // 2 s / 1.3 ms
  const double bound = std::pow(kRate * kRow, 4) / 384;  // of a cubic through values and slopes: h^4 max|x''''| / 384
  double most = 0;
  for (std::size_t k = 0; k < angles.size(); ++k) most = std::max(most, std::abs(angles[k] - std::sin(kRate * log.t[k])));
  EXPECT_LE(most, bound * 1.001);
  EXPECT_GE(most, bound * 0.9);  // the bound is reached in the middle of an interval
}

TEST(Measured, TorqueThatIsOffIsAFaultOfTheJoint) {
  const std::string text = rod() + kBench + kLoop + measured(log_text(0.01, 3, 1.2), "  on: on\n");
  const Scenario s = scenario(text);
  ASSERT_EQ(s.changes.size(), 1U);
  EXPECT_NEAR(s.changes[0].t, 1.195, 1e-9);  // between the rows at 1.19 and 1.2 s
  EXPECT_EQ(s.changes[0].faults[0].kind, FaultKind::open);
  const Recording r = run(s);
  EXPECT_EQ(Table(r.trace)(1.5, "joint.0.current"), 0);
  EXPECT_NE(Table(r.trace)(1.1, "joint.0.current"), 0);
  const std::string once = resolved(s);
  EXPECT_EQ(resolved(scenario(once)), once);
  // Other changes keep their places in time.
  const Scenario both = scenario(text + "at: [{t: 0.5, set: {cpg.frequency: 1}}, {t: 1.5, set: {cpg.frequency: 0.5}}]\n");
  ASSERT_EQ(both.changes.size(), 3U);
  EXPECT_EQ(both.changes[1].faults.size(), 1U);
}

TEST(Measured, IsAQuantityOfStudies) {
  const Scenario s = scenario(rod() + kBench + kLoop + measured(log_text(0.007)) + "trace: {columns: [t]}\n");
  const RunMeasure measure =
      run_measure({"measured.angle.mae", "measured.angle.rms[m0/swing]", "measured.limit.logged"}, *s.robot);
  Simulation rollout({&s, 1}, measure.reads);
  rollout.run();
  const std::vector<double> values = measure.measured(s, rollout.take_recording(0)).quantities;
  const std::optional<LogErrors> errors = log_errors(s, run(s));
  EXPECT_EQ(values[0], errors->joints[0].of(Logged::angle)->mae);
  EXPECT_EQ(values[1], errors->joints[0].of(Logged::angle)->rms);
  EXPECT_EQ(values[2], *errors->joints[0].measured_at_limit);
}

TEST(Measured, TheCheckWarnsOfAnotherMotion) {
  const auto check = [](const std::string& log, const std::string& keys = {}) {
    const Scenario s = scenario(rod() + kBench + kLoop + measured(log, keys));
    const Recording r = run(s);
    const Verdict v = verdict(s, r, summarise(s, r, 0), overlaps(s, r));
    return *std::ranges::find(v.checks, "measured", &Check::id);
  };
  const Check other = check(log_text(0.01), "  source: \"bench of 3 May, CC BY 4.0\"\n");
  EXPECT_EQ(other.status, CheckStatus::warn);  // another frequency
  EXPECT_TRUE(other.text.ends_with("of a log of 2.5 s (bench of 3 May, CC BY 4.0)")) << other.text;
  const Scenario s = scenario(rod() + kBench + kLoop);
  const Recording r = run(s);
  std::string own = "    clock,angle,pwm\n";
  for (std::size_t k = 0; k < r.trace.rows(); ++k)
    own += fmt::format("    {},{},0\n", r.trace.at(k, 0), Table(r.trace).at(k, "joint.0.angle"));
  EXPECT_EQ(check(own).status, CheckStatus::pass);
}

TEST(Measured, ReplayGivesTheCommandsOfTheLog) {
  const std::string controller =
      "controller:\n  type: replay\n  period: 0.01\n  unit: duty\n  time: clock\n"
      "  columns: {0: {column: pwm, scale: 885}}\n  file: |\n" +
      log_text(0.004, 7);
  const Recording r = run(scenario(rod() + kBench + controller));
  const Table row(r.trace);
  // The command of the tick at t is that of the last row of the log before it; a row of the trace has the command before it.
  EXPECT_NEAR(row(0.505, "joint.0.voltage_command"), 6 * 100.0 / 885, 1e-12);  // tick at 0.5 s, row at 0.5 s
  EXPECT_NEAR(row(0.515, "joint.0.voltage_command"), 6, 1e-12);                // tick at 0.51 s, row at 0.508 s
  EXPECT_NEAR(row(0.765, "joint.0.voltage_command"), 6 * 100.0 / 885, 1e-12);
}

TEST(Measured, AJsonOfARecorderIsTheSameLog) {
  const std::string keys = "measured: {time: timestamp, 'on': torque_enable, columns: {m0/swing: {angle: position}}, file: ";
  std::string json = "{\"mass\": 1, \"entries\": [";
  std::string csv = "timestamp,position,torque_enable\n";
  for (int k = 0; k < 5; ++k) {
    json += fmt::format("{}{{\"timestamp\": {:.17g}, \"position\": {:.17g}, \"torque_enable\": {}}}", k == 0 ? "" : ", ",
                        0.1 * k, std::sin(k), k < 3);
    csv += fmt::format("{:.17g},{:.17g},{}\n", 0.1 * k, std::sin(k), k < 3 ? 1 : 0);
  }
  const Folder folder;
  folder.write("log.json", json + "]}");
  folder.write("log.csv", csv);
  const auto read = [&](const std::string& name) {
    return read_scenario(folder.write("s.yaml", rod() + kBench + kLoop + keys + name + "}\n"), {}, catalog());
  };
  const Scenario a = read("log.json");
  const Scenario b = read("log.csv");
  EXPECT_EQ(a.measured.log->t, b.measured.log->t);
  EXPECT_EQ(a.measured.log->joints[0].values, b.measured.log->joints[0].values);
  EXPECT_EQ(a.changes.size(), 1U);
  EXPECT_EQ(resolved(scenario(resolved(a))), resolved(a));
  folder.write("log.json",
               "{\"entries\": [{\"timestamp\": 0, \"torque_enable\": 1, \"position\": 0}, {\"timestamp\": 0, "
               "\"torque_enable\": 1, \"position\": 0}]}");
  const std::string found = message_of([&] { read("log.json"); });
  EXPECT_TRUE(contains(found, "log 'log.json', entry 2, key 'timestamp': times must rise")) << found;
}

TEST(Measured, ALogHasUpTo4Megabytes) {
  std::string log = "clock,angle,note\n";
  for (int k = 0; log.size() < 3'000'000; ++k)
    log += fmt::format("{},{},{}\n", 1e-3 * k, std::sin(1e-3 * k), std::string(200, 'n'));
  const Folder folder;
  folder.write("log.csv", log);
  const std::string file = folder.write(
      "s.yaml", rod() + kBench + kLoop + "measured: {file: log.csv, time: clock, columns: {m0/swing: {angle: angle}}}\n");
  const Scenario s = read_scenario(file, {}, catalog());
  EXPECT_EQ(read_record(resolved(s), file, {}, catalog()).measured.log->t, s.measured.log->t);
  folder.write("log.csv", log + log);
  EXPECT_TRUE(contains(message_of([&] { read_scenario(file, {}, catalog()); }), "log.csv' is larger than 4 MB"));
}

TEST(Measured, RefusesALogWithItsPlace) {
  const auto error = [](const std::string& section) { return message_of([&] { scenario(rod() + kBench + kLoop + section); }); };
  const std::string columns = "  columns: {m0/swing: {angle: a}}\n";
  const std::string log = "  file: |\n    t,a\n    0,0\n    0.1,1\n";
  const auto refused = [&](const std::string& section, const std::string& text) {
    const std::string found = error("measured:\n" + section);
    EXPECT_TRUE(contains(found, text)) << found;
  };
  refused(columns, "measured has no file; expected the CSV or JSON of the log");
  refused(log, "measured has no columns; expected {JOINT: {angle: COLUMN}}");
  refused(columns + "  file: none.csv\n", "none.csv");
  refused(columns + "  file: |\n    t,a\n    0,0\n    0,1\n", "the log's line 3, column 1: times must rise");
  refused(columns + "  file: |\n    t,a\n    0,0\n    1,x\n", "the log's line 3, column 3: 'x' is not a finite number");
  refused(columns + "  file: |\n    t,a\n    0,0\n", "the log has 1 row; expected at least 2");
  refused("  columns: {m0/swing: {angle: b}}\n" + log, "the log has no column 'b'");
  refused("  columns: {m0/swing: {}}\n" + log, "no column of joint m0/swing is stated");
  refused("  columns: {m0/swim: {angle: a}}\n" + log, "no joint 'm0/swim'; did you mean 'm0/swing'?");
  refused("  columns: {m0/swing: {angle: {column: a, scale: 0}}}\n" + log, "scale is 0; expected the number in the column");
  refused("  columns: {m0/swing: {angle: {scale: 2}}}\n" + log, "missing key 'column'");
  refused("  columns: {m0/swing: {angle: [a]}}\n" + log,
          "angle is a list; expected the name of a column, or {column: NAME, scale: NUMBER}");
  refused("  columns: {m0/swing: {angle: a, angel: b}}\n" + log, "unknown key 'angel'");
  refused("  bound: {angle.mea: 1}\n" + columns + log, "unknown key 'angle.mea'; did you mean 'angle.mae'?");
  refused("  bound: {angle.mae: -1}\n" + columns + log, "angle.mae is -1 rad; expected 0 to 1000000000 rad");
  refused("  bound: {torque.rms: 1}\n" + columns + log, "bound has torque.rms, but no joint has a column for torque");
  refused("  time: time\n" + columns + log, "the log has no column 'time'; known columns: t, a");
}

}  // namespace
}  // namespace gaitlab::test
