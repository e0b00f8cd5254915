// Tests of parameters that only the study defines, and of the keys of the scenario that follow them.
#include "studies/study/followers.h"

#include "studies/journal/journal.h"
#include "tests/app/study_fixture.h"

namespace gaitlab::test {
namespace {

class FollowersOfNumbers : public StudyFixture {
 protected:
  std::string study(const std::string& parameters, const std::string& more = "", const std::string& file = "s.yaml") {
    return folder_.write(file, "gaitlab_study: 1\nscenario: two.yaml\nguards: none\nparameters: {" + parameters + "}\n" + more);
  }
  std::string error(const std::string& parameters, const std::string& more = "method: {type: random}\nbudget: {runs: 2}\n") {
    study(parameters, more);
    const Result result = call("sweep s.yaml --out s");
    EXPECT_EQ(result.code, 2) << result.out;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "s"));
    return result.err;
  }
};

TEST_F(FollowersOfNumbers, AreSetAndTheNumberIsTheColumn) {
  study(
      "legs: {low: 0, high: 1, count: 3, sets: {cpg.offset: 0.3*legs - 0.1, cpg.phase_lag: 1 + legs*cpg.frequency}}, "
      "cpg.frequency: {values: [1, 2]}",
      "replicates: {count: 2, vary: {cpg.offset: {times: {uniform: [0.9, 1.1]}}}}\n");
  ASSERT_EQ(call("sweep s.yaml --out s --quiet").code, 0);
  const auto rows = table("s");
  ASSERT_EQ(rows.size(), 12U);
  const auto& row = rows[7];  // row of legs 0.5, frequency 2, replicate 1
  EXPECT_EQ(row.at("legs"), "0.5");
  EXPECT_EQ(row.at("cpg.frequency"), "2");
  EXPECT_EQ(row.count("cpg.phase_lag"), 0U);
  const double offset = std::stod(row.at("cpg.offset"));
  EXPECT_GE(offset, 0.9 * 0.05 - 1e-12);
  EXPECT_LE(offset, 1.1 * 0.05 + 1e-12);
  ASSERT_EQ(call("run two.yaml --no-report --set cpg.phase_lag=2 --set cpg.frequency=2 --set cpg.offset=" +
                 row.at("cpg.offset") + " --seed " + row.at("seed") + " --out r")
                .code,
            0);
  EXPECT_TRUE(contains(read(folder_ / "r/summary.json"), "\"speed\": " + row.at("speed") + ",")) << row.at("speed");
  const Result again = call("study rerun s 7");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(contains(again.out, "the quantities are equal to those in the journal")) << again.out;
  EXPECT_TRUE(contains(call("sweep s.yaml --dry-run").out, "first  cpg.offset=-0.1 cpg.phase_lag=1 cpg.frequency=1 "));
}

TEST_F(FollowersOfNumbers, AnotherExpressionIsAnotherStudy) {
  study("legs: {low: 0, high: 1, count: 3, sets: {cpg.offset: 0.3*legs}}");
  ASSERT_EQ(call("sweep s.yaml --out s --quiet").code, 0);
  study("legs: {low: 0, high: 1, count: 3, sets: {cpg.offset: 0.2*legs}}", "", "t.yaml");
  const Result other = call("sweep t.yaml --out s");
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "\"legs sets cpg.offset: 0.2*legs\", was \"legs sets cpg.offset: 0.3*legs\"")) << other.err;
  const Result answered = call("sweep t.yaml --out t --answers s");
  EXPECT_TRUE(contains(answered.out, "1 of 3 runs were taken from other studies")) << answered.out;  // the run with legs = 0
}

TEST_F(FollowersOfNumbers, AreSearchedAndWeighed) {
  study("stride: {low: 0.05, high: 0.2, scale: log, sets: {cpg.amplitude: stride, cpg.offset: stride/2}}",
        "set: [duration=3]\nobjective: {minimize: torque.peak}\nverify: {best: 1, change: 0.5, worlds: false}\nbudget: {runs: "
        "24}\n");
  ASSERT_EQ(call("optimize s.yaml --out o --quiet").code, 0);
  EXPECT_EQ(studies::Journal(folder_ / "o/study.db").verifications().size(), 2U);
  study("stride: {low: 0.05, high: 0.2, sets: {cpg.amplitude: stride}}, cpg.frequency: {low: 0.5, high: 1}",
        "method: {type: morris, trajectories: 3}\n", "m.yaml");
  ASSERT_EQ(call("sweep m.yaml --out m --quiet").code, 0);
  EXPECT_TRUE(contains(read(folder_ / "m/sensitivity.csv"), "speed,stride,mu_star,"));
  folder_.write("q", "{\"id\": 1, \"parameters\": {\"stride\": 0.1}}\n");
  const Result asked = call("evaluate s.yaml --out e --quiet < q");
  EXPECT_TRUE(contains(asked.out, "\"outcome\":\"done\"")) << asked.out << asked.err;
}

TEST_F(FollowersOfNumbers, WrongOnesAreRefused) {
  EXPECT_EQ(error("legs: {low: 0, high: 1, sets: {cpg.offset: 0.3*leg}}"),
            "s.yaml:4:61: error: unknown parameter 'leg'; did you mean 'legs'?\n");
  EXPECT_EQ(error("legs: {low: 0, high: 1, sets: {cpg.offset: 0.3*}}"),
            "s.yaml:4:61: error: found the end of the text; expected a number, a name or '('\n");
  EXPECT_EQ(error("legs: {low: 0, high: 1, sets: {cpg.offset: legs*cpg.type}}, cpg.type: {values: [sine, hopf]}"),
            "s.yaml:4:62: error: 'cpg.type' is a word; expected a parameter that is a number\n");
  EXPECT_EQ(error("legs: {low: 0, high: 1, sets: {cpg.offsett: legs}}"),
            "s.yaml:4:45: error: unknown key 'offsett'; did you mean 'offset'?\n");
  EXPECT_EQ(error("duration: {low: 1, high: 2, sets: {cpg.offset: duration}}"),
            "s.yaml:4:14: error: duration is a key of the scenario; a parameter with `sets` needs another name\n");
  EXPECT_EQ(error("name: {low: 1, high: 2, sets: {cpg.offset: name}}").substr(0, 41),
            "s.yaml:4:14: error: name is a key of the ");
  EXPECT_EQ(error("cpg.legs: {low: 1, high: 2, sets: {cpg.offset: 1}}"),
            "s.yaml:4:14: error: 'cpg.legs' cannot be a parameter of the study with `sets`; expected a name of letters, digits "
            "and `_` that begins with a letter, as in hip0: {low: 0.1, high: 0.2, sets: {cpg.offset.hips: hip0}}\n");
  EXPECT_EQ(error("legs: {low: 0, high: 1, sets: {}}"),
            "s.yaml:4:44: error: legs.sets is empty; expected keys of the scenario with expressions: {cpg.offset: 0.3*legs}\n");
  EXPECT_EQ(error("legs: {values: [a, b], sets: {cpg.offset: 1}}"),
            "s.yaml:4:43: error: legs has words, which no expression can use; expected numbers beside sets\n");
  EXPECT_EQ(error("a: {low: 0, high: 1, sets: {cpg.offset: a}}, b: {low: 0, high: 1, sets: {cpg.offset: b}}"),
            "s.yaml:4:87: error: cpg.offset is computed from a and from b; expected only one of the two\n");
  EXPECT_EQ(error("a: {low: 0, high: 1, sets: {cpg.offset: a}}, cpg.offset: {low: 0, high: 1}"),
            "s.yaml:4:42: error: cpg.offset is computed from a and is also a parameter; expected only one of the two\n");
  EXPECT_EQ(error("a: {low: 0, high: 1, sets: {cpg.offset: a}}",
                  "method: {type: random}\nbudget: {runs: 2}\nreplicates: {count: 2, vary: {cpg.offset: {uniform: [0, 1]}}}\n"),
            "s.yaml:4:42: error: cpg.offset is computed from a and also drawn for every replicate; expected vary: {cpg.offset: "
            "{times: ...}}, or only one of the two\n");
  // Without keys that follow it, an unknown name counts as a misspelt key.
  EXPECT_EQ(error("legs: {low: 0, high: 1}").substr(0, 38), "s.yaml:4:14: error: unknown key 'legs'");
}

}  // namespace
}  // namespace gaitlab::test
