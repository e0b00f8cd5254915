// Tests of `gaitlab remedy` and `run --remedy`: answers that equal the current of a stronger motor, reserves, threads, run
// folders, and runs without a remedy.
#include <nlohmann/json.hpp>

#include "tests/app/study_fixture.h"
#include "tests/labels.h"

namespace gaitlab::test {
namespace {

// Searches of a remedy, of some fifty runs.
const Label kLongRemedies("RemedyCommand.NeededCurrent*:RemedyCommand.AFeasible*", "long;unsanitized");

using nlohmann::json;

/// Two modules that creep for four periods. A motor must not be at a limit at any time.
class RemedyCommand : public StudyFixture {
 protected:
  RemedyCommand() {
    folder_.write("creep.yaml", R"(gaitlab: 1
robot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}
physics: {engine: articulated, accuracy: 0.005}
contact: {on: all}
cpg: {type: phase_oscillator, frequency: 2, amplitude: 0.2, phase_lag: 1.2}
limits: {saturated_share: 0, saturated_periods: 0, tracking_error: 1}
duration: 2
)");
  }
  json read_json(const std::string& file) { return json::parse(read(folder_ / file)); }
  /// The answer for a setting in one direction.
  static json answer_by(const json& remedy, const std::string& setting, const std::string& direction) {
    for (const json& answer : remedy["answers"]) {
      if (answer["setting"] == setting && answer["direction"] == direction) return answer;
    }
    return {};
  }
  /// Largest current without a current limit in the judged window, A, from the demand of a run with a low limit.
  double needed_current() {
    const Result result = call("run creep.yaml --no-report --quiet --demand --set actuator.i_max=0.05 --out starved");
    EXPECT_EQ(result.code, 0) << result.err;
    double most = 0;
    const json verdict = read_json("starved/verdict.json");
    for (const json& joint : verdict["demand"]["joints"]) most = std::max(most, joint["current"].get<double>());
    return most;
  }
};

TEST_F(RemedyCommand, NeededCurrentIsThatOfAStrongerMotor) {
  const double needed = needed_current();
  const std::string weak = " --set actuator.i_max=" + std::to_string(0.6 * needed);
  const Result result = call("remedy creep.yaml --no-report --by i_max -j 2 --out weak" + weak);
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "remedy    feasible with ")) << result.out;
  const json remedy = read_json("weak/remedy.json");
  EXPECT_EQ(remedy["verdict"], "infeasible");
  const json answer = answer_by(remedy, "i_max", "up");
  ASSERT_TRUE(answer.value("confirmed", false)) << answer;
  // The lower bound has the 2 % of the bisection, because nine tenths of the change must not suffice.
  EXPECT_GE(answer["value"], 0.98 * needed);
  EXPECT_LE(answer["value"], 1.05 * needed);
  const auto code_with = [&](double i_max) {
    return call("run creep.yaml --no-report --quiet --fail-infeasible --set actuator.i_max=" + std::to_string(i_max)).code;
  };
  EXPECT_EQ(code_with(answer["value"]), 0);
  EXPECT_EQ(code_with(0.6 * needed + 0.9 * (answer["value"].get<double>() - 0.6 * needed)), 3);

  // Another number of threads and the folder of the run give the same answers.
  ASSERT_EQ(call("remedy creep.yaml --by i_max --no-report --quiet --out again" + weak).code, 0);
  EXPECT_EQ(read(folder_ / "again/remedy.json"), read(folder_ / "weak/remedy.json"));
  const Result of_run = call("remedy again --by i_max -j 2");
  ASSERT_EQ(of_run.code, 0) << of_run.err;
  EXPECT_EQ(read(folder_ / "again/remedy.json"), read(folder_ / "weak/remedy.json"));
  EXPECT_TRUE(contains(read(folder_ / "again/report.html"), "\"remedy\":{\"verdict\":\"infeasible\""));
  ASSERT_EQ(call("report again --out later").code, 0);  // reads remedy.json of the folder
  EXPECT_TRUE(contains(read(folder_ / "later/report.html"), "\"remedy\":{\"verdict\":\"infeasible\""));
}

TEST_F(RemedyCommand, AFeasibleGaitHasReserves) {
  const double needed = needed_current();
  const Result result = call("remedy creep.yaml --by i_max --by amplitude --no-report -j 2 --out strong");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "remedy    stays feasible with ")) << result.out;
  EXPECT_TRUE(contains(result.out, "i_max down to ")) << result.out;
  const json answer = answer_by(read_json("strong/remedy.json"), "i_max", "down");
  EXPECT_GE(answer["value"], needed * 0.99);
  EXPECT_LE(answer["value"], needed + 0.15 * (1.2 - needed));  // a tenth of the change, and the error of the torque
}

// If the ratings of joints differ, the answer is a factor on all of them.
TEST_F(RemedyCommand, RatingsThatDifferAreAFactor) {
  const Result result = call(
      "remedy creep.yaml --no-report --by friction --out rated --set actuator.i_continuous='{default: 0.1, m0/active: 0.01}'");
  ASSERT_EQ(result.code, 0) << result.err;
  const json rating = read_json("rated/remedy.json")["ratings"][0];
  EXPECT_EQ(rating["same"], false);
  const double times = rating["rating"].get<double>() / rating["now"].get<double>();
  EXPECT_TRUE(contains(result.out, "remedy    feasible with i_continuous of ")) << result.out;
  EXPECT_TRUE(contains(result.out, " times the ratings (")) << result.out;
  const auto code_with = [&](double factor) {
    return call("run creep.yaml --no-report --quiet --fail-infeasible --set actuator.i_continuous='{default: " +
                std::to_string(0.1 * factor) + ", m0/active: " + std::to_string(0.01 * factor) + "}'")
        .code;
  };
  EXPECT_EQ(code_with(times), 0);
  EXPECT_EQ(code_with(1 + 0.9 * (times - 1)), 3);
}

TEST_F(RemedyCommand, ARunThatIsNotJudgedHasNone) {
  const Result result = call("remedy creep.yaml --no-report --set duration=0.5 --out brief");
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(contains(result.err, "creep.yaml: error: a remedy needs a verdict, but this run is not judged: ")) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "brief/remedy.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "brief/verdict.json"));
}

/// A run that is `not judged` only because of its accuracy has the remedy of a finer run that is judged.
TEST_F(RemedyCommand, ARunThatIsTooCoarseHasThatOfAFinerRun) {
  ASSERT_EQ(call("run creep.yaml --no-retry --no-report --quiet --set physics.accuracy=0.5 --out coarse").code, 0);
  const json verdict = read_json("coarse/verdict.json");
  ASSERT_EQ(verdict["verdict"], "not judged") << verdict["reason"];
  const std::string finer = verdict["retry"][0];
  const Result result = call("remedy coarse --by i_max --no-report");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "remedy    with " + finer +
                                       " the run is accurate enough, and feasible; starting from these "
                                       "settings:"))
      << result.out;
  const json remedy = read_json("coarse/remedy.json");
  EXPECT_EQ(remedy["verdict"], "not judged") << "of the run";
  EXPECT_EQ(remedy["finer"]["verdict"], "feasible");
  const json down = answer_by(remedy, "i_max", "down");
  ASSERT_EQ(down["set"].size(), 2U);
  EXPECT_EQ(down["set"][0], finer);
  const std::string sets = " --set " + finer + " --set " + down["set"][1].get<std::string>();
  EXPECT_EQ(call("run creep.yaml --no-report --quiet --fail-infeasible" + sets).code, 0) << sets;
}

TEST_F(RemedyCommand, OptionsOfNewRunsAreRefusedForAFolder) {
  ASSERT_EQ(call("run creep.yaml --no-report --quiet --set duration=0.5 --out old").code, 0);
  for (const char* option : {"--out new", "--set duration=2", "--seed 2"}) {
    const Result result = call(std::string("remedy old ") + option);
    EXPECT_EQ(result.code, 2) << option;
    EXPECT_TRUE(contains(result.err, "is for a scenario, but old is a run; the remedy of a run is written into its folder"))
        << result.err;
  }
  EXPECT_EQ(call("remedy missing.yaml").code, 2);
  refused("remedy creep.yaml --by imax", "--by: error: setting 'imax' is unknown; did you mean 'i_max'?");
  // A file that is damaged or forged is not shown.
  const std::string deep = R"({"format": 1, "text": )" + std::string(200000, '[') + std::string(200000, ']') + "}";
  for (const std::string& text :
       {std::string(), std::string("{}"), std::string(R"({"format": "x"})"), std::string(R"({"format": 1})"), deep}) {
    folder_.write("old/remedy.json", text);
    const Result report = call("report old");
    EXPECT_EQ(report.code, 0) << text.substr(0, 40);
    EXPECT_TRUE(contains(report.err, "old/remedy.json: note: is damaged or belongs to another run or verdict; it is not shown"))
        << report.err;
  }
}

}  // namespace
}  // namespace gaitlab::test
