// Tests of `gaitlab rerun`: a run is repeated from its run folder alone, --verify reports differences, damaged folders are
// refused.
#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const Label kLongRerun("Rerun.DamagedTracesAreRefusedByEveryCommand", "long");

namespace fs = std::filesystem;

class Rerun : public ::testing::Test {
 protected:
  void SetUp() override {
    folder.write("s.yaml",
                 "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncpg: {type: sine, frequency: 0.5}\n"
                 "duration: 0.1\n");
    fs::create_directory_symlink(kScenarios + "modules", folder / "modules");
    ASSERT_EQ(gaitlab("run s.yaml --quiet --out a", folder / "").code, 0);
    fs::remove(folder / "s.yaml");  // the run folder must suffice
    fs::remove(folder / "modules");
  }
  [[nodiscard]] Result verify(const std::string& run) const { return gaitlab("rerun --verify " + run, folder / ""); }
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = read(folder / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << file;
    folder.write(file, text.replace(at, from.size(), to));
  }
  Folder folder;
};

TEST_F(Rerun, WritesTheSameBytes) {
  ASSERT_EQ(gaitlab("rerun a --quiet --out b", folder / "").code, 0);
  fs::remove(folder / "b/scenario.resolved.yaml");  // the scenario within the trace must suffice
  ASSERT_EQ(gaitlab("rerun b --quiet --out c", folder / "").code, 0);
  for (const char* run : {"b", "c"})
    EXPECT_EQ(read(folder / "a/trace.h5"), read(folder / (std::string(run) + "/trace.h5"))) << run;
  EXPECT_EQ(read(folder / "a/scenario.resolved.yaml"), read(folder / "c/scenario.resolved.yaml"));
  EXPECT_EQ(gaitlab("rerun a --quiet --out b", folder / "").err, "--out b: error: exists and is not empty\n");
}

TEST_F(Rerun, VerifiesToTheBitAndWritesNothing) {
  for (const char* run : {"a", "a/trace.h5"}) {
    const Result result = verify(run);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(contains(result.out, ": bit-equal: 21 rows of ")) << result.out;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  }
  EXPECT_FALSE(fs::exists(folder / "runs"));
}

TEST_F(Rerun, ACsvRunStaysOne) {
  fs::copy(folder / "a", folder / "csv");
  ASSERT_EQ(gaitlab("export a --to csv csv/trace.csv", folder / "").code, 0);
  fs::remove(folder / "csv/trace.h5");
  EXPECT_EQ(verify("csv").code, 0);
  ASSERT_EQ(gaitlab("rerun csv --quiet --out again", folder / "").code, 0);
  EXPECT_EQ(read(folder / "csv/trace.csv"), read(folder / "again/trace.csv"));
  fs::remove(folder / "csv/scenario.resolved.yaml");
  const Result result = verify("csv");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(
      result.err,
      "csv/trace.csv: error: a CSV trace does not contain its scenario, and there is no file csv/scenario.resolved.yaml\n");
}

TEST_F(Rerun, NamesWhatDiffers) {
  replace("a/scenario.resolved.yaml", "frequency: 0.5", "frequency: 0.6");
  const Result result = verify("a");
  EXPECT_EQ(result.code, 4) << result.err;
  EXPECT_TRUE(contains(result.out, "a: differs (A: the recorded run, B: the repeated run)\n")) << result.out;
  EXPECT_TRUE(contains(result.out, "\n    m0/active ")) << result.out;
  EXPECT_TRUE(contains(result.out, "differs from the scenario in trace.h5:\n    cpg.frequency: 0.5 -> 0.6\n")) << result.out;
}

TEST_F(Rerun, AnotherBuildIsNamedAndCounts0WhereTheBitsAreTheSame) {
  ASSERT_EQ(gaitlab("export a --to csv a/trace.csv", folder / "").code, 0);
  fs::remove(folder / "a/trace.h5");
  const std::string summary = read(folder / "a/summary.json");
  const std::size_t at = summary.find("\"build\": \"") + 10;
  replace("a/summary.json", summary.substr(at, summary.find('"', at) - at), "0.0.9+old (cc 1)");
  const Result result = verify("a");
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(contains(result.out, "\n  build: then 0.0.9+old (cc 1), now 0.")) << result.out;
}

TEST_F(Rerun, ToleratesTheLastBits) {
  ASSERT_EQ(gaitlab("export a --to csv a/trace.csv", folder / "").code, 0);
  fs::remove(folder / "a/trace.h5");
  std::string text = read(folder / "a/trace.csv");
  const std::size_t dot = text.rfind("e-");  // end of the digits of a small number
  ASSERT_NE(dot, std::string::npos);
  text[dot - 1] = text[dot - 1] == '1' ? '2' : '1';
  folder.write("a/trace.csv", text);
  const Result result = verify("a");
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(contains(result.out, "a: within 1e-09 of range, not bit-equal")) << result.out;
  EXPECT_TRUE(contains(result.out, "is not the trace from which summary.json was computed; the repeated run gives that trace"))
      << result.out;
}

TEST_F(Rerun, ARunThatEndedEarlyIsComparedUpToItsLastRow) {
  replace("a/summary.json", "\"outcome\": \"done\"", "\"outcome\": \"interrupted at t = 0.1 s\"");
  replace("a/scenario.resolved.yaml", "duration: 0.1", "duration: 0.2");
  const Result result = verify("a");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, ": bit-equal: 21 rows of ")) << result.out;
  EXPECT_TRUE(
      contains(result.out, "the recorded run ended early (interrupted at t = 0.1 s): compared up to its last row, t = 0.1 s"))
      << result.out;
  replace("a/summary.json", "interrupted at t = 0.1 s", "done");
  EXPECT_EQ(verify("a").code, 4);  // a truncated trace does not count as an early end
  fs::remove(folder / "a/summary.json");
  EXPECT_EQ(verify("a").code, 4);  // an unexplained short trace does not count as an early end
}

TEST_F(Rerun, ADivergedRunIsVerified) {
  fs::create_directory_symlink(kScenarios + "modules", folder / "modules");
  folder.write("wild.yaml",
               "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.1\nactuator: {type: torque}\n"
               "controller: {type: hold, period: 0.05, command: {default: 0, m1/passive: 1e6}}\ntrace: {period: 2.5e-5}\n");
  ASSERT_EQ(gaitlab("run wild.yaml --quiet --out w", folder / "").code, 1);
  const Result result = verify("w");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "the recorded run ended early (diverged at step 1")) << result.out;
}

TEST_F(Rerun, AnotherPluginFileIsRefusedButComparedByVerify) {
  const std::string library = folder / "wave.so";
  fs::copy(std::string(gaitlab::test::build_folder()) + "/plugins/wave.so", library);
  fs::create_directory_symlink(kScenarios + "modules", folder / "modules");
  folder.write("p.yaml", "gaitlab: 1\nplugins: [" + library + "]\nrobot: {modules: mtran}\nduration: 0.1\ncpg: {type: wave}\n");
  ASSERT_EQ(gaitlab("run p.yaml --quiet --out p", folder / "").code, 0);
  std::ofstream(library, std::ios::binary | std::ios::app) << "one byte more";
  const Result again = gaitlab("rerun p --quiet --out again --plugin wave.so", folder / "");
  EXPECT_EQ(again.code, 2);
  EXPECT_TRUE(contains(again.err, "is not the recorded file: its hash is ")) << again.err;
  const Result result = verify("p --plugin '" + library + "'");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "plugin wave.so: the file has changed: hash then ")) << result.out;
}

/// Every command refuses a damaged trace with exit code 2 and a message with the file, and does not crash (also under
/// sanitizers).
TEST_F(Rerun, DamagedTracesAreRefusedByEveryCommand) {
  const std::string whole = read(folder / "a/trace.h5");
  std::vector<std::string> damaged = {"", "\x89HDF\r\n\x1a\n", "t,x\n0,1\n", whole + "x", std::string(600, '\0')};
  for (std::size_t size = 1; size < whole.size(); size += 1 + whole.size() / 7) damaged.push_back(whole.substr(0, size));
  for (std::size_t at = 3; at < whole.size(); at += 1 + whole.size() / 7) {
    damaged.push_back(whole);
    damaged.back()[at] = static_cast<char>(damaged.back()[at] ^ 0x40);
  }
  fs::copy(folder / "a", folder / "bad");
  for (const std::string& bytes : damaged) {
    folder.write("bad/trace.h5", bytes);
    for (const char* command :
         {"rerun --verify bad", "compare a bad", "compare bad/trace.h5 a/trace.h5", "export bad --to csv x.csv"}) {
      const Result result = gaitlab(command, folder / "");
      EXPECT_EQ(result.code, 2) << command << ": " << result.err;
      EXPECT_TRUE(result.err.starts_with("bad/trace.h5: error: ")) << command << ": " << result.err;
    }
    EXPECT_FALSE(fs::exists(folder / "x.csv"));
  }
}

TEST_F(Rerun, DamagedTextsAreRefused) {
  const auto refused = [&](const std::string& file, const std::string& bytes, const std::string& run) {
    const std::string whole = read(folder / file);
    folder.write(file, bytes);
    const Result result = verify(run);
    EXPECT_EQ(result.code, 2) << file << ": " << result.err;
    EXPECT_TRUE(result.err.starts_with(file)) << file << ": " << result.err;
    folder.write(file, whole);
  };
  const std::string summary = read(folder / "a/summary.json");
  const std::string yaml = read(folder / "a/scenario.resolved.yaml");
  for (const std::string& text : {std::string(), summary.substr(0, summary.size() / 2), std::string("[1, 2]")})
    refused("a/summary.json", text, "a");
  for (const std::string& text : {std::string(), yaml.substr(0, yaml.size() / 2), std::string(1000, '{'), std::string(9, '\0')})
    refused("a/scenario.resolved.yaml", text, "a");
  ASSERT_EQ(gaitlab("export a --to csv a/trace.csv", folder / "").code, 0);
  fs::remove(folder / "a/trace.h5");
  const std::string csv = read(folder / "a/trace.csv");
  for (const std::string& text :
       {std::string(), csv.substr(0, csv.size() / 2), csv.substr(0, csv.find('\n') + 1), std::string("x\n1\n")})
    refused("a/trace.csv", text, "a");
}

TEST_F(Rerun, NoRunAtAll) {
  EXPECT_EQ(verify("nowhere").code, 2);
  EXPECT_EQ(verify("nowhere").err, "nowhere: error: there is no such run folder or trace file\n");
  EXPECT_EQ(verify("a/summary.json").err,
            "a/summary.json: error: is neither a run folder nor a trace file (.h5, .csv); it is a file of results in JSON; the "
            "scenario of a run is scenario.resolved.yaml in its folder\n");
  EXPECT_EQ(gaitlab("rerun a --verify --out b", folder / "").code, 2);
}

}  // namespace
}  // namespace gaitlab::test
