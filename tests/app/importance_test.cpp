// Tests of the importance of parameters and of the advice on their ranges, in the summary of a study.
#include "tests/app/study_fixture.h"

namespace gaitlab::test {
namespace {

class ImportanceText : public StudyFixture {
 protected:
  /// The tracking error grows with the amplitude and hardly depends on the phase lag.
  std::string swept(const std::string& lines, const std::string& out) {
    folder_.write(out + ".yaml",
                  "gaitlab_study: 1\nscenario: two.yaml\nguards: none\nparameters: {cpg.amplitude: {low: 0.05, high: 1}, "
                  "cpg.phase_lag: {low: 0.2, high: 3}}\nmethod: {type: random}\nestimate_every: 0\n" +
                      lines);
    const Result result = call("sweep " + out + ".yaml --out " + out);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(contains(call("study show " + out).out, importance_of(result.out))) << out;
    return result.out;
  }
  static std::string importance_of(const std::string& text) {
    const std::size_t from = text.find("share of the variance");
    return from == std::string::npos ? "" : text.substr(from, text.find("\nto repeat", from) - from);
  }
};

TEST_F(ImportanceText, NamesTheParameterThatDecides) {
  const std::string text = swept(
      "objective: {minimize: tracking_error.peak}\nconstraints: [tracking_error.peak <= 0.016]\nbudget: {runs: 300}\n", "s");
  const std::string expected =
      "share of the variance that a parameter alone explains, over 300 points (below 4 % is noise):\n"
      "  parameter      tracking_error.peak  kept             kept points lie within\n"
      "  cpg.amplitude                 97 %  89 %  0.052 to 0.23 (19 % of the range)\n";
  EXPECT_TRUE(contains(text, expected)) << importance_of(text);
  EXPECT_TRUE(contains(text, "cpg.amplitude: kept points lie within 0.052 to 0.23 (19 % of its range), and 0 of ")) << text;
  EXPECT_TRUE(contains(text, " points outside are kept: narrow the range\n")) << text;
  EXPECT_FALSE(contains(text, "cpg.phase_lag: kept points lie within")) << text;
}

TEST_F(ImportanceText, NamesTheEndAtWhichTheBestPointLies) {
  const std::string text = swept("objective: {maximize: tracking_error.peak}\nbudget: {runs: 100}\n", "s");
  EXPECT_TRUE(contains(text, "the best point is at the upper end of cpg.amplitude (1): widen the range there\n")) << text;
  EXPECT_FALSE(contains(text, "end of cpg.phase_lag")) << text;
  EXPECT_FALSE(contains(text, "narrow the range")) << text;
}

/// Twenty points are enough for the end of a range, sixty for shares of a variance.
TEST_F(ImportanceText, IsSilentOnFewPoints) {
  const std::string few = swept("objective: {maximize: tracking_error.peak}\nbudget: {runs: 19}\n", "few");
  EXPECT_FALSE(contains(few, "share of the variance")) << few;
  EXPECT_FALSE(contains(few, "the best point is at")) << few;
}

/// A search says that its points are not evenly distributed.
TEST_F(ImportanceText, OfASearchSaysThatItsPointsAreDenser) {
  swept("objective: {minimize: torque.peak}\nbudget: {runs: 64}\n", "s");
  EXPECT_EQ(call("optimize s.yaml --method cma --out o --quiet").code, 3);
  const std::string text = call("study show o").out;
  EXPECT_TRUE(contains(text, "is noise; the points are denser where the search found good ones):\n")) << text;
}

}  // namespace
}  // namespace gaitlab::test
