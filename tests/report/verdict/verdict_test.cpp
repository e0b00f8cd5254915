// Tests of the verdict on recordings that are changed to pass, warn, fail or not be judged.
#include "report/verdict/verdict.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "core/scenario/resolved.h"
#include "report/verdict/numbers/summary_text.h"
#include "tests/labels.h"
#include "tests/program/cart.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {
namespace {

// Whole walks.
const Label kAnyPeriod("Verdict.IsTheSameForAnyTracePeriod", "long;unsanitized");

const Label kLongVerdict("Verdict.IsAFileALineAndAnExitCode", "long");

TEST(Verdict, OfAGaitThatTheMotorsCanDo) {
  const Verdict made = gait().judged();
  EXPECT_EQ(made.word, Word::feasible) << made.why();
  EXPECT_EQ(made.why(), "");
  EXPECT_EQ(made.count(CheckStatus::fail), 0U);
  for (const char* const id :
       {"outcome",  "fall",     "upright",      "progress",  "voltage", "current",   "envelope",  "speed",
        "heat",     "tracking", "stops",        "setpoints", "start",   "collision", "in_ground", "airborne",
        "periodic", "evidence", "torque_error", "ledger",    "supply",  "step",      "coarse",    "law"})
    EXPECT_EQ(gait().status(id), CheckStatus::pass) << id << ": " << gait().check(id).text;
  for (const char* const id : {"gear_peak", "gear_continuous", "dock_tension", "field"})
    EXPECT_EQ(gait().status(id), CheckStatus::not_judged) << id;
}

/// A short time at a limit gives a warning, a long time a failure. The window has 213 control ticks of 15 ms, so that one tick
/// is less than 1 % of it and less than three control periods.
TEST(Verdict, WarnsOfShortLimitsAndFailsByLongOnes) {
  for (const auto& [column, id, name] :
       {std::tuple{kVoltageLimited, "voltage", "voltage"}, {kCurrentLimited, "current", "current"}}) {
    EXPECT_EQ(at_limit(column, 1).status(id), CheckStatus::warn);
    EXPECT_EQ(at_limit(column, 4).status(id), CheckStatus::fail) << "four ticks on end";
    EXPECT_EQ(at_limit(column, 20, 2).status(id), CheckStatus::fail) << "ten single ticks are more than 1 %";
    const Check check = at_limit(column, 100).check(id);
    EXPECT_EQ(check.worst, "m1/passive");
    EXPECT_EQ(check.parts, 1U);
    EXPECT_NEAR(check.to, 4, 1e-9);
    EXPECT_NEAR(check.from, walk().record.ticks.values[(walk().last_tick() - 100) * walk().record.ticks.columns.size()], 1e-9);
    EXPECT_TRUE(contains(check.text, std::string("1 of 16 joints reaches the limit of its ") + name)) << check.text;
    EXPECT_EQ(at_limit(column, 100).judged().word, Word::not_judged) << "one period is no evidence";
    EXPECT_TRUE(contains(at_limit(column, 100).judged().why(), "; so far: 1 of 16 joints reaches"))
        << at_limit(column, 100).judged().why();
  }
}

/// Only joints with a motor are counted.
TEST(Verdict, CountsJointsWithAMotor) {
  const Scenario s = scenario(kCastorFirst, {"actuator.u_max=0.05"});
  const Recording record = run(s);
  const Summary summary = summarise(s, record, 0);
  const Verdict made = verdict(s, record, summary, overlaps(s, record));
  const Check& voltage = *std::ranges::find(made.checks, std::string("voltage"), &Check::id);
  EXPECT_TRUE(contains(voltage.text, "1 of 1 joint reaches the limit of its voltage: first m0/arm, at ")) << voltage.text;
  const std::string text = to_text(summary, s, record);
  EXPECT_TRUE(contains(text, "1 of 1 joint reaches a limit, m0/arm longest:")) << text;
}

/// The text begins with the number that decided. Four consecutive ticks, the last one cut off by the end of the run, are 55 ms
/// or 1.7 % of the window.
TEST(Verdict, TellsTheNumberThatDecided) {
  Case made = at_limit(kCurrentLimited, 4);
  EXPECT_TRUE(contains(made.check("current").text, "; 1.72 % of the judged time, up to 0.055 s on end"))
      << made.check("current").text;
  made.scenario.limits.saturated_share = 0.05;
  EXPECT_EQ(made.status("current"), CheckStatus::fail);
  EXPECT_TRUE(contains(made.check("current").text,
                       ": first m1/passive, at 3.95 s; 0.055 s on end from 3.95 s, more than 3 control periods (0.045 s), in "
                       "all 1.72 % of the judged time"))
      << made.check("current").text;
}

TEST(Verdict, NamesNoFolder) {
  Case made = walk();
  made.scenario.plugins = {{"/home/somebody/build/wave.so", "hash"}};
  made.record.outcome = {Ended::plugin, "stopped at step 3: cpg 'wave' (/home/somebody/build/wave.so): no luck"};
  EXPECT_EQ(made.check("outcome").text, "stopped at step 3: cpg 'wave' (wave.so): no luck");
  EXPECT_FALSE(contains(to_json(made.judged()), "/home"));
}

TEST(Verdict, MeasuresTrackingInTheWindow) {
  const auto with = [&](double error) {
    Case made = walk();
    made.tick(made.last_tick(), 5, kErrorPeak) = error;
    return made.check("tracking");
  };
  EXPECT_EQ(with(0.09).status, CheckStatus::pass);
  EXPECT_EQ(with(0.15).status, CheckStatus::warn);
  EXPECT_EQ(with(0.21).status, CheckStatus::fail);
  EXPECT_EQ(with(0.21).worst, "m2/passive");
  Case start = walk();
  start.tick(1, 5, kErrorPeak) = 3;
  EXPECT_EQ(start.status("tracking"), CheckStatus::pass) << "before the window";
}

TEST(Verdict, JudgesStopsFallsAndTheEnd) {
  const auto stops = [&](double worst, double share) {
    Case made = walk();
    made.record.joints[4].range_worst = worst;
    made.record.joints[4].range_share = share;
    return made.status("stops");
  };
  EXPECT_EQ(stops(0.005, 0.005), CheckStatus::warn);
  EXPECT_EQ(stops(0.02, 0.005), CheckStatus::fail);
  EXPECT_EQ(stops(0.005, 0.02), CheckStatus::fail);
  Case both = walk();  // one joint is far beyond its range, another joint is beyond it for a long time
  both.record.joints[4].range_worst = 0.009;
  both.record.joints[6].range_worst = 0.002;
  both.record.joints[6].range_share = 0.02;
  EXPECT_EQ(both.check("stops").worst, both.scenario.robot->joints[6].name) << "its time decides";
  EXPECT_TRUE(contains(both.check("stops").text, ": for 2 % of the run (at most 1 %), by up to 0.002 rad"))
      << both.check("stops").text;
  both.record.joints[4].range_worst = 0.02;
  EXPECT_EQ(both.check("stops").worst, both.scenario.robot->joints[4].name) << "its angle decides";
  EXPECT_TRUE(contains(both.check("stops").text, ": by 0.02 rad")) << both.check("stops").text;
  Case fallen = walk();
  Trace& poses = fallen.record.poses;
  poses.values[(poses.rows() - 1) * poses.columns.size() + poses.find("base.z")] -= 0.9 * fallen.record.series("com.z").back();
  EXPECT_EQ(fallen.status("fall"), CheckStatus::fail);
  EXPECT_TRUE(contains(fallen.check("fall").text, "comes down to ")) << fallen.check("fall").text;
  Case tilted = walk();
  tilted.scenario.limits.tilt = 0.01;
  EXPECT_EQ(tilted.status("upright"), CheckStatus::warn);
  Case early = walk();
  early.record.outcome = {Ended::diverged, "diverged at step 3"};
  EXPECT_EQ(early.judged().word, Word::failed);
}

/// An interval of two whole ticks and three quarters of the ticks before and after them counts as more than three ticks.
TEST(Verdict, CountsTheEndsOfAStretch) {
  Case made = walk();
  const auto t = [&](std::size_t row) { return made.record.ticks.values[row * made.record.ticks.columns.size()]; };
  const std::size_t end = made.last_tick() - 1;  // the tick before the last, which the end of the run cuts off
  double total = 0;
  for (const auto& [row, part] : {std::pair{end - 3, 0.75}, {end - 2, 1.0}, {end - 1, 1.0}, {end, 0.75}, {end + 1, 0.0}}) {
    total += part * (t(row) - t(row - 1));
    made.tick(row, 3, kCurrentLimited) = total;
  }
  EXPECT_NEAR(total, 3.5 * made.scenario.control_period, 1e-9);
  EXPECT_EQ(made.status("current"), CheckStatus::fail);
  EXPECT_NEAR(made.check("current").to - made.check("current").from, total, 1e-9);
}

/// Forty ticks at the limit, from the 102nd to the 142nd, count as more than 39 periods, also if a row contains four ticks. The
/// whole rows among them contain only 36 ticks.
TEST(Verdict, OfHalvedTicks) {
  Case made = walk();
  made.scenario.limits.saturated_share = 1;
  made.scenario.limits.saturated_periods = 39;
  const auto t = [&](std::size_t row) { return made.record.ticks.values[row * made.record.ticks.columns.size()]; };
  for (std::size_t k = 103; k <= made.last_tick(); ++k)
    made.tick(k, 3, kCurrentLimited) = t(std::min<std::size_t>(k, 142)) - t(102);
  EXPECT_EQ(made.status("current"), CheckStatus::fail);
  halve_ticks(made.record.ticks);
  halve_ticks(made.record.ticks);
  EXPECT_EQ(made.status("current"), CheckStatus::fail);
  made.scenario.limits.saturated_periods = 41;
  EXPECT_EQ(made.status("current"), CheckStatus::warn);
}

/// Energy that gears create in the paper's model does not change the verdict. With an unexplained loss of energy, the run is
/// not sufficient evidence.
TEST(Verdict, IsOfRunsThatCanBeTrusted) {
  Case made = gait();
  for (JointStatistics& joint : made.record.joints) joint.created = made.record.ledger.electrical;
  EXPECT_EQ(made.status("created"), CheckStatus::warn);
  EXPECT_EQ(made.judged().word, Word::feasible);
  made.record.ledger.copper += made.record.ledger.electrical;  // increases the residual
  EXPECT_EQ(made.status("ledger"), CheckStatus::warn);
  EXPECT_EQ(made.judged().word, Word::not_judged);
  made.record.ledger.copper = made.record.joints[0].created = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(made.status("ledger"), CheckStatus::warn) << "not a number is not a pass";
  EXPECT_EQ(made.status("created"), CheckStatus::warn) << "not a number is not a pass";
  EXPECT_EQ(made.judged().word, Word::not_judged);
  EXPECT_FALSE(contains(gait().check("torque_error").text, "nan"));
}

TEST(Verdict, OfBodiesAndTheGround) {
  Case made = walk();
  made.scenario.contact.law = ContactLaw::solver;
  EXPECT_EQ(made.status("collision"), CheckStatus::not_judged);
  const char* const coil =
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0]], position: [0, 0, 1]}\n"
      "initial: {angles: 1.2}\nduration: 0.02\nphysics: {engine: articulated}\nactuator: {type: none}\nground: {type: none}\n";
  const Scenario s = scenario(coil);
  const Recording r = run(s);
  const Verdict v = verdict(s, r, summarise(s, r, 0), overlaps(s, r));
  EXPECT_EQ(std::ranges::find(v.checks, "collision", &Check::id)->status, CheckStatus::fail);
  EXPECT_EQ(std::ranges::find(v.checks, "in_ground", &Check::id)->status, CheckStatus::not_judged);
  EXPECT_EQ(std::ranges::find(v.checks, "voltage", &Check::id)->text, "nothing drives the joints");
}

TEST(Verdict, DoesNotAssumeWhatItDoesNotKnow) {
  Case old = walk();
  old.record.ticks = {};
  const Verdict made = old.judged();
  EXPECT_EQ(made.word, Word::not_judged) << "nothing is known of the motors";
  EXPECT_EQ(old.check("voltage").text, "the run ended at once");
  Case bare = walk();  // only trace rows, as in a CSV file
  bare.record.poses = {};
  const Verdict of_rows = bare.judged();
  EXPECT_EQ(of_rows.word, Word::not_judged);
  EXPECT_TRUE(of_rows.reason.text.starts_with("only the rows of the trace are left")) << of_rows.reason.text;
  const auto shown = std::ranges::count_if(of_rows.checks, &Check::concerns);
  EXPECT_EQ(of_rows.count(CheckStatus::not_judged), static_cast<std::size_t>(shown));
}

TEST(Verdict, LimitsAreSettings) {
  Case made = at_limit(kCurrentLimited, 100);
  made.scenario.limits.saturated_share = 1;
  made.scenario.limits.saturated_periods = 1e6;
  EXPECT_EQ(made.status("current"), CheckStatus::warn);
  const Scenario read = shipped("caterpillar.yaml", {"limits.tracking_error=0.01"});
  EXPECT_EQ(read.limits.tracking_error, 0.01);
  EXPECT_TRUE(contains(resolved(read), "\nlimits:\n"));
  EXPECT_FALSE(contains(resolved(walk().scenario), "limits:"));
}

TEST(Verdict, IsTheSameForAnyTracePeriod) {
  std::string first;
  for (const char* period : {"5e-4", "0.005", "0.015"}) {
    Scenario s = shipped("caterpillar.yaml", {"duration=12", "physics.engine=articulated", "actuator.i_max=0.35",
                                              std::string("trace.period=") + period});
    s.limits.touch = s.limits.sink = 0;  // makes the texts state the depths of bodies
    const Recording r = run(s);
    const Verdict made = verdict(s, r, summarise(s, r, 1), overlaps(s, r));
    std::string text = name_of(made.word);
    for (const Check& c : made.checks) {
      text += fmt::format("\n{} {} {} {} {} {} {}", c.id, c.value, c.worst, c.parts, c.from, c.to, c.text);
    }
    if (first.empty()) first = text;
    EXPECT_EQ(text, first) << period;
    EXPECT_EQ(made.word, Word::infeasible);
  }
}

TEST(Verdict, IsAFileALineAndAnExitCode) {
  Folder folder;
  const std::string file = kScenarios + "caterpillar.yaml --set physics.engine=articulated --set duration=12 ";
  const Result bad = gaitlab("run " + file + "--set actuator.i_max=0.35 --out bad --fail-infeasible", folder.path());
  EXPECT_EQ(bad.code, 3);
  EXPECT_TRUE(contains(bad.out, "\n  verdict   infeasible: ")) << bad.out;
  const auto json = nlohmann::json::parse(read(folder.path() / "bad/verdict.json"));
  EXPECT_EQ(json.at("verdict"), "infeasible");
  const auto of_a_part = [](const CheckKind& kind) { return kind.concerns != nullptr; };
  constexpr std::size_t kOfAbsentParts = 4;  // two of a supply, one of a log, one of identified motors
  EXPECT_EQ(json.at("checks").size() + kOfAbsentParts, check_kinds().size());
  EXPECT_EQ(std::ranges::count_if(check_kinds(), of_a_part), kOfAbsentParts);
  EXPECT_TRUE(json.at("first").at("time").is_number());
  EXPECT_EQ(gaitlab("run " + file + "--out good --fail-infeasible", folder.path()).code, 0);
  EXPECT_EQ(gaitlab("report bad --fail-infeasible", folder.path()).code, 3);
  EXPECT_EQ(gaitlab("report bad", folder.path()).code, 0);
  folder.write("wild.yaml", "gaitlab: 1\nrobot: {modules: " + kScenarios +
                                "modules/mtran.yaml, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.2\n"
                                "cpg: {type: equations, model: {states: {phi: exp(700)*exp(700)}, output: phi}}\n");
  EXPECT_EQ(gaitlab("run wild.yaml --out wild", folder.path()).code, 1);
  EXPECT_EQ(nlohmann::json::parse(read(folder.path() / "wild/verdict.json")).at("verdict"), "failed");
  EXPECT_EQ(gaitlab("report wild", folder.path()).code, 0);
  EXPECT_EQ(gaitlab("report wild --fail-infeasible", folder.path()).code, 1);
  EXPECT_EQ(gaitlab("report bad --out again", folder.path()).code, 0);
  EXPECT_EQ(read(folder.path() / "again/verdict.json"), read(folder.path() / "bad/verdict.json"));
}

}  // namespace
}  // namespace gaitlab::test
