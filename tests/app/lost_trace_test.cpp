// If the trace of a run cannot be written, all other results are written, and the rows if possible.
#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

// Runs until memory or a disk is full.
const Label kLostTraces("LostTrace.*", "long");

namespace fs = std::filesystem;

class LostTrace : public ::testing::Test {
 protected:
  LostTrace() {
    fs::create_directory_symlink(kScenarios + "modules", folder_ / "modules");
    folder_.write("s.yaml",
                  "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncpg: {type: sine, frequency: 0.5}\n"
                  "physics: {engine: articulated}\ntrace: {period: 2e-5, columns: ['*']}\nduration: 0.15\n");
  }
  Result run(const std::string& limits) {
    const std::string command = "cd '" + folder_.path().string() + "' && " + limits + "; '" +
                                std::string(gaitlab::test::build_folder()) +
                                "/bin/gaitlab' run s.yaml --quiet --no-report --out a 2>err >out";
    const int status = std::system(("bash -c \"" + command + "\"").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(folder_ / "out"), read(folder_ / "err")};
  }

  Folder folder_;
};

TEST_F(LostTrace, ToMemoryKeepsRowsAsTextAndEverythingElse) {
  if (run("ulimit -v 2000000").code != 0) {
    ASSERT_EQ(run("true").code, 0);
    GTEST_SKIP() << "a sanitizer, which reserves more than any limit";
  }
  const std::string hash = read(folder_ / "a/summary.json");
  bool seen = false;
  // The required memory depends on the libraries of the machine. The program must not crash at any limit. At limits slightly
  // below the requirement, down to 30 MB less, the rows are written only as text.
  int fails = 20;
  int works = 300;
  while (works - fails > 4 && !seen) {
    const int limit = (fails + works) / 2;
    fs::remove_all(folder_ / "a");
    const Result result = run(fmt::format("ulimit -v {}", limit * 1000));
    constexpr std::array kOrderly{0, 1, 2, 127};  // 2 means no memory for the rows, 127 none for the libraries
    ASSERT_NE(std::ranges::find(kOrderly, result.code), kOrderly.end()) << limit << ": " << result.code << result.err;
    (result.code == 0 ? works : fails) = limit;
    if (!fs::exists(folder_ / "a/trace.csv") || !fs::exists(folder_ / "a/summary.json")) continue;
    seen = true;
    EXPECT_EQ(result.code, 1);
    EXPECT_TRUE(contains(result.err, "a/trace.h5: cannot be written: ")) << result.err;
    EXPECT_TRUE(contains(result.err, "; the rows are in trace.csv beside it\n")) << result.err;
    EXPECT_FALSE(fs::exists(folder_ / "a/trace.h5"));
    EXPECT_TRUE(fs::exists(folder_ / "a/scenario.resolved.yaml"));
    const std::string summary = read(folder_ / "a/summary.json");
    EXPECT_EQ(summary.substr(summary.find("trace_hash")), hash.substr(hash.find("trace_hash")));
    EXPECT_EQ(gaitlab("rerun a --verify", folder_.path()).code, 0);
  }
  EXPECT_TRUE(seen);
}

TEST_F(LostTrace, ToADiskKeepsEverythingElse) {
  const Result result = run("ulimit -f 200");  // at most 200 kB per file, less than the trace
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(contains(result.err, "gaitlab: error: a/trace.h5: cannot be written: File too large\n")) << result.err;
  EXPECT_TRUE(fs::exists(folder_ / "a/scenario.resolved.yaml"));
  EXPECT_TRUE(contains(read(folder_ / "a/summary.json"), "\"outcome\": \"done\""));
  EXPECT_TRUE(fs::exists(folder_ / "a/verdict.json"));
}

}  // namespace
}  // namespace gaitlab::test
