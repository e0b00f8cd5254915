// Tests of options of `gaitlab optimize` that change the study: --set.
#include "tests/app/study_fixture.h"

namespace gaitlab::test {
namespace {

class OptimizeOptions : public StudyFixture {
 protected:
  OptimizeOptions() {
    folder_.write("s.yaml",
                  "gaitlab_study: 1\nscenario: two.yaml\nset: [duration=0.2]\nguards: none\nparameters:\n"
                  "  cpg.amplitude: {low: 0.05, high: 0.2}\n  legs: {low: 0, high: 1, sets: {cpg.offset: 0.1*legs}}\n"
                  "objective: {minimize: torque.peak}\nbudget: {runs: 20}\nverify: {best: 1}\n");
  }
};

/// A setting follows those of the file. It is part of the command that continues the study, and of the study in the folder.
TEST_F(OptimizeOptions, SetsKeysOfTheScenario) {
  ASSERT_EQ(call("optimize s.yaml --set duration=0.3 --set physics.accuracy=0.02 --out o --quiet").code, 3);
  for (auto& row : table("o")) EXPECT_EQ(row["simulated"], "0.3");
  const Result other = call("optimize s.yaml --set duration=0.3 --out o --quiet");
  EXPECT_EQ(other.code, 2);
  EXPECT_EQ(other.err,
            "o/study.db: error: belongs to another study; choose another folder (--out), or continue it as it was begun: "
            "gaitlab optimize s.yaml --set duration=0.3 --set physics.accuracy=0.02 --out o\n"
            "  scenario, line 108: \"  accuracy: 0.01\", was \"  accuracy: 0.02\"\n");
  EXPECT_EQ(call("optimize s.yaml --set duration=0.3 --set physics.accuracy=0.02 --out o --quiet").code, 3);
}

TEST_F(OptimizeOptions, RefusesSettingsOfParametersWithTheirPlace) {
  refused("optimize s.yaml --set cpg.amplitude=1 --set cpg.offset=0 --out o",
          "--set cpg.amplitude=1: error: cpg.amplitude is a parameter of the study, which sets it in every run; expected "
          "another key, or a study without this parameter\n"
          "--set cpg.offset=0: error: cpg.offset is computed from the parameter legs of the study, which sets it in every run; "
          "expected another key, or a study without this parameter");
  refused("optimize s.yaml --set duraton=1 --out o", "--set duraton=1: error: unknown key 'duraton'; did you mean 'duration'?");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "o"));
}

}  // namespace
}  // namespace gaitlab::test
