// Recording of a run that is read from its folder, with its statistics and tables besides the trace rows.
#include <nlohmann/json.hpp>

#include "core/files/atomic_file.h"
#include "core/recording/h5.h"
#include "core/recording/recording_file.h"
#include "core/recording/run_files.h"
#include "core/scenario/resolved.h"
#include "core/simulation/probes.h"
#include "kit/stored_scenario.h"
#include "report/verdict/verdict.h"
#include "tests/core/recording/tables.h"
#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// A whole walk.
const Label kAllTicks("Ticks.AreOfAllSteps", "long;unsanitized");

const std::string kRemedy = "; one of the two files belongs to another run: restore the right file, or simulate again\n";

struct Kept {
  const char *name, *scenario, *arguments;
};

class ReadBack : public testing::TestWithParam<Kept> {};

TEST_P(ReadBack, GivesTheSameSummaryAndFigure) {
  const Folder folder;
  const Result ran =
      gaitlab(fmt::format("run '{}{}' --out run {}", kScenarios, GetParam().scenario, GetParam().arguments), folder.path());
  const Result again = gaitlab("report run --out again", folder.path());
  ASSERT_EQ(again.code, 0) << ran.err << again.err;
  const std::string summary = read(folder / "run/summary.json");
  ASSERT_FALSE(summary.empty()) << ran.err;
  EXPECT_EQ(read(folder / "again/summary.json"), summary);
  EXPECT_EQ(read(folder / "again/verdict.json"), read(folder / "run/verdict.json"));
  EXPECT_EQ(read(folder / "again/figure.svg"), read(folder / "run/figure.svg"));
  EXPECT_TRUE(read(folder / "again/report.html") == read(folder / "run/report.html"));
  // Output of the terminal without the lines on the command, page and files, which name paths.
  const auto text = [](const std::string& out) {
    return out.substr(0, std::min({out.find("  judge by "), out.find("  page "), out.find("  files ")}));
  };
  EXPECT_EQ(text(again.out), text(ran.out));
}

INSTANTIATE_TEST_SUITE_P(
    Runs, ReadBack,
    testing::Values(Kept{"caterpillar", "caterpillar.yaml", "--set duration=4 --set physics.engine=articulated"},
                    Kept{"hexapod", "hexapod.yaml", "--set duration=4 --set physics.engine=articulated"},
                    Kept{"rubble", "rubble.yaml", "--set duration=0.4"},
                    Kept{"no_columns", "hexapod.yaml", "--set duration=0.3 --set trace.columns=[]"},
                    Kept{"one_column", "hexapod.yaml", "--set duration=0.1 --set trace.columns=[joint.3.angle]"},
                    Kept{"supply", "hexapod.yaml",
                         "--set duration=0.3 --set physics.engine=articulated --set supply.voltage=7.4 --set "
                         "supply.resistance=0.2 --set supply.least=7.3"},
                    Kept{"csv", "caterpillar.yaml", "--set duration=0.3 --format csv"},
                    Kept{"no_motors", "pendulum.yaml", "--set duration=2"},
                    Kept{"all_columns", "hexapod.yaml", "--set duration=0.1 --set 'trace.columns=[\"*\"]' --format csv"},
                    Kept{"csv_no_motors", "pendulum.yaml", "--set duration=0.5 --format csv"},
                    Kept{"within_a_step", "hexapod.yaml", "--set duration=0.0303 --set physics.engine=articulated"}),
    [](const auto& info) { return std::string(info.param.name); });

// Settings of a run that diverges: the base leaves the permitted range of positions after 0.1 s.
constexpr const char* kDiverges =
    "--set physics.engine=articulated --set ground.type=none --set 'robot.position=[99000, 0, 1]' --set robot.on_ground=false "
    "--set 'initial.base_velocity=[9999, 0, 0]' --set duration=1";

TEST(ReadBackEarly, SaysWhyTheRunEnded) {
  const Folder folder;
  const Result ran = gaitlab(fmt::format("run '{}hexapod.yaml' --out run {}", kScenarios, kDiverges), folder.path());
  ASSERT_EQ(ran.code, 1) << ran.err;
  const StoredRecording stored = read_recording(folder / "run");
  EXPECT_EQ(stored.recording.outcome.ended, Ended::diverged);
  EXPECT_EQ(stored.recording.outcome.text(), read_summary(folder / "run")["outcome"]);
  const Result again = gaitlab("report run --out again", folder.path());
  EXPECT_EQ(again.code, 0);
  EXPECT_TRUE(again.err.starts_with("run: note: this run ended early: diverged at step ")) << again.err;
  EXPECT_EQ(read(folder / "again/summary.json"), read(folder / "run/summary.json"));
  EXPECT_EQ(read(folder / "again/figure.svg"), read(folder / "run/figure.svg"));
  EXPECT_TRUE(read(folder / "again/report.html") == read(folder / "run/report.html"));
}

/// Statistics over all steps do not depend on the rows of the trace.
TEST(Ticks, AreOfAllSteps) {
  for (const char* engine : {"bullet", "articulated"}) {
    std::string first;
    for (const char* period : {"5e-4", "0.005", "0.015"}) {
      const Recording r =
          run(shipped("hexapod.yaml", {"duration=0.9", "actuator.i_max=0.25", std::string("physics.engine=") + engine,
                                       std::string("trace.period=") + period}));
      if (first.empty()) first = hash(r.ticks);
      EXPECT_EQ(hash(r.ticks), first) << engine << ' ' << period;
      const Table table(r.ticks);
      ASSERT_EQ(r.ticks.rows(), 61U) << "every 15 ms, and both ends";
      double limited = 0;
      for (std::size_t j = 0; j < r.joints.size(); ++j) {
        const auto at = [&](std::size_t row, const char* name) { return table.at(row, fmt::format("joint.{}.{}", j, name)); };
        double peak = 0;
        double error = 0;
        for (std::size_t row = 0; row < r.ticks.rows(); ++row) {
          peak = std::max(peak, at(row, "torque_peak"));
          error = std::max(error, at(row, "error_peak"));
          // Torque of M-TRAN's motor at the current limit by eq. 2. Smaller torques are not at the current limit.
          constexpr double kLimit = 0.7 * 0.00395 * 594 * 0.25;
          const bool current = at(row, "peak_limit") == 2;
          EXPECT_EQ(current, at(row, "torque_peak") > (1 - 1e-9) * kLimit) << engine << ' ' << j << ' ' << row;
        }
        EXPECT_EQ(peak, r.joints[j].torque_peak) << engine << ' ' << j;
        EXPECT_EQ(error, r.joints[j].error_peak) << engine << ' ' << j;
        // The tolerance 1e-12 is for the rounding errors of a square, a root and a division.
        EXPECT_NEAR(std::sqrt(at(60, "torque_square") / r.simulated), r.joints[j].torque_rms, 1e-12);
        EXPECT_NEAR(at(60, "current_limited") / r.simulated, r.joints[j].saturated_current, 1e-12);
        EXPECT_NEAR(at(60, "voltage_limited") / r.simulated, r.joints[j].saturated_voltage, 1e-12);
        limited += r.joints[j].saturated_current;
      }
      EXPECT_GT(limited, 0.05) << "else the test shows nothing of limits";
    }
  }
}

/// The sums of the ticks give the RMS of any interval. The reference is the sum over rows at every step of an integrator whose
/// torque is constant during a step.
TEST(Ticks, GiveTheRmsOfAnyStretch) {
  const Recording r =
      run(shipped("caterpillar.yaml", {"duration=1.5", "physics.engine=articulated", "physics.integrator=implicit",
                                       "physics.step=5e-4", "trace.period=5e-4"}));
  const Table ticks(r.ticks);
  const Series time = r.series("t");
  const double from = r.ticks.at(40, 0);
  const double to = r.ticks.at(80, 0);
  for (std::size_t j = 0; j < r.joints.size(); ++j) {
    const Series torque = r.joint(j, "torque");
    double square = 0;
    for (std::size_t k = 0; k < time.size(); ++k) square += time[k] > from && time[k] <= to ? torque[k] * torque[k] * 5e-4 : 0;
    const std::string name = fmt::format("joint.{}.torque_square", j);
    // The tolerance 1e-9 exceeds the rounding errors of the difference of two sums of 1e3 terms.
    EXPECT_NEAR(ticks.at(80, name) - ticks.at(40, name), square, 1e-9 * square) << j;
  }
}

TEST(Ticks, AreAtLeastTwoMillisecondsApart) {
  const Recording r = run(shipped("hexapod.yaml", {"duration=0.02", "controller.period=5e-4", "physics.engine=articulated"}));
  ASSERT_EQ(r.ticks.rows(), 11U);
  EXPECT_NEAR(r.ticks.at(1, 0), 2e-3, 1e-12);
}

/// Units and definitions of columns follow from their names, because a CSV file does not contain them.
TEST(Columns, KnownByNameAreThoseOfARun) {
  for (const char* name : {"hexapod.yaml", "rubble.yaml", "pendulum.yaml"}) {
    const Scenario s = shipped(name, {"duration=0.01", "physics.engine=articulated", "trace.columns=[\"*\"]"});
    const std::vector<Column> known = Probes::known(s);
    const Recording r = run(s);
    ASSERT_EQ(known.size(), r.trace.columns.size()) << name;
    for (std::size_t c = 0; c < known.size(); ++c) {
      EXPECT_EQ(known[c].name, r.trace.columns[c].name);
      EXPECT_EQ(known[c].unit, r.trace.columns[c].unit) << known[c].name;
      EXPECT_EQ(known[c].definition, r.trace.columns[c].definition) << known[c].name;
    }
  }
}

/// A run folder that has only the rows of its trace.
class RowsAlone : public testing::Test {
 protected:
  RowsAlone() {
    const std::string settings =
        " --set duration=0.2 --set physics.engine=articulated --format csv --quiet --no-report --out old";
    EXPECT_EQ(gaitlab("run " + kScenarios + "caterpillar.yaml" + settings, folder_.path()).code, 0);
    std::filesystem::remove(folder_ / "old/recording.h5");
  }
  const Folder folder_;
};

TEST_F(RowsAlone, IsReadAsFarAsItGoes) {
  const Result result = gaitlab("report old --verbose", folder_.path());
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("caterpillar-8: 0.2 s simulated"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("distance      0.0"), std::string::npos) << result.out;
  for (const char* unknown : {"most loaded", "\n  tracking", "energy", "transport", "\n  stability"})
    EXPECT_EQ(result.out.find(unknown), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("not judged: only the rows of the trace are left, which miss the peaks between them;\n"),
            std::string::npos)
      << result.out;
  EXPECT_NE(result.err.find(
                "old: note: old/trace.csv contains only rows: peaks, shares of time, energies and the torque error are not "
                "known, because they are computed from every step\nold: note: the trace has no column load.*\n"),
            std::string::npos)
      << result.err;
  const Result refused = gaitlab("report old --out new", folder_.path());
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(
      refused.err.starts_with("old: error: summary and figure cannot be computed again: old/trace.csv contains only rows"))
      << refused.err;
  EXPECT_TRUE(refused.err.ends_with("simulate again: gaitlab rerun old\n")) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new"));
}

/// Not one check passes or fails by rows, which do not contain peaks.
TEST_F(RowsAlone, HasNoCheckThatIsJudged) {
  const kit::StoredRun run = kit::read_run(folder_ / "old", catalog());
  const Recording& record = run.stored.recording;
  const report::Verdict made =
      report::verdict(run.scenario, record, report::summarise(run.scenario, record, 0), report::overlaps(run.scenario, record));
  EXPECT_EQ(made.word, Word::not_judged);
  for (const report::Check& check : made.checks) EXPECT_EQ(check.status, report::CheckStatus::not_judged) << check.id;
  EXPECT_EQ(gaitlab("report old --fail-infeasible", folder_.path()).code, 3);
}

TEST_F(RowsAlone, HasAPageThatSaysWhatIsMissing) {
  const Result result = gaitlab("report old --page old/report.html", folder_.path());
  EXPECT_EQ(result.code, 0) << result.err;
  const std::string page = read(folder_ / "old/report.html");
  EXPECT_NE(page.find("\"missing\":[\"trace.csv contains only rows: peaks"), std::string::npos);
  EXPECT_NE(page.find("only the rows of the trace are left"), std::string::npos);
  EXPECT_NE(page.find("\"joint.0.angle\""), std::string::npos);
  EXPECT_EQ(page.find(folder_.path().string()), std::string::npos);
}

TEST_F(RowsAlone, WithoutPosesSaysNothingOfThem) {
  std::istringstream rows(read(folder_ / "old/trace.csv"));
  std::string bare;
  for (std::string row; std::getline(rows, row);) bare += row.substr(0, row.find(',')) + "\n";
  folder_.write("old/trace.csv", bare);
  const Result result = gaitlab("report old --page bare.html", folder_.path());
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out.find("distance"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("the trace has no column joint.*.setpoint, joint.*.angle, joint.*.torque, joint.*.saturation, "
                            "base.?, base.q?, com.?, load.*"),
            std::string::npos)
      << result.err;
}

TEST(Recordings, ThatDoNotFitTogetherAreRefused) {
  const Folder folder;
  const Scenario walking = shipped("hexapod.yaml", {"duration=0.05", "physics.engine=articulated"});
  write_recording(run(walking), {"", 0, "", "done"}, "h5", folder.path());
  const StoredTrace good = read_h5(folder / "trace.h5");
  EXPECT_TRUE(read_recording(folder.path()).missing.empty());
  const auto complaint = [&](const std::vector<Beside>& beside) -> std::string {
    write_h5(good.trace, good.origin, folder / "trace.h5", tables_of(beside));
    return message_of([&] { read_recording(folder.path()); });
  };
  EXPECT_EQ(complaint(good.beside), kNoError);
  const std::string file = folder / "trace.h5";
  std::vector<Beside> beside = good.beside;
  const auto table = [&](const char* name) -> Trace& { return std::ranges::find(beside, name, &Beside::name)->table; };
  beside.erase(beside.begin());
  EXPECT_EQ(complaint(beside), file + ": error: is corrupt: there is no table /recording/rest");
  beside = good.beside;
  beside[0].table.values.resize(beside[0].table.columns.size());
  EXPECT_EQ(complaint(beside), file + ": error: is corrupt: 1 rows in /recording/rest, 11 in the trace");
  beside = good.beside;
  table("joints").columns.change([](auto& columns) { columns[0].name = "torque"; });
  EXPECT_EQ(complaint(beside), file + ": error: is corrupt: there is no number torque_peak");
  beside = good.beside;
  Trace& numbers = table("run");
  numbers.values[numbers.find("stability.index")] = -1;
  EXPECT_EQ(complaint(beside), file + ": error: is corrupt: stability.index is -1");
}

/// The checks of the supply read its table by the numbers of its columns.
TEST(Recordings, ASupplyOfAnotherFormIsRefused) {
  const Folder folder;
  const Recording r = run(shipped("hexapod.yaml", {"duration=0.05", "physics.engine=articulated", "supply.voltage=7.4"}));
  const auto complaint = [&](const auto& change) {
    Recording changed = r;
    change(changed.supply);
    write_recording(changed, {"", 0, "", "done"}, "h5", folder.path());
    return message_of([&] { read_recording(folder.path()); });
  };
  EXPECT_EQ(complaint([](Trace&) {}), kNoError);
  const std::string corrupt = folder / "trace.h5" + ": error: is corrupt: ";
  EXPECT_EQ(complaint([](Trace& supply) {
              supply.columns.change([](auto& columns) { columns.pop_back(); });
              supply.values.resize(supply.columns.size());
            }),
            corrupt + "the columns of /recording/supply are not those of a supply");
  EXPECT_EQ(complaint([](Trace& supply) {
              supply.columns.change([](auto& columns) { std::swap(columns[1].name, columns[2].name); });
            }),
            corrupt + "the columns of /recording/supply are not those of a supply");
  const std::string unlike = corrupt + "the times of /recording/supply are not those of /recording/ticks";
  EXPECT_EQ(complaint([](Trace& supply) { supply.values.resize(supply.columns.size()); }), unlike);
  EXPECT_EQ(complaint([](Trace& supply) { supply.values[0] = 1; }), unlike);
}

/// If the ticks exceed the largest number of rows, pairs of rows are merged. Peaks and sums are preserved.
TEST(Ticks, AreHalvedWhereThereAreMany) {
  const Scenario s = scenario(R"(
gaitlab: 1
name: long
duration: 45
robot: {base: fixed, position: [0, 0, 1]}
cpg: {type: sine, frequency: 1}
controller: {period: 0.002}
physics: {engine: articulated}
ground: {type: none}
trace: {period: 1}
)");
  const Recording r = run(s);
  const std::size_t rows = r.ticks.rows();
  EXPECT_EQ(rows, 11251U) << "22501 ticks, every second one";
  const Table table(r.ticks);
  for (std::size_t k = 1; k + 1 < rows; ++k) ASSERT_NEAR(table.at(k, "t") - table.at(k - 1, "t"), 0.004, 1e-9) << k;
  EXPECT_EQ(table.at(rows - 1, "t"), 45);
  for (std::size_t j = 0; j < r.joints.size(); ++j) {
    double peak = 0;
    for (std::size_t k = 0; k < rows; ++k) peak = std::max(peak, table.at(k, fmt::format("joint.{}.torque_peak", j)));
    EXPECT_EQ(peak, r.joints[j].torque_peak);
    EXPECT_NEAR(std::sqrt(table.at(rows - 1, fmt::format("joint.{}.torque_square", j)) / 45), r.joints[j].torque_rms, 1e-12);
  }
}

/// Recordings of a different robot are refused, even if their hashes are correct.
TEST(Recordings, OfAnotherRobotAreRefused) {
  const Folder folder;
  const Recording walked = run(shipped("hexapod.yaml", {"duration=0.02", "physics.engine=articulated"}));
  const auto complaint = [&](const Recording& recording, const char* scenario) {
    write_recording(recording, {resolved(shipped(scenario, {"duration=0.02"})), 1, "", "done"}, "h5", folder.path());
    const Result result = gaitlab("report .", folder.path());
    EXPECT_EQ(result.code, 2);
    return result.err;
  };
  EXPECT_EQ(complaint(walked, "pendulum.yaml"),
            ".: error: its recording does not fit its scenario: 22 joints, 1 in the scenario" + kRemedy);
  Recording forged = walked;
  forged.worst = {1.0, Stability::Source::contact, 1000};
  EXPECT_EQ(complaint(forged, "hexapod.yaml"),
            ".: error: its recording does not fit its scenario: stability.index is 1000, but the scenario has only 24 contact "
            "elements" +
                kRemedy);
  forged = walked;
  forged.trace.columns.change([&](auto& columns) { columns[forged.trace.find("base.x")].name = "base.u"; });
  EXPECT_EQ(complaint(forged, "hexapod.yaml"),
            ".: error: its recording does not fit its scenario: columns that every recording contains are missing" + kRemedy);
}

/// Without its table a run that fails by its supply would be feasible.
TEST(Recordings, WithoutTheSupplyOfTheirScenarioAreRefused) {
  const Folder folder;
  const Scenario powered = shipped("hexapod.yaml", {"duration=0.02", "physics.engine=articulated", "supply.voltage=7.4"});
  Recording r = run(powered);
  r.supply = {};
  write_recording(r, {resolved(powered), 1, "", "done"}, "h5", folder.path());
  const Result result = gaitlab("report .", folder.path());
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err,
            ".: error: its recording does not fit its scenario: there is no table of the scenario's supply" + kRemedy);
}

}  // namespace
}  // namespace gaitlab::test
