// Tests of the complete outputs and messages of compare and export, and of HDF5 traces.
#include <nlohmann/json.hpp>

#include "core/recording/csv.h"
#include "core/recording/h5.h"
#include "core/recording/run_files.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

class CompareCommand : public ::testing::Test {
 protected:
  Result compare(const std::string& arguments) { return gaitlab("compare " + arguments, folder / ""); }
  void expect_report(const std::string& arguments, const std::string& text) {
    const Result result = compare(arguments);
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out, text);
    EXPECT_EQ(result.err, "");
  }
  void expect_refused(const std::string& arguments, const std::string& message) {
    const Result result = compare(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, message + "\n");
    EXPECT_EQ(result.out, "");
  }
  /// Creates a run folder with this trace, and with this summary unless it is empty.
  void make_run(const std::string& name, const std::string& csv, const std::string& summary = "") {
    std::filesystem::create_directory(folder / name);
    folder.write(name + "/trace.csv", csv);
    if (!summary.empty()) folder.write(name + "/summary.json", summary);
  }

  Folder folder;
};

const std::string kSummaryA =
    R"({"name": "a", "engine": "bullet", "joints": ["m0/active"], "step": 2.5e-05, "distance": 0.5, "speed": 0.25, "displacement": [0.5, 0],
        "per_joint": {"m0/active": {"torque": {"peak": 0.1, "rms": 0.05}}, "m1/passive": {"torque": {"peak": 1.5, "rms": 0.5}}},
        "limit_cycle": {"found": false, "period": 0}, "stability": {"max": 0.4}, "trace_hash": "00000000000000aa"})";
const std::string kSummaryB =
    R"({"name": "a", "engine": "bullet", "joints": ["m0/active"], "step": 1.25e-05, "distance": 0.51, "speed": 0.25, "displacement": [0.5, 0.1],
        "per_joint": {"m0/active": {"torque": {"peak": 9.5, "rms": 0.05}}, "m1/passive": {"torque": {"peak": 1.2, "rms": 0.5}}},
        "limit_cycle": {"found": true, "period": 4}, "stability": {"max": 0.2}, "trace_hash": "00000000000000bb"})";

TEST_F(CompareCommand, DifferencesFromALog) {
  make_run("a", "t\n0\n1\n", R"({"measured": {"angle": {"mae": 0.04, "peak": 0.125}, "limit": {"logged": 0.25}}})");
  make_run("b", "t\n0\n1\n", R"({"measured": {"angle": {"mae": 0.02, "peak": 0.125}}})");
  const std::string out = compare("a b").out;
  for (const char* line : {"\nmeasured angle mae, rad                0.04               0.02  -50 %\n",
                           "\nmeasured angle peak, rad              0.125              0.125  equal\n",
                           "\nmeasured limit logged                  0.25                  -  differs\n"})
    EXPECT_TRUE(contains(out, line)) << out;
}

TEST_F(CompareCommand, SettingsNumbersAndWorstColumns) {
  make_run("a", "t,joint.0.angle,joint.0.speed,base.x\n0,0,0,1\n0.5,1,0,2\n1,2,0,3\n", kSummaryA);
  make_run("b", "t,joint.0.angle,joint.0.speed,base.x\n0,0,0,1\n0.5,1.5,0,2\n1,2,0,3.25\n", kSummaryB);
  folder.write("a/scenario.resolved.yaml", "physics:\n  step: 2.5e-05\ncontroller: {Kp: 100}\n");
  folder.write("b/scenario.resolved.yaml", "physics:\n  step: 1.25e-05\ncontroller: {Kp: 100, Kd: 1}\n");
  expect_report("a b",
                "A: a/trace.csv (3 rows)\n"
                "B: b/trace.csv (3 rows)\n"
                "\n"
                "settings: A -> B\n"
                "  physics.step: 2.5e-05 -> 1.25e-05\n"
                "  controller.Kd: not set -> 1\n"
                "\n"
                "summary                                      A                  B  B - A\n"
                "step, s                                2.5e-05           1.25e-05  -50 %\n"
                "distance, m                                0.5               0.51  +2 %\n"
                "displacement x, m                          0.5                0.5  equal\n"
                "displacement y, m                            0                0.1  +0.1\n"
                "speed, m/s                                0.25               0.25  equal\n"
                "limit cycle found                        false               true  differs\n"
                "limit cycle period, s                        0                  4  +4\n"
                "m1/passive torque peak, N m                1.5                1.2  -20 %\n"
                "m1/passive torque RMS, N m                 0.5                0.5  equal\n"
                "stability max                              0.4                0.2  -50 %\n"
                "trace hash                    00000000000000aa   00000000000000bb  differs\n"
                "\n"
                "column             RMS   max  RMS/range  max/range  from t =  late by\n"
                "m0/active angle  0.289   0.5     14.4 %       25 %     0.5 s        -\n"
                "base.x           0.144  0.25     7.22 %     12.5 %       1 s        -\n"
                "1 of 3 columns are bit-equal in the 3 rows compared\n"
                "first column to diverge: m0/active angle at t = 0.5 s\n");
}

/// A percentage has the sign of the change, also of a number below 0.
TEST_F(CompareCommand, APercentageHasTheSignOfTheChange) {
  make_run("a", "t\n0\n", R"({"distance": 2, "displacement": [-0.5, -0.5]})");
  make_run("b", "t\n0\n", R"({"distance": 1, "displacement": [-0.25, -1]})");
  const std::string out = compare("a b").out;
  for (const char* const row :
       {" 2                  1  -50 %\n", " -0.5              -0.25  +50 %\n", " -0.5                 -1  -100 %\n"})
    EXPECT_TRUE(contains(out, row)) << out;
}

/// The output names a joint if both runs give it the same name, and `--columns` accepts this name.
TEST_F(CompareCommand, NamesOfJoints) {
  const std::string trace = "t,joint.0.angle,joint.1.angle\n0,0,0\n0.5,1,1\n";
  make_run("a", trace, R"({"joints": ["m0/active", "m0/passive"]})");
  make_run("b", "t,joint.0.angle,joint.1.angle\n0,0,0\n0.5,2,3\n", R"({"joints": ["m0/active", "m1/active"]})");
  Result result = compare("a b");
  EXPECT_NE(result.out.find("\nthe robots have different joints (2 and 2); columns are matched only by their numbers\n"),
            std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("\nm0/active angle "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\njoint.1.angle "), std::string::npos) << result.out;
  result = compare("a b --columns 'm0/*'");
  EXPECT_NE(result.out.find("\n0 of 1 columns are "), std::string::npos) << result.out;
  expect_refused("a b --columns 'm0/active angel'",
                 "--columns: error: 'm0/active angel' matches no column of either trace; did you mean 'm0/active angle'?");
}

TEST_F(CompareCommand, TheTenWorstAndAllOnRequest) {
  std::string head = "t";
  std::string row = "\n0";
  std::string other = "\n0";
  std::string last = "\n0.5";
  for (int i = 0; i < 12; ++i) {
    head += ",joint." + std::to_string(i) + ".angle";
    row += ",0";
    other += ",0." + std::string(i < 9 ? "0" : "") + std::to_string(i + 1);
    last += ",1";
  }
  make_run("a", head + row + last + "\n", "{}");
  make_run("b", head + other + last + "\n", "{}");
  Result result = compare("a b");
  EXPECT_NE(result.out.find("late by\njoint.11.angle "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\nand 2 more: --all shows them\n0 of 12 columns are "), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("\njoint.1.angle "), std::string::npos) << result.out;
  result = compare("a b --all");
  EXPECT_NE(result.out.find("\njoint.0.angle "), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("--all"), std::string::npos) << result.out;
}

TEST_F(CompareCommand, ColumnsAndTraceFiles) {
  make_run("a", "t,joint.0.angle,base.x\n0,1,1\n0.5,2,2\n", kSummaryA);
  folder.write("b.csv", "t,joint.0.angle,base.x,base.y\n0,1,1,7\n0.5,3,3,7\n1,4,4,7\n");
  expect_report("a b.csv --columns 'base.*'",
                "A: a/trace.csv (2 rows)\n"
                "B: b.csv (3 rows)\n"
                "1 column in B only: base.y\n"
                "A has 2 rows, B has 3\n"
                "\n"
                "settings: not compared, because a CSV file contains none\n"
                "\n"
                "summary numbers: not compared, because a trace file contains none\n"
                "\n"
                "column    RMS  max  RMS/range  max/range  from t =  late by\n"
                "base.x  0.707    1     70.7 %      100 %     0.5 s        -\n"
                "0 of 1 columns are bit-equal in the 2 rows compared\n"
                "first column to diverge: base.x at t = 0.5 s\n");
  expect_report("b.csv b.csv",
                "A: b.csv (3 rows)\n"
                "B: b.csv (3 rows)\n"
                "\n"
                "settings: not compared, because a CSV file contains none\n"
                "\n"
                "summary numbers: not compared, because a trace file contains none\n"
                "\n"
                "3 of 3 columns are bit-equal in the 3 rows compared\n");
  expect_refused("a b.csv --columns base.z --columns 'joint.*' --columns nonsense",
                 "--columns: error: 'base.z' matches no column of either trace; did you mean 'base.x'?\n"
                 "--columns: error: 'nonsense' matches no column of either trace");
}

TEST_F(CompareCommand, UnreadableInput) {
  make_run("a", "t,x\n0,1\n", kSummaryA);
  expect_refused("a nowhere", "nowhere: error: there is no such run folder or trace file");
  std::filesystem::create_directory(folder / "empty");
  expect_refused("empty a", "empty: error: holds neither trace.h5 nor trace.csv: it is not a run folder");
  folder.write("notes.txt", "t,x\n");
  expect_refused("a notes.txt", "notes.txt: error: is neither a run folder nor a trace file (.h5, .csv)");
  make_run("unfinished", "t,x\n0,1\n");
  expect_refused("a unfinished", "unfinished/summary.json: error: cannot be read: No such file or directory");
  make_run("cut", "t,x\n0,1\n", kSummaryA.substr(0, 140));
  expect_refused("a cut", "cut/summary.json:2:7: error: is not JSON from here on: it is truncated or damaged");
  make_run("list", "t,x\n0,1\n", "[1, 2]\n");
  expect_refused("a list", "list/summary.json:1:1: error: holds no JSON object: it is not a summary");
  make_run("huge", "t,x\n0,1\n", R"({"distance": 1e999})");
  expect_refused("a huge", "huge/summary.json: error: holds a number that is outside the range of a double");
  folder.write("half.csv", "t,x\n0,1\n0.5,");
  expect_refused("a half.csv", "half.csv:3:5: error: the last line has no line end: the file is truncated");
  folder.write("half.h5", "gaitlab-trace-1\n");
  expect_refused("a half.h5", "half.h5: error: is truncated: 16 bytes");
  EXPECT_EQ(compare("a").code, 2);
}

/// A rounding error has no percentage.
TEST_F(CompareCommand, NumbersBelowTheNoise) {
  make_run("a", "t,x\n0,1\n", R"({"distance": 0.5, "displacement": [1e-6, -2.09e-18]})");
  make_run("b", "t,x\n0,1\n", R"({"distance": 0.5, "displacement": [2e-6, -2.69e-18]})");
  const std::string out = compare("a b").out;
  EXPECT_TRUE(contains(out, "-2.69e-18  -6e-19\n")) << out;
  EXPECT_TRUE(contains(out, "2e-06  +100 %\n")) << out;
}

TEST_F(CompareCommand, SummaryOfOtherTypesIsShownAsItIs) {
  make_run("a", "t,x\n0,1\n", R"({"distance": "far", "displacement": 3, "per_joint": [1, {"torque": 2}], "stability": null})");
  const Result result = compare("a a");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("far                far  equal\n"), std::string::npos) << result.out;
}

class Formats : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
    folder.write("good.yaml", "gaitlab: 1\nrobot: {modules: mtran}\nduration: 0.1\ncpg: {type: sine}\n");
    ASSERT_EQ(gaitlab("run good.yaml --seed 12 --quiet --out h5", folder / "").code, 0);
    ASSERT_EQ(gaitlab("run good.yaml --seed 12 --quiet --out csv --format csv", folder / "").code, 0);
  }
  Result gaitlab_here(const std::string& arguments) { return gaitlab(arguments, folder / ""); }

  Folder folder;
};

TEST_F(Formats, HoldTheSameTrace) {
  EXPECT_FALSE(std::filesystem::exists(folder / "csv/trace.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "h5/trace.csv"));
  const StoredTrace stored = read_h5(folder / "h5/trace.h5");
  EXPECT_EQ(stored.origin.scenario, read(folder / "h5/scenario.resolved.yaml"));
  EXPECT_EQ(stored.origin.seed, 12);
  const nlohmann::json summary = read_summary(folder / "h5");
  EXPECT_EQ(stored.origin.build, summary["build"]);
  EXPECT_EQ(hash(stored.trace), summary["trace_hash"]);
  const std::size_t torque = stored.trace.find("joint.0.torque");
  ASSERT_LT(torque, stored.trace.columns.size());
  EXPECT_EQ(stored.trace.columns[torque].unit, "N m");
  EXPECT_FALSE(stored.trace.columns[torque].definition.empty());
  EXPECT_EQ(hash(read_csv(folder / "csv/trace.csv")), hash(stored.trace));
  const Result result = gaitlab_here("compare h5 csv");
  EXPECT_NE(result.out.find("\nsettings: the same\n\nsummary"), std::string::npos) << result.out;
  EXPECT_TRUE(result.out.ends_with(" columns are bit-equal in the 21 rows compared\n")) << result.out;
  EXPECT_EQ(result.out.find("column "), std::string::npos) << result.out;
}

TEST_F(Formats, TheFilesLineNamesTheTrace) {
  const auto files = [&](const std::string& arguments) {
    const std::string out = gaitlab_here("run good.yaml " + arguments).out;
    return out.substr(out.find("  files"));
  };
  EXPECT_EQ(files("--out x --verbose"),
            "  files     x: trace.h5, summary.json, verdict.json,\n            scenario.resolved.yaml, figure.svg\n");
  EXPECT_EQ(files("--out y --format csv --no-report"),
            "  files     y: trace.csv, recording.h5, summary.json, verdict.json,\n            scenario.resolved.yaml, "
            "figure.svg\n");
  const Result result = gaitlab_here("run good.yaml --format xml --out z");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "gaitlab run: error: --format is 'xml'; expected h5 or csv\n");
}

TEST_F(Formats, ExportWritesWhatFormatCsvWrites) {
  Result result = gaitlab_here("export h5 --to csv new.csv");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(read(folder / "new.csv"), read(folder / "csv/trace.csv"));
  const std::size_t columns = read_h5(folder / "h5/trace.h5").trace.columns.size();
  EXPECT_EQ(result.out, fmt::format("new.csv: 21 rows of {} columns\n", columns));

  folder.write("mine.csv", "do not touch");
  result = gaitlab_here("export h5 --to csv mine.csv");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "mine.csv: error: exists; nothing was written\n");
  EXPECT_EQ(read(folder / "mine.csv"), "do not touch");
  EXPECT_EQ(gaitlab_here("export h5 --to csv no/where.csv").err,
            "no/where.csv: error: cannot be written: its folder does not exist\n");
  EXPECT_EQ(gaitlab_here("export nothing --to csv x.csv").err, "nothing: error: there is no such run folder or trace file\n");
  EXPECT_EQ(gaitlab_here("export h5 --to xml x.csv").code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "x.csv"));
}

}  // namespace
}  // namespace gaitlab::test
