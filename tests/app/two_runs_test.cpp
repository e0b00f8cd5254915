// Tests of `gaitlab report RUN_A RUN_B`, which writes one page for two runs.
#include <nlohmann/json.hpp>

#include "core/files/atomic_file.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

/// JSON object `meta` in the text of a page.
nlohmann::json meta_of(const std::string& page) {
  const std::string mark = "<script type=\"application/json\" id=\"meta\">";
  const std::size_t from = page.find(mark) + mark.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

class TwoRuns : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    runs = std::make_unique<Folder>();
    const std::string walk = "run " + kScenarios + "hexapod.yaml --quiet --no-report --set physics.engine=articulated ";
    make(walk + "--set duration=2.5 --out a");
    make(walk + "--set duration=3 --set cpg.frequency=1.2 --set cpg.amplitude=0.6 --set trace.period=0.02 --out fast");
    make("run " + kScenarios + "pendulum.yaml --quiet --no-report --set duration=1 --out pendulum");
  }
  static void TearDownTestSuite() { runs.reset(); }
  static void make(const std::string& arguments) {
    const Result result = gaitlab(arguments, *runs / "");
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static Result call(const std::string& arguments) { return gaitlab(arguments, *runs / ""); }

  static inline std::unique_ptr<Folder> runs;
};

TEST_F(TwoRuns, StandOnOnePageBesideTheFirst) {
  const Result result = call("report a fast");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("A: hexapod: 2.5 s simulated")) << result.out;
  EXPECT_NE(result.out.find("\nB: hexapod: 3 s simulated"), std::string::npos) << result.out;
  EXPECT_TRUE(result.out.ends_with("a/compare.html\n")) << result.out;
  const std::string page = read(*runs / "a/compare.html");
  EXPECT_EQ(page.find(runs->path().string()), std::string::npos);
  const nlohmann::json meta = meta_of(page);
  const nlohmann::json& overlay = meta.at("overlay");
  EXPECT_EQ(overlay.at("labels"), nlohmann::json({"A", "B"}));
  EXPECT_EQ(overlay.at("run").at("period"), 0.02);
  EXPECT_EQ(overlay.at("run").at("verdict").at("verdict"), "not judged") << "its ramp leaves 2.4 periods";
  EXPECT_EQ(overlay.at("strayed"), nullptr);
  const auto differs = overlay.at("differs").get<std::vector<std::string>>();
  ASSERT_EQ(differs.size(), 4U);
  EXPECT_EQ(differs[0], "cpg.frequency: 0.5 -> 1.2");
  // The data of each run equal those on the page of this run alone.
  ASSERT_EQ(call("report fast --page fast.html").code, 0);
  EXPECT_EQ(overlay.at("run"), meta_of(read(*runs / "fast.html")));
  // Repeating the command replaces the page by the same bytes.
  EXPECT_EQ(call("report a fast").code, 0);
  EXPECT_EQ(read(*runs / "a/compare.html"), page);
}

TEST_F(TwoRuns, MayBeOneRunTwiceOrOtherRobots) {
  ASSERT_EQ(call("report a a --page same.html").code, 0);
  EXPECT_EQ(meta_of(read(*runs / "same.html")).at("overlay").at("differs"), nlohmann::json::array());
  const Result result = call("report a pendulum --page other.html");
  EXPECT_EQ(result.code, 0) << result.err;
  const std::string page = read(*runs / "other.html");
  EXPECT_NE(page.find("<title>hexapod, pendulum: gaitlab report</title>"), std::string::npos);
}

TEST_F(TwoRuns, AreInfeasibleWhereOneIs) {
  ASSERT_EQ(call("run '" + kScenarios +
                 "hexapod.yaml' --set physics.engine=articulated --set duration=6 --no-report --quiet --out whole")
                .code,
            0);
  EXPECT_EQ(call("report whole whole --page f1.html --fail-infeasible").code, 0);
  EXPECT_EQ(call("report whole fast --page f2.html --fail-infeasible").code, 3);
  EXPECT_EQ(call("report fast whole --page f3.html --fail-infeasible").code, 3);
  EXPECT_EQ(call("report whole a --page f4.html --fail-infeasible").code, 3) << "2.5 s are not judged";
}

TEST_F(TwoRuns, OverwriteNothingElse) {
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    const Result result = call(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.err, message);
    EXPECT_EQ(result.out, "");
  };
  refused("report a fast --page a/trace.h5", "a/trace.h5: error: exists; nothing was written\n");
  refused("report a fast --out both", "--out both: error: is only for one run; for two runs write a page: --page FILE\n");
  refused("report a fast --page no/such.html", "no/such.html: error: cannot be written: its folder does not exist\n");
  EXPECT_EQ(call("report a nowhere").code, 2);
  EXPECT_EQ(call("report a fast pendulum").code, 2);
}

}  // namespace
}  // namespace gaitlab::test
