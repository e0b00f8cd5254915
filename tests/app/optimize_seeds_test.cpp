// Tests of `gaitlab optimize --seeds`.
#include "app/study/optimize_seeds.h"

#include "app/shell/stop_on_signal.h"
#include "tests/app/study_fixture.h"

namespace gaitlab::test {
namespace {

class OptimizeSeeds : public StudyFixture {
 protected:
  /// Every run of 0.3 s is too short to be verified.
  OptimizeSeeds() {
    folder_.write("s.yaml",
                  "gaitlab_study: 1\nscenario: two.yaml\nguards: none\nparameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\n"
                  "objective: {minimize: torque.peak}\nbudget: {runs: 20}\nverify: {best: 1}\n");
  }
};

/// The searches equal those of --seed and have a line each. A search that has ended is not repeated.
TEST_F(OptimizeSeeds, AreSearchesWithASummary) {
  const Result result = call("optimize s.yaml --seeds 2 --seed 7 --out o");
  EXPECT_EQ(result.code, 3) << result.err;
  EXPECT_TRUE(contains(result.out,
                       "\nfor each seed, the best kept point and the best verified point, by torque.peak, N m:\n"
                       "  seed  runs  kept"))
      << result.out;
  EXPECT_TRUE(contains(result.out, "\n0 of 2 seeds verified a point; best of 2 seeds: median ")) << result.out;
  ASSERT_EQ(call("optimize s.yaml --seed 8 --out single --quiet").code, 3);
  EXPECT_EQ(read(folder_ / "o/seed-8/table.csv"), read(folder_ / "single/table.csv"));
  EXPECT_NE(read(folder_ / "o/seed-7/table.csv"), read(folder_ / "single/table.csv"));
  std::filesystem::remove_all(folder_ / "o/seed-8");  // as if the second search had not begun
  const Result again = call("optimize s.yaml --seeds 2 --seed 7 --out o");
  EXPECT_EQ(again.out, result.out);
  EXPECT_EQ(read(folder_ / "o/seed-8/table.csv"), read(folder_ / "single/table.csv"));
  EXPECT_EQ(call("study show o/seed-7").code, 0);
}

TEST_F(OptimizeSeeds, RefuseAFolderWithOtherFiles) {
  std::filesystem::create_directory(folder_ / "o");
  folder_.write("o/notes", "mine");
  refused("optimize s.yaml --seeds 2 --out o",
          "--out o: error: contains notes; expected a new folder, or one of `--seeds`, which contains only folders seed-N");
  refused("optimize s.yaml --seeds 1 --out p", "gaitlab optimize: error: --seeds is '1'; expected a whole number from 2 to 99");
  EXPECT_EQ(call("optimize s.yaml --seeds 2 --dry-run").out.rfind("2 searches, with seeds 1 to 2; each:\n20 runs: ", 0), 0U);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs"));
}

/// Without --out, each choice of settings has its folder.
TEST_F(OptimizeSeeds, HaveAFolderByTheStudy) {
  for (const char* command : {"optimize s.yaml --seeds 2 --quiet", "optimize s.yaml --seeds 2 --quiet --set duration=0.2"}) {
    EXPECT_EQ(call(command).code, 3);
    EXPECT_EQ(call(command).code, 3);
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "runs/optimize-s-seeds/seed-2/study.db"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "runs/optimize-s-seeds-2/seed-2/study.db"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs/optimize-s-seeds-3"));
}

/// One verified search of several is a success. A stop ends the loop.
TEST_F(OptimizeSeeds, CodeIsThatOfTheBestSearch) {
  std::vector<std::int64_t> seeds;
  app::SeedSearches searches{3, 3, folder_.path(), "gaitlab optimize ...", true, {}};
  searches.search = [&](std::int64_t seed, const std::filesystem::path& folder) {
    EXPECT_EQ(folder.filename(), "seed-" + std::to_string(seed));
    seeds.push_back(seed);
    return seed == 4 ? 0 : 3;
  };
  EXPECT_EQ(app::search_seeds(searches), 0);
  EXPECT_EQ(seeds, (std::vector<std::int64_t>{3, 4, 5}));
  searches.search = [](std::int64_t, const std::filesystem::path&) { return 3; };
  EXPECT_EQ(app::search_seeds(searches), 3);
  seeds.clear();
  searches.search = [&](std::int64_t seed, const std::filesystem::path&) {
    seeds.push_back(seed);
    app::stopped() = true;
    return 1;
  };
  EXPECT_EQ(app::search_seeds(searches), 1);
  app::stopped() = false;
  EXPECT_EQ(seeds, std::vector<std::int64_t>{3});
}

}  // namespace
}  // namespace gaitlab::test
