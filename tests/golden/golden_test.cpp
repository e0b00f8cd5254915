// Tests of golden folders. Every kind of damage has a specific message.
#include "golden/golden.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "core/files/atomic_file.h"
#include "golden/report.h"
#include "tests/folder.h"
#include "tests/golden/golden_sample.h"
#include "tests/messages.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;
// ---- the folder

TEST(Golden, IsReadAsItWasWritten) {
  const Folder folder;
  const Golden golden = sample_golden(walk());
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
  const std::string json = read_file(folder.path() / "walk.golden/golden.json", kMostJson);
  write_golden(golden, folder.path() / "walk.golden");
  EXPECT_EQ(read_file(folder.path() / "walk.golden/golden.json", kMostJson), json);
  EXPECT_EQ(golden_folder("scenarios/hexapod.yaml"), "scenarios/hexapod.golden");
}

const std::string kText = "name: \"walk\"\nKp: 100\n\n";

TEST(Golden, KeepsTheResolvedScenario) {
  const Folder folder;
  Golden golden = sample_golden(walk());
  golden.origin.resolved = kText;
  golden.origin.scenario = hash(kText);
  write_golden(golden, folder.path() / "walk.golden");
  EXPECT_EQ(read_golden(folder.path() / "walk.golden").origin.resolved, kText);
  const std::string json = read_file(folder.path() / "walk.golden/golden.json", kMostJson);
  EXPECT_NE(json.find("\n    \"Kp: 100\",\n"), std::string::npos) << json;  // one line each, for version control
  golden.origin.resolved = "name: \xff\n";                                  // JSON cannot contain this byte
  write_golden(golden, folder.path() / "walk.golden");
  EXPECT_EQ(read_file(folder.path() / "walk.golden/golden.json", kMostJson).find("resolved"), std::string::npos);
  EXPECT_EQ(read_golden(folder.path() / "walk.golden").origin.resolved, "");
}

TEST(Golden, KeepsTheVerdict) {
  const Folder folder;
  Golden golden = sample_golden(walk());
  golden.verdict = Word::not_judged;
  write_golden(golden, folder.path() / "walk.golden");
  EXPECT_EQ(read_golden(folder.path() / "walk.golden").verdict, Word::not_judged);
}

// ---- texts of the changes

TEST(GoldenReport, NamesTheSettingsThatChanged) {
  Golden golden = sample_golden(walk());
  GoldenProvenance now = golden.origin;
  EXPECT_EQ(golden::origin_changes(golden.origin, now), "");
  now.engine = "articulated";
  now.resolved = "name: \"walk\"\nKp: 97\n\n";
  now.scenario = hash(now.resolved);
  EXPECT_EQ(golden::origin_changes(golden.origin, now),
            "  engine: bullet -> articulated\n  the scenario has changed; the golden does not contain the approved scenario, "
            "which is not UTF-8\n");
  golden.origin.resolved = kText;
  EXPECT_EQ(golden::origin_changes(golden.origin, now), "  Kp: 100 -> 97\n");
  now.resolved = "name: fast\nKp: 97\n";
  EXPECT_EQ(golden::origin_changes(golden.origin, now, 1), "  name: \"walk\" -> fast\n  ... and 1 more setting\n");
}

TEST(GoldenReport, NamesTheBuildsByWhatDiffers) {
  const Golden golden = sample_golden(walk());
  GoldenProvenance now = golden.origin;
  now.build = "0.1.0+abd (GNU 12.2.0)";
  EXPECT_EQ(golden::origin_changes(golden.origin, now), "  build: 0.1.0+abc -> 0.1.0+abd\n");
  now.build = "0.1.0+abc (Clang 14.0.6)";
  EXPECT_EQ(golden::origin_changes(golden.origin, now), "  build: 0.1.0+abc (GNU 12.2.0) -> 0.1.0+abc (Clang 14.0.6)\n");
}

TEST(GoldenReport, NamesTheVerdictWhereItChanged) {
  Golden golden = sample_golden(walk());
  GoldenRun run = run_of(golden);
  run.verdict = Word::infeasible;
  run.why = "joint m7/passive is at a limit of its motor for 22 % of the time, and the longest stretch of it is 0.83 s";
  EXPECT_EQ(golden::verdict_change(golden, run),
            "  verdict: feasible -> infeasible: joint m7/passive is at a limit of its motor for 22 % of the time,\n"
            "  and the longest stretch of it is 0.83 s\n");
  golden.verdict = Word::infeasible;
  EXPECT_EQ(golden::verdict_change(golden, run), "");
}

/// Difference with twelve columns and two numbers, of which some are outside their bands, each by one band more than the
/// previous.
GoldenDifference difference_of(std::size_t columns, std::size_t numbers) {
  GoldenDifference d;
  for (std::size_t i = 0; i < columns; ++i) {
    const std::string number = std::to_string(i);
    ColumnCheck check{"joint." + number + ".torque", "m" + number + "/active torque", "N m"};
    check.band = 1e-4;
    check.rms = static_cast<double>(i + 2) * check.band;
    check.scale = 2;
    if (i > 0) check.outside = 0.02 * static_cast<double>(i);
    if (i == columns - 1) check.time_shift = 0.013;
    d.columns.push_back(check);
  }
  d.columns.push_back({"base.x", "base.x", "m", 0, 0, 1e-4, 1});
  const NumberCheck all[] = {{"m1/active.torque.rms", "m1/active torque RMS", "N m", 0.5, 0.55, 0.1, 0.01},
                             {"distance", "distance", "m", 0.5, 0.51, 0.02, 0.01}};
  for (std::size_t i = 0; i < numbers; ++i) d.numbers.push_back(all[i]);
  return d;
}

TEST(GoldenReport, ShowsTheTenWorstColumnsAndTheWay) {
  GoldenDifference d = difference_of(12, 2);
  EXPECT_EQ(golden::differences(d, Shown::brief),
            "  column             RMS off by  of its range    band  in bands  outside from   late by\n"
            "  m11/active torque  0.0026 N m        0.13 %  0.01 %        13        0.22 s  +0.013 s\n"
            "  m10/active torque  0.0024 N m        0.12 %  0.01 %        12         0.2 s         -\n"
            "  m9/active torque   0.0022 N m        0.11 %  0.01 %        11        0.18 s         -\n"
            "  m8/active torque    0.002 N m         0.1 %  0.01 %        10        0.16 s         -\n"
            "  m7/active torque   0.0018 N m        0.09 %  0.01 %         9        0.14 s         -\n"
            "  m6/active torque   0.0016 N m        0.08 %  0.01 %         8        0.12 s         -\n"
            "  m5/active torque   0.0014 N m        0.07 %  0.01 %         7         0.1 s         -\n"
            "  m4/active torque   0.0012 N m        0.06 %  0.01 %         6        0.08 s         -\n"
            "  m3/active torque    0.001 N m        0.05 %  0.01 %         5        0.06 s         -\n"
            "  m2/active torque   0.0008 N m        0.04 %  0.01 %         4        0.04 s         -\n"
            "  distance: 0.5 -> 0.51 m, 2 bands\n");
  EXPECT_EQ(golden::left_out(d), 3U);  // two columns and one number
  const std::string all = golden::differences(d, Shown::strayed);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1 + 12 + 1 + 2) << all;
  EXPECT_TRUE(all.find("  m0/active torque   0.0004 N m        0.02 %  0.01 %         2         never         -\n") !=
              std::string::npos)
      << all;
  d.numbers.pop_back();
  EXPECT_TRUE(golden::differences(d, Shown::brief).ends_with("\n  m1/active torque RMS: 0.5 -> 0.55 N m, 10 bands\n"));
}

TEST(GoldenReport, ShowsNumbersWhereNoColumnStrayed) {
  GoldenDifference d = difference_of(0, 2);
  EXPECT_EQ(golden::differences(d, Shown::brief),
            "  number                 golden       now  change  band  in bands\n"
            "  m1/active torque RMS  0.5 N m  0.55 N m    10 %   1 %        10\n"
            "  distance                0.5 m    0.51 m     2 %   1 %         2\n");
  EXPECT_EQ(golden::left_out(d), 0U);
  for (int i = 0; i < 7; ++i) d.findings.push_back("joint m" + std::to_string(i) + " is odd");
  EXPECT_TRUE(golden::differences(d, Shown::brief).starts_with("  joint m0 is odd\n")) << golden::differences(d, Shown::brief);
  EXPECT_NE(golden::differences(d, Shown::brief).find("  joint m4 is odd\n  ... and 2 more like these\n  number"),
            std::string::npos);
}

class GoldenFolder : public ::testing::Test {
 protected:
  void SetUp() override { write_golden(sample_golden(walk()), folder_.path()); }
  [[nodiscard]] std::string content(const std::string& name) const { return read_file(folder_.path() / name, kMostTrace); }
  void put(const std::string& name, const std::string& text) const {
    // Tests call this function thousands of times. It avoids fsync, and the flush of ext4 after truncating and rewriting a
    // file.
    std::filesystem::remove(folder_.path() / name);
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
  }
  void replace(const std::string& what, const std::string& by) const {
    std::string text = content("golden.json");
    text.replace(text.find(what), what.size(), by);
    put("golden.json", text);
  }
  // Message of the error on reading the golden, without the folder.
  [[nodiscard]] std::string complaint() const {
    std::string text = message_of([&] { (void)read_golden(folder_.path()); });
    const std::string path = folder_.path().string();
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path)) text.replace(at, path.size(), "G");
    return text;
  }

  Folder folder_;
};

TEST_F(GoldenFolder, MissingFiles) {
  EXPECT_EQ(complaint(), kNoError);
  fs::remove(folder_.path() / "trace.golden");
  EXPECT_EQ(complaint(), "G/trace.golden: error: is missing: the golden is incomplete");
  fs::remove(folder_.path() / "golden.json");
  EXPECT_EQ(complaint(), "G/golden.json: error: is missing: the golden is incomplete");
  EXPECT_EQ(message_of([&] { (void)read_golden("no/where.golden"); }),
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
  EXPECT_EQ(complaint(),
            "G/golden.json: error: has golden format 2; this gaitlab reads 1: use the version of gaitlab that wrote it");
  put("golden.json", text);
  replace("\"halving\":0.0003", "\"halving\":0.0009");
  EXPECT_EQ(complaint(),
            "G/golden.json: error: is corrupt or was changed by hand: its checksum does not match; only gaitlab approve "
            "changes goldens");
  put("golden.json", text);
  replace("\"rows\"", "\"rows");
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: it is not JSON");
}

TEST_F(GoldenFolder, NoDamageOfTheJsonIsTakenNorACrash) {
  const std::string text = content("golden.json");
  for (std::size_t at = 0; at < text.size(); at += 3) {
    put("golden.json", text.substr(0, at));
    EXPECT_NE(complaint(), kNoError) << at;
  }
  std::mt19937_64 random(3);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = text;
    const std::size_t at = random() % text.size();
    damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1 + random() % 255));
    put("golden.json", damaged);
    EXPECT_NE(complaint(), kNoError) << at;
  }
}

TEST_F(GoldenFolder, ChecksumsThatAreRightOnOtherContent) {
  std::string text = content("golden.json");
  const std::size_t end = text.rfind(",\n  \"checksum\"");
  const std::string content = text.substr(0, end);
  const auto put_checked = [&](const std::string& changed) {
    put("golden.json", changed + ",\n  \"checksum\": \"" + hash(changed) + "\"\n}\n");
  };
  text.replace(text.rfind("\"unit\":\"m\""), 10, "\"unit\":[1]");  // unit of a number
  put_checked(text.substr(0, end));
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: an entry is missing or of another type");
  put_checked(content + ",\n  \"verdict\": [1]");
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: an entry is missing or of another type");
  put_checked(content + ",\n  \"verdict\": \"fesible\"");
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: its verdict is 'fesible'");
  put_checked(content + ",\n  \"resolved\": [1]");
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: an entry is missing or of another type");
  put_checked(content + ",\n  \"resolved\": [\"Kp: 100\"]");
  EXPECT_EQ(complaint(), "G/golden.json: error: is corrupt: its resolved scenario differs from the approved one");
}

TEST_F(GoldenFolder, TheTwoFilesBelongTogether) {
  const std::string old_trace = content("trace.golden");
  const std::string old_json = content("golden.json");
  write_golden(sample_golden(walk(101, 1.7)), folder_.path());
  const std::string trace = content("trace.golden");
  put("trace.golden", old_trace);
  EXPECT_EQ(complaint(), "G/trace.golden: error: belongs to another approval than golden.json");
  put("trace.golden", old_trace.substr(0, 100));
  EXPECT_EQ(complaint().substr(0, 46),
            "G/trace.golden: error: is truncated: 100 of " + std::to_string(old_trace.size()).substr(0, 2));
  // If the program is killed before it replaces golden.json, the old golden is valid; if it is killed afterwards, the new
  // golden.
  put("trace.golden", old_trace);
  put("trace.golden.next", trace);
  EXPECT_NEAR(read_golden(folder_.path()).run.precision[1], 3.4 / 65534, 1e-6);
  put("golden.json", old_json);
  EXPECT_NEAR(read_golden(folder_.path()).run.precision[1], 2.6 / 65534, 1e-6);
}

// The next write completes a write that was killed. The program is killed twice: after it replaced golden.json, and before it
// writes golden.json again.
TEST_F(GoldenFolder, TheNextWriteFinishesWhatAKillLeft) {
  const std::string old_trace = content("trace.golden");
  write_golden(sample_golden(walk(101, 1.7)), folder_.path());
  put("trace.golden.next", content("trace.golden"));
  put("trace.golden", old_trace);
  fs::rename(folder_.path() / "golden.json", folder_.path() / "json");
  fs::create_symlink("json", folder_.path() / "golden.json");  // can be read but not written, so that the next write fails
  EXPECT_THROW(write_golden(sample_golden(walk(101, 1.9)), folder_.path()), RunError);
  EXPECT_NEAR(read_golden(folder_.path()).run.precision[1], 3.4 / 65534, 1e-6);
  EXPECT_FALSE(fs::exists(folder_.path() / "trace.golden.next"));
}

TEST_F(GoldenFolder, IsWrittenByOneAtATime) {
  const int other = ::open(folder_.path().c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  EXPECT_EQ(message_of([&] { write_golden(sample_golden(walk()), folder_.path()); }),
            folder_.path().string() + ": error: is being written by another process; try again later");
  ::close(other);
  EXPECT_EQ(message_of([&] { write_golden(sample_golden(walk()), folder_.path()); }), kNoError);
}

TEST_F(GoldenFolder, KeepsConstantColumnsAndTheSelection) {
  Golden written = sample_golden(walk());
  written.bands[4] = {0, 1e-7, 1e-5, 0.25};
  written.selected = {"joint.*.torque", "base.z"};
  write_golden(written, folder_.path());
  const Golden read = read_golden(folder_.path());
  EXPECT_EQ(read.bands[4].constant, 0.25);
  EXPECT_EQ(read.bands[4].width(), 1e-5);
  EXPECT_EQ(read.bands[1].constant, 0);
  EXPECT_EQ(read.selected, written.selected);
}

}  // namespace
}  // namespace gaitlab::test
