// Run folders that are read again: files that are missing, changed or damaged.
#include "core/files/atomic_file.h"
#include "tests/folders.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

class RunFolders : public testing::Test {
 protected:
  RunFolders() {
    const Result ran = gaitlab(
        fmt::format("run '{}hexapod.yaml' --set duration=0.05 --format csv --out run --quiet", kScenarios), folder_.path());
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  void report(int code, const std::string& err) const {
    const Result result = gaitlab("report run", folder_.path());
    EXPECT_EQ(result.code, code);
    EXPECT_EQ(result.err.substr(0, err.size()), err);
  }
  const Folder folder_;
};

/// The recording contains its scenario, so that a changed scenario file in the run folder has no effect.
TEST_F(RunFolders, NeedNoScenarioFile) {
  const std::string before = gaitlab("report run", folder_.path()).out;
  ASSERT_NE(before.find("simulated"), std::string::npos) << before;
  std::filesystem::copy_file(kScenarios + "pendulum.yaml", folder_ / "run/scenario.resolved.yaml",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(gaitlab("report run", folder_.path()).out, before);
  std::filesystem::remove(folder_ / "run/scenario.resolved.yaml");
  EXPECT_EQ(gaitlab("report run", folder_.path()).out, before);
}

TEST_F(RunFolders, WithAnotherTraceAreRefused) {
  const std::string csv = read(folder_ / "run/trace.csv");
  const std::string refused = "run/trace.csv: error: is not the file that recording.h5 belongs to, or was changed\n";
  folder_.write("run/trace.csv", csv.substr(0, csv.find('\n', csv.find('\n') + 1) + 1));  // one row
  report(2, refused);
  std::string renamed = csv;
  folder_.write("run/trace.csv", renamed.replace(renamed.find("base.x,"), 7, "base.u,"));
  report(2, refused);
  folder_.write("run/trace.csv", csv);
  report(0, "");
  std::filesystem::remove(folder_ / "run/recording.h5");
  report(0, "run: note: run/trace.csv contains only rows");
}

TEST_F(RunFolders, WithADamagedSummaryAreRead) {
  folder_.write("run/summary.json", "garbage");
  report(0, "");
  folder_.write("run/summary.json", R"({"wall_time": -1e300})");
  const Result result = gaitlab("report run", folder_.path());
  EXPECT_NE(result.out.find("simulated in 0.00 s"), std::string::npos) << result.out;
  EXPECT_EQ(gaitlab("report nothing", folder_.path()).err, "nothing: error: there is no such run folder or trace file\n");
}

}  // namespace
}  // namespace gaitlab::test
