// Verdicts from trace rows alone agree with verdicts of the same runs from all steps.
#include "report/analysis/row_statistics.h"

#include <nlohmann/json.hpp>

#include "report/verdict/verdict.h"
#include "tests/labels.h"
#include "tests/program/cart.h"

namespace gaitlab::test {
namespace {

// A whole walk of bullet.
const Label kAllSteps("RowStatistics.OfEveryStep*", "long;unsanitized");

using namespace report;

/// Recording that contains only the trace rows of a run, without statistics and without the column `left_out`.
Recording rows_only(const Scenario& scenario, const Recording& whole, const std::string& left_out = "") {
  Recording bare;
  bare.simulated = whole.simulated;
  for (auto [from, to] : {std::pair{&whole.trace, &bare.trace}, {&whole.rest, &bare.rest}}) {
    std::vector<std::size_t> kept;
    for (std::size_t c = 0; c < from->columns.size(); ++c) {
      if (from->columns[c].name != left_out) kept.push_back(c);
    }
    for (const std::size_t c : kept) to->columns.push_back(from->columns[c]);
    for (std::size_t row = 0; row < from->rows(); ++row) {
      for (const std::size_t c : kept) to->values.push_back(from->at(row, c));
    }
  }
  fill_ticks_from_rows(scenario, bare);
  return bare;
}

Verdict verdict_of(const Scenario& scenario, const Recording& record) {
  return verdict(scenario, record, summarise(scenario, record, 0), overlaps(scenario, record));
}

const Check& check_of(const Verdict& verdict, const char* id) { return *std::ranges::find(verdict.checks, id, &Check::id); }

/// With a row per step, the verdict from rows equals that from all steps, with values within 1 %. A row before a new command
/// contains a torque that no step uses; it differs by less than 1 % of the peak. Integrals over rows use trapezoids, those over
/// steps rectangles, which differ by half a step at the ends of the window (5e-4 s of 3 s or more).
TEST(RowStatistics, OfEveryStepAreThoseOfAllSteps) {
  const std::vector<std::pair<const char*, std::vector<std::string>>> runs{
      {"caterpillar.yaml", {}},
      {"caterpillar.yaml", {"actuator.i_max=0.35"}},
      {"hexapod.yaml", {"actuator.u_max=3", "actuator.i_max=0.45"}}};
  for (const auto& [name, sets] : runs) {
    std::vector<std::string> all{"duration=4", "physics.engine=articulated", "physics.step=5e-4", "trace.period=5e-4"};
    all.insert(all.end(), sets.begin(), sets.end());
    const Scenario s = shipped(name, all);
    const Recording whole = run(s);
    const Verdict steps = verdict_of(s, whole);
    const Verdict rows = verdict_of(s, rows_only(s, whole));
    EXPECT_EQ(rows.word, steps.word) << name;
    EXPECT_EQ(steps.of_rows, "");
    EXPECT_EQ(rows.of_rows, "judged from the trace's rows, one per 0.5 ms: a peak between two rows is not seen");
    for (const char* const id : {"voltage", "current", "envelope", "speed", "heat", "tracking", "stops"}) {
      const Check& of = check_of(steps, id);
      const Check& from = check_of(rows, id);
      EXPECT_EQ(from.status, of.status) << name << ' ' << id;
      EXPECT_EQ(from.worst, of.worst) << name << ' ' << id;
      EXPECT_NEAR(from.value, of.value, 1e-2 * std::abs(of.value)) << name << ' ' << id;
    }
  }
}

/// The peak at the start of a command is known from rows at control ticks. Such a row contains the previous command, but the
/// torque is largest under the new command, so that the program evaluates the actuator with the new command. Without this, rows
/// 15 ms apart show less than half of some peaks. Peaks between ticks are missed by less than a tenth. The law at the end of a
/// step is smaller by up to h times the rate of the motor (18/s * 5e-4 s).
TEST(RowStatistics, SeeThePeakWhereACommandBegins) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=4", "physics.engine=articulated", "trace.period=0.015"});
  const Recording whole = run(s);
  const Recording bare = rows_only(s, whole);
  const Judged steps = judge(whole, {}, 1000);
  const Judged rows = judge(bare, {}, 1000);
  double least = 1;
  for (std::size_t j = 0; j < steps.whole.size(); ++j) {
    const double peak = steps.whole[j].torque_peak;
    const Series torque = whole.joint(j, "torque");
    double seen = 0;
    for (std::size_t k = 0; k < torque.size(); ++k) seen = std::max(seen, std::abs(torque[k]));
    least = std::min(least, seen / peak);
    EXPECT_LE(rows.whole[j].torque_peak, 1.01 * peak) << j;
    EXPECT_GT(rows.whole[j].torque_peak, 0.9 * peak) << j;
  }
  EXPECT_LT(least, 0.5) << "of the rows alone";
  EXPECT_EQ(verdict_of(s, bare).word, verdict_of(s, whole).word);
}

/// A check without its column is not judged, and its text names the column. All other checks are judged.
TEST(RowStatistics, NameTheColumnThatIsNotThere) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=1", "physics.engine=articulated"});
  const Recording whole = run(s);
  const auto without = [&](const char* column) { return verdict_of(s, rows_only(s, whole, column)); };
  const auto lacks = [](const Verdict& verdict, const char* id, const std::string& column) {
    const Check& of = check_of(verdict, id);
    return of.status == CheckStatus::not_judged && of.text == "the trace has no column " + column && std::isnan(of.value);
  };
  const Verdict no_speed = without("joint.3.speed");
  for (const char* const id : {"speed", "envelope"}) EXPECT_TRUE(lacks(no_speed, id, "joint.3.speed")) << id;
  for (const char* const id : {"voltage", "current", "heat", "tracking", "stops"})
    EXPECT_NE(check_of(no_speed, id).status, CheckStatus::not_judged) << id;
  const Verdict no_torque = without("joint.0.torque");
  EXPECT_TRUE(lacks(no_torque, "envelope", "joint.0.torque"));
  const Verdict no_state = without("joint.15.saturation");
  for (const char* const id : {"voltage", "current"}) EXPECT_TRUE(lacks(no_state, id, "joint.15.saturation")) << id;
  EXPECT_TRUE(lacks(without("joint.0.current"), "heat", "joint.0.current"));
  EXPECT_TRUE(lacks(without("joint.1.setpoint"), "tracking", "joint.1.setpoint"));
  const Verdict no_angle = without("joint.2.angle");
  EXPECT_TRUE(lacks(no_angle, "tracking", "joint.2.angle"));
  EXPECT_EQ(check_of(no_angle, "stops").status, CheckStatus::not_judged);
  for (const char* const id : {"ledger", "created", "torque_error"})
    EXPECT_EQ(check_of(no_speed, id).status, CheckStatus::not_judged) << id << ": rows hold no energies";
  EXPECT_EQ(check_of(no_torque, "voltage").definition,
            "share of the window at the limit of the voltage, over the rows of the trace");
}

/// A hinge without a motor has no columns of a motor. This does not affect the results of joints with motors.
TEST(RowStatistics, LeaveOutHingesWithoutAMotor) {
  const Scenario s = scenario(kCastorFirst, {"duration=4", "physics.step=5e-4", "trace.period=5e-4"});
  const Recording whole = run(s);
  const Recording bare = rows_only(s, whole);
  ASSERT_TRUE(bare.ticks_of_rows);
  for (std::size_t c = 0; c < kTickColumns; ++c)
    EXPECT_EQ(bare.tick(0, static_cast<TickColumn>(c)).back(), 0) << "of the castor";
  const Verdict steps = verdict_of(s, whole);
  const Verdict rows = verdict_of(s, bare);
  for (const char* const id : {"voltage", "current", "envelope", "speed", "tracking"}) {
    EXPECT_NE(check_of(rows, id).status, CheckStatus::not_judged) << id << ": " << check_of(rows, id).text;
    EXPECT_EQ(check_of(rows, id).status, check_of(steps, id).status) << id;
    EXPECT_EQ(check_of(rows, id).worst, check_of(steps, id).worst) << id;
    EXPECT_NEAR(check_of(rows, id).value, check_of(steps, id).value, 1e-2 * std::abs(check_of(steps, id).value)) << id;
  }
  EXPECT_EQ(check_of(verdict_of(s, rows_only(s, whole, "joint.1.torque")), "envelope").text,
            "the trace has no column joint.1.torque");
}

TEST(RowStatistics, OfNothingAreNothing) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=0.1", "physics.engine=articulated"});
  Recording none;
  fill_ticks_from_rows(s, none);
  EXPECT_FALSE(none.ticks_of_rows);
  EXPECT_EQ(verdict_of(s, none).word, report::Word::not_judged);
  Recording whole = run(s);
  fill_ticks_from_rows(s, whole);
  EXPECT_FALSE(whole.ticks_of_rows) << "all steps are known";
}

/// A run folder with only a CSV file is judged from its rows.
TEST(RowStatistics, JudgeFoldersOfCsv) {
  const Folder folder;
  const std::string run =
      "run " + kScenarios + "caterpillar.yaml --set physics.engine=articulated --set duration=12 --set actuator.i_max=0.35 ";
  ASSERT_EQ(gaitlab(run + "--format csv --no-report --out csv", folder.path()).code, 0);
  const auto before = nlohmann::json::parse(read(folder / "csv/verdict.json"));
  EXPECT_EQ(before.at("statistics"), "all steps");
  std::filesystem::remove(folder / "csv/recording.h5");
  const Result result = gaitlab("report csv --fail-infeasible --page page.html", folder.path());
  EXPECT_EQ(result.code, 3) << result.err;
  EXPECT_TRUE(contains(result.out, "judged from the trace's rows, one per 5 ms: a peak between two rows is not seen\n"))
      << result.out;
  EXPECT_TRUE(contains(result.out, "infeasible: ")) << result.out;
  EXPECT_TRUE(contains(read(folder / "page.html"), R"("statistics":"rows")"));
}

}  // namespace
}  // namespace gaitlab::test
