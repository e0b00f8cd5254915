// A search for a remedy that is stopped after some of its runs: the answers so far, their text and remedy.json.
#include <map>
#include <nlohmann/json.hpp>

#include "report/analysis/collisions.h"
#include "report/remedy/remedy_text.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using report::Remedy;
using report::RemedyAnswer;

const Label kLongInterruptions("InterruptedRemedy.*", "long");

/// Two modules whose motors have too little current.
class InterruptedRemedy : public ::testing::Test {
 protected:
  /// The search by i_max, stopped after this number of runs. Only one run is simulated at a time, so that the number is exact.
  Remedy after(std::size_t runs) {
    std::atomic<bool> stop = false;
    std::size_t ended = 0;
    const auto with = [&](const std::vector<std::string>& sets) { return scenario(kText, sets); };
    const auto count = [&](double share) {
      EXPECT_GE(share, 0);
      EXPECT_LE(share, 1);
      stop = ++ended >= runs;
    };
    return report::remedy({scenario_, verdict_, with, false, {"i_max"}, {1, 1}, count}, stop);
  }
  static const RemedyAnswer& larger(const Remedy& remedy) { return remedy.answers.back(); }
  static std::string text(const Remedy& remedy) {
    std::string all;
    for (const report::ScreenLine& line : report::remedy_lines(remedy)) all += line.text + "\n";
    return all;
  }

  const std::string kText = R"(gaitlab: 1
robot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}
physics: {engine: articulated, accuracy: 0.005}
contact: {on: all}
cpg: {type: phase_oscillator, frequency: 2, amplitude: 0.2, phase_lag: 1.2}
limits: {saturated_share: 0, saturated_periods: 0, tracking_error: 1}
actuator: {i_max: 0.2}
duration: 2
)";
  const Scenario scenario_ = scenario(kText);
  const Recording recording_ = run(scenario_);
  const report::Verdict verdict_ = report::verdict(scenario_, recording_, report::summarise(scenario_, recording_, 0),
                                                   report::overlaps(scenario_, recording_));
};

TEST_F(InterruptedRemedy, HasTheAnswersOfTheRunsThatHaveEnded) {
  ASSERT_EQ(verdict_.word, Word::infeasible) << verdict_.reason.text;
  const Remedy whole = after(1000);
  ASSERT_FALSE(whole.interrupted);
  ASSERT_TRUE(larger(whole).confirmed) << text(whole);
  EXPECT_EQ(text(whole).find("interrupted"), std::string::npos) << text(whole);
  std::map<bool, std::size_t> crossed;
  for (const std::size_t runs : {std::size_t{1}, std::size_t{4}, std::size_t{12}, whole.runs - 1}) {
    const Remedy part = after(runs);
    EXPECT_TRUE(part.interrupted) << runs;
    EXPECT_EQ(part.runs, runs);
    const RemedyAnswer& answer = larger(part);
    EXPECT_EQ(answer.stopped, !answer.confirmed) << runs;
    if (answer.confirmed) {
      EXPECT_EQ(answer.factor, larger(whole).factor) << runs;
    } else if (answer.crosses) {
      EXPECT_GE(answer.factor, 0.9 * larger(whole).factor) << runs;  // the factor of an interrupted bracket is on the safe side
    }
    ++crossed[answer.crosses];
    const std::string lines = text(part);
    EXPECT_TRUE(contains(lines, "interrupted after " + std::to_string(runs) + " run")) << lines;
    const std::string found = answer.confirmed ? "feasible with i_max >= "
                              : answer.crosses ? "probably feasible with i_max "
                                               : "";
    EXPECT_TRUE(lines.starts_with(found)) << lines;
    EXPECT_EQ(contains(lines, "larger i_max"), !answer.crosses) << lines;
    EXPECT_FALSE(contains(lines, "makes it feasible alone")) << lines;
    const nlohmann::json json = nlohmann::json::parse(report::to_json(part));
    EXPECT_EQ(json["interrupted"], true);
    EXPECT_EQ(json["answers"].back().contains("interrupted"), answer.stopped);
    EXPECT_NE(report::shown_remedy(report::to_json(part), part.scenario, part.word), "");
  }
  EXPECT_GT(crossed[false], 0U);
  EXPECT_GT(crossed[true], 0U);
}

}  // namespace
}  // namespace gaitlab::test
