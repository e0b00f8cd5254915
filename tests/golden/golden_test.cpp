// Goldens as folders and as judges: damage has its own message, and only what strays fails.
#include "golden/golden.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "core/recording/atomic_file.h"
#include "golden/compare.h"
#include "golden/report.h"
#include "tests/folder.h"
#include "tests/golden/golden_sample.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;
using Sentences = std::vector<std::string>;

Golden golden_of(const Trace& trace) {
  Golden golden;
  golden.origin = {"walk", "bullet", "semi_implicit", 2.5e-5, "0.1.0+abc (GNU 12.2.0)", "GNU 12.2.0", "00000000000000aa"};
  golden.history = {{1, "first \"golden\"", "0.1.0+abc"}, {2, "stiffer feet", "0.1.0+abd"}};
  golden.run = {trace, unpack(pack(trace), "x").precision};
  golden.rounding.assign(trace.columns.size(), 0.0);
  golden.bands.assign(trace.columns.size(), Band{1e-5, 3e-4, 1e-6});
  golden.bands[0] = {};
  golden.numbers = {{"distance", "m", 0.5}, {"m0/active.torque.peak", "N m", 1.3}};
  golden.number_bands = {{1e-6, 2e-6, 1e-3}, {1e-3, 0, 1e-6}};
  return golden;
}

GoldenRun run_of(const Golden& golden) { return {golden.run.trace, golden.numbers}; }

// ---- the folder

TEST(Golden, IsReadAsItWasWritten) {
  const Folder folder;
  const Golden golden = golden_of(walk());
  write_golden(golden, folder.path() / "walk.golden");
  const Golden read = read_golden(folder.path() / "walk.golden");
  EXPECT_EQ(read.origin.name, "walk");
  EXPECT_EQ(read.origin.engine, "bullet");
  EXPECT_EQ(read.origin.integrator, "semi_implicit");
  EXPECT_EQ(read.origin.step, 2.5e-5);
  EXPECT_EQ(read.origin.build, golden.origin.build);
  EXPECT_EQ(read.origin.compiler, "GNU 12.2.0");
  EXPECT_EQ(read.origin.scenario, "00000000000000aa");
  ASSERT_EQ(read.history.size(), 2U);
  EXPECT_EQ(read.history[0].reason, "first \"golden\"");
  EXPECT_EQ(read.history[1].number, 2);
  EXPECT_EQ(read.run.precision, golden.run.precision);
  ASSERT_EQ(read.bands.size(), golden.bands.size());
  EXPECT_EQ(read.bands[2].ensemble, 1e-5);
  EXPECT_EQ(read.bands[2].halving, 3e-4);
  EXPECT_EQ(read.bands[2].width(), 3e-4);
  ASSERT_EQ(read.numbers.size(), 2U);
  EXPECT_EQ(read.numbers[1].name, "m0/active.torque.peak");
  EXPECT_EQ(read.numbers[1].value, 1.3);
  EXPECT_EQ(read.number_bands[0].floor, 1e-3);
  const std::string json = read_file(folder.path() / "walk.golden/golden.json");
  write_golden(golden, folder.path() / "walk.golden");
  EXPECT_EQ(read_file(folder.path() / "walk.golden/golden.json"), json);
  EXPECT_EQ(golden_folder("scenarios/hexapod.yaml"), "scenarios/hexapod.golden");
}

const std::string kText = "name: \"walk\"\nKp: 100\n\n";

TEST(Golden, KeepsTheResolvedScenario) {
  const Folder folder;
  Golden golden = golden_of(walk());
  golden.origin.resolved = kText;
  golden.origin.scenario = hash(kText);
  write_golden(golden, folder.path() / "walk.golden");
  EXPECT_EQ(read_golden(folder.path() / "walk.golden").origin.resolved, kText);
  const std::string json = read_file(folder.path() / "walk.golden/golden.json");
  EXPECT_NE(json.find("\n    \"Kp: 100\",\n"), std::string::npos) << json;  // a line each, for version control
  write_golden(golden_of(walk()), folder.path() / "walk.golden");           // as goldens were before
  EXPECT_EQ(read_file(folder.path() / "walk.golden/golden.json").find("resolved"), std::string::npos);
  EXPECT_EQ(read_golden(folder.path() / "walk.golden").origin.resolved, "");
}

TEST(Golden, TellsWhichLinesOfTheScenarioChanged) {
  Golden golden = golden_of(walk());
  GoldenProvenance now = golden.origin;
  EXPECT_EQ(golden::origin_changes(golden, now), "");
  now.resolved = "name: \"walk\"\nKp: 97\n\n";
  now.scenario = hash(now.resolved);
  EXPECT_EQ(golden::origin_changes(golden, now), "  scenario: its resolved text is another\n");
  golden.origin.resolved = kText;
  EXPECT_EQ(golden::origin_changes(golden, now),
            "  scenario: its resolved text is another:\n    line 2: \"Kp: 97\", was \"Kp: 100\"\n");
}

class GoldenFolder : public ::testing::Test {
 protected:
  void SetUp() override { write_golden(golden_of(walk()), folder_.path()); }
  [[nodiscard]] std::string content(const std::string& name) const { return read_file(folder_.path() / name); }
  void put(const std::string& name, const std::string& text) const {
    // Thousands of times: without fsync, and without ext4's flush of a file that was made empty and written again.
    std::filesystem::remove(folder_.path() / name);
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
  }
  void replace(const std::string& what, const std::string& by) const {
    std::string text = content("golden.json");
    text.replace(text.find(what), what.size(), by);
    put("golden.json", text);
  }
  // What reading says, with the folder left out.
  [[nodiscard]] std::string complaint() const {
    std::string text = refusal([&] { (void)read_golden(folder_.path()); });
    const std::string path = folder_.path().string();
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path)) text.replace(at, path.size(), "G");
    return text;
  }

  Folder folder_;
};

TEST_F(GoldenFolder, MissingFiles) {
  EXPECT_EQ(complaint(), "");
  fs::remove(folder_.path() / "trace.golden");
  EXPECT_EQ(complaint(), "G/trace.golden: error: is missing: the golden is only half there");
  fs::remove(folder_.path() / "golden.json");
  EXPECT_EQ(complaint(), "G/golden.json: error: is missing: the golden is only half there");
  EXPECT_EQ(refusal([&] { (void)read_golden("no/where.golden"); }),
            "no/where.golden: error: there is no such golden; gaitlab approve makes it");
}

TEST_F(GoldenFolder, DamagedJson) {
  const std::string text = content("golden.json");
  put("golden.json", "");
  EXPECT_EQ(complaint(), "G/golden.json: error: is truncated: 0 bytes");
  put("golden.json", text.substr(0, 400));
  EXPECT_EQ(complaint(), "G/golden.json: error: is truncated: it ends after 400 bytes");
  put("golden.json", R"({"distance": 1})");
  EXPECT_EQ(complaint(), "G/golden.json: error: is not a golden of gaitlab");
  put("golden.json", "distance: 1\n");
  EXPECT_EQ(complaint(), "G/golden.json: error: is not a golden of gaitlab");
  put("golden.json", text);
  replace("\"gaitlab_golden\": 1", "\"gaitlab_golden\": 2");
  EXPECT_EQ(complaint(), "G/golden.json: error: has golden format 2; this gaitlab reads 1: take the gaitlab that wrote it");
  put("golden.json", text);
  replace("\"halving\":0.0003", "\"halving\":0.0009");
  EXPECT_EQ(complaint(),
            "G/golden.json: error: is corrupt or was changed by hand: its checksum is another; bands are made by gaitlab "
            "approve");
  put("golden.json", text);
  replace("\"rows\"", "\"rows");
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: it is not JSON");
}

TEST_F(GoldenFolder, NoDamageOfTheJsonIsTakenNorACrash) {
  const std::string text = content("golden.json");
  for (std::size_t at = 0; at < text.size(); at += 3) {
    put("golden.json", text.substr(0, at));
    EXPECT_NE(complaint(), "") << at;
  }
  std::mt19937_64 random(3);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = text;
    const std::size_t at = random() % text.size();
    damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1 + random() % 255));
    put("golden.json", damaged);
    EXPECT_NE(complaint(), "") << at;
  }
}

TEST_F(GoldenFolder, ChecksumsThatAreRightOnOtherContent) {
  std::string text = content("golden.json");
  const std::size_t end = text.rfind(",\n  \"checksum\"");
  const std::string content = text.substr(0, end);
  const auto put_checked = [&](const std::string& changed) {
    put("golden.json", changed + ",\n  \"checksum\": \"" + hash(changed) + "\"\n}\n");
  };
  text.replace(text.rfind("\"unit\":\"m\""), 10, "\"unit\":[1]");  // of a number
  put_checked(text.substr(0, end));
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: an entry is missing or of another type");
  put_checked(content + ",\n  \"resolved\": [1]");
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: an entry is missing or of another type");
  put_checked(content + ",\n  \"resolved\": [\"Kp: 100\"]");
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: its resolved scenario is not the one that was approved");
}

TEST_F(GoldenFolder, TheTwoFilesBelongTogether) {
  const std::string old_trace = content("trace.golden");
  const std::string old_json = content("golden.json");
  write_golden(golden_of(walk(101, 1.7)), folder_.path());
  const std::string trace = content("trace.golden");
  put("trace.golden", old_trace);
  EXPECT_EQ(complaint(), "G/trace.golden: error: belongs to another approval than golden.json");
  put("trace.golden", old_trace.substr(0, 100));
  EXPECT_EQ(complaint().substr(0, 46),
            "G/trace.golden: error: is truncated: 100 of " + std::to_string(old_trace.size()).substr(0, 2));
  // Killed before golden.json was replaced: the old one holds; killed after: the new one.
  put("trace.golden", old_trace);
  put("trace.golden.next", trace);
  EXPECT_NEAR(read_golden(folder_.path()).run.precision[1], 3.4 / 65534, 1e-6);
  put("golden.json", old_json);
  EXPECT_NEAR(read_golden(folder_.path()).run.precision[1], 2.6 / 65534, 1e-6);
}

// Twice killed: the first time golden.json was already new, the second time before it was written again.
TEST_F(GoldenFolder, TheNextWriteFinishesWhatAKillLeft) {
  const std::string old_trace = content("trace.golden");
  write_golden(golden_of(walk(101, 1.7)), folder_.path());
  put("trace.golden.next", content("trace.golden"));
  put("trace.golden", old_trace);
  fs::create_directory(folder_.path() / "golden.json.part");  // the next write fails here
  EXPECT_THROW(write_golden(golden_of(walk(101, 1.9)), folder_.path()), RunError);
  EXPECT_NEAR(read_golden(folder_.path()).run.precision[1], 3.4 / 65534, 1e-6);
}

TEST_F(GoldenFolder, IsWrittenByOneAtATime) {
  const int other = ::open(folder_.path().c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  EXPECT_EQ(refusal([&] { write_golden(golden_of(walk()), folder_.path()); }),
            folder_.path().string() + ": error: is being written by another process; call again");
  ::close(other);
  EXPECT_EQ(refusal([&] { write_golden(golden_of(walk()), folder_.path()); }), "");
}

// ---- scales and bands

TEST(GoldenBands, ScalesHaveFloors) {
  const std::vector<double> scale = scales(walk());
  EXPECT_NEAR(scale[1], 2.6, 0.01);
  EXPECT_EQ(scale[2], 1e-3 * scale[1]);  // its own range is 2e-7
  EXPECT_NEAR(scale[3], 1.2, 0.01);
  EXPECT_EQ(scale[4], 1e-6);  // stands still, and nothing else is in m
  EXPECT_EQ(scales({{"a", "m", -2}, {"b", "m", 1e-9}, {"c", "N m", 0}}), (std::vector<double>{2, 2e-3, 1e-6}));
}

TEST(GoldenBands, TheLargestPartIsTheBand) {
  const Trace trace = walk();
  const GoldenRun base{trace, {{"distance", "m", 2}}};
  const auto shifted = [&](std::size_t column, double by, double distance) {
    GoldenRun run{trace, {{"distance", "m", distance}}};
    for (std::size_t k = 0; k < trace.rows(); ++k) run.trace.values[k * trace.columns.size() + column] += by;
    return run;
  };
  const std::vector<GoldenRun> ensemble{shifted(1, 1e-4, 2.002), shifted(1, -3e-4, 1.998)};
  const Bands bands = calibrate(base, ensemble, shifted(3, 5e-4, 2.01));
  const std::vector<double> scale = scales(trace);
  // 1e-12: rounding of 1.3 + 1e-4.
  EXPECT_NEAR(bands.columns[1].ensemble, 10 * 3e-4 / scale[1], 1e-12);
  EXPECT_EQ(bands.columns[1].halving, 0);
  EXPECT_NEAR(bands.columns[3].halving, 3 * 5e-4 / scale[3], 1e-12);
  EXPECT_EQ(bands.columns[3].ensemble, 0);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(bands.columns[i].floor, 1e-6);
  EXPECT_EQ(bands.columns[1].width(), bands.columns[1].ensemble);
  EXPECT_NEAR(bands.numbers[0].ensemble, 10 * 0.001, 1e-12);
  EXPECT_NEAR(bands.numbers[0].halving, 3 * 0.005, 1e-12);
  EXPECT_EQ(bands.numbers[0].floor, 1e-6);
}

TEST(GoldenBands, NumbersAreFoundByName) {
  const Trace trace = walk();
  const GoldenRun base{trace, {{"distance", "m", 2}}};
  const GoldenRun longer{trace, {{"cost", "", 9}, {"distance", "m", 2.002}}};
  const Bands bands = calibrate(base, std::span(&longer, 1), longer);
  EXPECT_NEAR(bands.numbers[0].ensemble, 10 * 0.001, 1e-12);
  EXPECT_NEAR(bands.numbers[0].halving, 3 * 0.001, 1e-12);
  EXPECT_THROW(calibrate(longer, std::span(&base, 1), base), std::invalid_argument);
}

// ---- the comparison

TEST(GoldenCompare, TheSameRunPassesWithNothingLeft) {
  const Golden golden = golden_of(walk());
  Golden read = golden;
  read.run = unpack(pack(golden.run.trace), "x");  // as it comes from the file
  read.rounding = mean_squares(golden.run.trace, read.run.trace);
  EXPECT_LE(std::sqrt(read.rounding[1]), 0.5 * read.run.precision[1]);
  EXPECT_GT(read.rounding[1], 0);
  const GoldenDifference d = compare(read, run_of(golden));
  EXPECT_TRUE(d.passed());
  EXPECT_EQ(d.findings, Sentences{});
  for (const ColumnCheck& column : d.columns) {
    EXPECT_EQ(column.rms, 0) << column.name;
    EXPECT_LT(column.maximum, 1e-15) << column.name;  // half a step of the grid, less itself
    EXPECT_FALSE(column.outside);
  }
  EXPECT_EQ(d.numbers[0].change, 0);
}

// A fifth of the grid's step, which rounding alone would make a third of it.
TEST(GoldenCompare, MeasuresBelowThePrecision) {
  std::mt19937_64 random(4);
  Trace noise = walk(1001);
  for (std::size_t k = 0; k < 1001; ++k) noise.values[k * 5 + 3] = static_cast<double>(random() >> 11U) * 0x1p-53;
  const Golden golden = golden_of(noise);
  Golden read = golden;
  read.run = unpack(pack(noise), "x");
  read.rounding = mean_squares(noise, read.run.trace);
  GoldenRun run = run_of(golden);
  const double by = 0.2 * read.run.precision[3];
  for (std::size_t k = 0; k < 1001; ++k) run.trace.values[k * 5 + 3] += random() % 2 == 0 ? by : -by;
  // Rounding errors e do not cancel over 1001 rows: 2 by e / sqrt(1001) of by^2, e = precision / sqrt(12): 9 %; thrice the
  // half.
  EXPECT_NEAR(compare(read, run).columns[2].rms * scales(read.run.trace)[3], by, 0.14 * by);
}

TEST(GoldenCompare, WhatStraysFailsAlone) {
  const Golden golden = golden_of(walk());
  GoldenRun run = run_of(golden);
  const std::size_t width = golden.run.trace.columns.size();
  for (std::size_t k = 50; k < 101; ++k) run.trace.values[k * width + 1] += 2.6 * 1.5e-3;  // 5 bands, from 1 s on
  run.numbers[0].value = 0.5004;                                                           // 0.8 of its band
  const GoldenDifference d = compare(golden, run);
  EXPECT_FALSE(d.passed());
  EXPECT_EQ(d.findings, Sentences{});
  EXPECT_FALSE(d.columns[0].passed());
  EXPECT_TRUE(d.columns[1].passed());
  EXPECT_TRUE(d.columns[2].passed());
  EXPECT_TRUE(d.columns[3].passed());
  // Of 101 rows 51 are off; the range is a sine's at 50 samples a period, 0.2 % less than 2.6; the grid's step is 1.5e-5.
  EXPECT_NEAR(d.columns[0].rms, 1.5e-3 * std::sqrt(51.0 / 101), 3e-5);
  EXPECT_NEAR(d.columns[0].maximum, 1.5e-3, 3e-5);
  EXPECT_EQ(*d.columns[0].outside, 1.0);
  EXPECT_EQ(d.worst_column()->name, "joint.0.torque");
  EXPECT_TRUE(d.numbers[0].passed());
  EXPECT_NEAR(d.worst_number()->ratio(), 0.8, 1e-12);
  run = run_of(golden);
  run.numbers[0].value = 0.501;
  EXPECT_FALSE(compare(golden, run).passed());
}

// Rounding alone is far beyond three such bands, and no difference.
TEST(GoldenCompare, RoundingIsNotOutside) {
  Golden golden = golden_of(walk());
  const Trace exact = golden.run.trace;
  golden.run = unpack(pack(exact), "x");
  golden.rounding = mean_squares(exact, golden.run.trace);
  golden.bands.assign(golden.bands.size(), Band{0, 0, 1e-6});
  GoldenRun run{exact, golden.numbers};
  EXPECT_FALSE(compare(golden, run).columns[0].outside);
  for (std::size_t k = 60; k < 101; ++k) run.trace.values[k * 5 + 1] += 2 * golden.run.precision[1];
  EXPECT_EQ(compare(golden, run).columns[0].outside, 1.2);
}

TEST(GoldenCompare, LateIsToldApartFromAnotherShape) {
  const Golden golden = golden_of(walk());
  GoldenRun run = run_of(golden);
  for (std::size_t k = 0; k < 101; ++k)
    run.trace.values[k * 5 + 1] = 1.3 * std::sin(2 * std::numbers::pi * (static_cast<double>(k) * kSpacing - 0.013));
  const ColumnCheck torque = compare(golden, run).columns[0];
  EXPECT_FALSE(torque.passed());
  EXPECT_NEAR(torque.time_shift, 0.013, 1e-4);  // see time_shift: wrong by (w h)^3 of a sample, 0.002 * 0.02 s
  EXPECT_LT(torque.rms_after_shift, 0.01 * torque.rms);
}

TEST(GoldenCompare, FormComesFirst) {
  const Golden golden = golden_of(walk());
  GoldenRun run = run_of(golden);
  run.trace.values[3 * 5 + 2] = kNan;
  GoldenDifference d = compare(golden, run);
  EXPECT_EQ(d.findings, Sentences{"joint.1.torque is not finite at t = 0.06 s"});
  EXPECT_EQ(d.columns.size(), 3U);
  EXPECT_FALSE(d.passed());

  run = run_of(golden);
  run.trace = walk(61);
  d = compare(golden, run);
  EXPECT_EQ(d.findings, Sentences{"61 rows, in the golden 101"});
  EXPECT_EQ(d.columns.size(), 4U);
  EXPECT_TRUE(d.columns[0].passed());
  EXPECT_FALSE(d.passed());

  run = run_of(golden);
  run.trace.columns[2].name = "joint.7.torque";
  EXPECT_EQ(compare(golden, run).findings, (Sentences{"1 column only in the golden: joint.1.torque",
                                                      "1 column only in this run: "
                                                      "joint.7.torque"}));
  run = run_of(golden);
  for (std::size_t k = 0; k < 101; ++k) run.trace.values[k * 5] *= 0.5;
  d = compare(golden, run);
  EXPECT_EQ(d.findings, Sentences{"a row every 0.01 s, in the golden every 0.02 s"});
  EXPECT_TRUE(d.columns.empty());
  EXPECT_EQ(d.worst_column(), nullptr);

  run = run_of(golden);
  run.numbers[1].value = kNan;
  d = compare(golden, run);
  EXPECT_EQ(d.findings, Sentences{"m0/active.torque.peak is not finite"});
  EXPECT_FALSE(d.numbers[1].passed());
  EXPECT_EQ(d.worst_number()->name, "m0/active.torque.peak");
  run.numbers.pop_back();
  EXPECT_EQ(compare(golden, run).findings, Sentences{"m0/active.torque.peak is a number of the golden only"});
  EXPECT_FALSE(compare(golden, {}).passed());
}

}  // namespace
}  // namespace gaitlab::test
