// Tests of `gaitlab evaluate`: answers, and refused lines.
#include <nlohmann/json.hpp>

#include "studies/journal/journal.h"
#include "tests/app/study_fixture.h"
#include "tests/labels.h"

namespace gaitlab::test {
namespace {

const Label kLongEvaluate("Evaluate.RefusesLinesThatAreNoQuestionsAndLosesNothing", "long");

class Evaluate : public StudyFixture {
 protected:
  Evaluate() {
    folder_.write("study.yaml",
                  "gaitlab_study: 1\nscenario: two.yaml\nset: [physics.integrator=implicit]\nparameters:\n"
                  "  cpg.phase_lag: {low: 0.5, high: 1.5}\n  cpg.type: {values: [phase_oscillator, hopf]}\n"
                  "  physics.step: {values: [0.001, 0.0015]}\n  trace.period: {values: [0.015, 0.02]}\n");
  }
  Result ask(const std::string& lines, const std::string& options = "") {
    folder_.write("questions", lines);
    return call("evaluate study.yaml --out e --quiet " + options + " <questions");
  }
  static std::string question(const std::string& id, const std::string& lag, const std::string& step = "0.001",
                              const std::string& period = "0.015") {
    return R"({"id": )" + id + R"(, "parameters": {"cpg.phase_lag": )" + lag + R"(, "cpg.type": "hopf", "physics.step": )" +
           step + R"(, "trace.period": )" + period + "}}\n";
  }
  static std::vector<nlohmann::json> answers(const Result& result) {
    std::vector<nlohmann::json> all;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }
};

TEST_F(Evaluate, TakesAnswersOfOtherStudies) {
  ASSERT_EQ(ask(question("1", "0.7") + question("2", "0.9")).code, 0);
  std::filesystem::rename(folder_ / "e", folder_ / "old");
  // A value that no run would give marks the row of the other study.
  studies::Database(folder_.path() / "old/study.db", studies::Database::Mode::write)
      .execute("UPDATE run SET path_length = 77 WHERE run = 0");
  const auto all = answers(ask(question("3", "0.7") + question("4", "1.1"), "--answers old"));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].at("figures").at("path_length"), 77);
  EXPECT_NE(all[1].at("figures").at("path_length"), 77);
}

TEST_F(Evaluate, AnswersWithTheFiguresOfTheJournal) {
  const Result result = ask(question("7", "0.30000000000000004e0") + question("\"a\\u00e9\"", "0.7") + "\r\n" +
                            question("8", "1.2", "0.0015", "0.02") + question("9", "0.7"));
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto all = answers(result);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')),
            R"({"id":7,"run":null,"outcome":"refused","message":"cpg.phase_lag is 0.30000000000000004; expected 0.5 to 1.5",)"
            R"("figures":{},"margins":{},"objective":[null],"violation":null,"kept":false,"feasible":false})");
  EXPECT_EQ(all[1].at("id"), "a\u00e9");
  EXPECT_EQ(all[1].at("outcome"), "done");
  EXPECT_EQ(all[1].at("run"), 0);
  EXPECT_EQ(all[2].at("outcome"), "refused");
  EXPECT_EQ(all[2].at("run"), 1);
  EXPECT_TRUE(contains(all[2].at("message"), "not a whole multiple of the step")) << all[2];
  EXPECT_EQ(all[3].at("run"), 0);
  studies::Journal journal(folder_ / "e/study.db");
  EXPECT_EQ(journal.rows(), 2U);
  EXPECT_EQ(journal.head().runs, 2U);
  const auto figures = journal.quantities(0);
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const nlohmann::json& value = all[1].at("figures").at(journal.head().quantities[k].name);
    ASSERT_EQ(value.is_null(), figures[k].empty()) << journal.head().quantities[k].name;
    if (value.is_null()) continue;
    EXPECT_EQ(value.get<double>(), std::stod(figures[k])) << journal.head().quantities[k].name;
  }
  EXPECT_EQ(all[1].at("objective").at(0), all[1].at("figures").at("speed"));
  // The answer equals the results of a run with the same settings.
  ASSERT_EQ(call("run two.yaml --no-report --set physics.integrator=implicit --set cpg.phase_lag=0.7 --set cpg.type=hopf "
                 "--set physics.step=0.001 --out r")
                .code,
            0);
  EXPECT_EQ(all[1].at("figures").at("speed"), nlohmann::json::parse(read(folder_ / "r/summary.json")).at("speed"));
}

TEST_F(Evaluate, OfSeveralReplicatesEachFigureIsAList) {
  folder_.write("study.yaml",
                "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.phase_lag: {low: 0.5, high: 1.5}}\n"
                "replicates: {count: 3, vary: {ground.friction: {uniform: [0.4, 1]}}, combine: median}\n"
                "objective: [{maximize: speed}, {minimize: distance}]\nguards: none\n");
  const auto all = answers(ask(R"({"id": 1, "parameters": {"cpg.phase_lag": 1}})"));  // the line has no line end
  ASSERT_EQ(all.size(), 1U);
  auto speeds = all[0].at("figures").at("speed").get<std::vector<double>>();
  ASSERT_EQ(speeds.size(), 3U);
  std::ranges::sort(speeds);
  EXPECT_EQ(all[0].at("objective").size(), 2U);
  EXPECT_EQ(all[0].at("objective").at(0), speeds[1]);
  EXPECT_EQ(all[0].at("kept"), true);
}

/// `margins` contains only the guards: a check of the verdict with its own margin, a check from which the study requires a
/// reserve, and a check with another limit, but not the check that the study drops.
TEST_F(Evaluate, AnswersWithTheMarginsOfTheGuards) {
  const std::string head = "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.phase_lag: {low: 0.5, high: 1.5}}\n";
  const std::string asked = R"({"id": 1, "parameters": {"cpg.phase_lag": 1}})";
  folder_.write("study.yaml", head + "guards: {voltage: {margin: 0.25}, heat: false, stops: 0.5, slip: true}\n");
  const nlohmann::json one = answers(ask(asked)).at(0);
  const nlohmann::json& figures = one.at("figures");
  const nlohmann::json& margins = one.at("margins");
  EXPECT_EQ(margins.at("current"), figures.at("margin.current"));
  EXPECT_EQ(margins.at("voltage").get<double>(), figures.at("margin.voltage").get<double>() - 0.25);
  EXPECT_EQ(margins.at("stops"), figures.at("margin.stops[0.5]"));
  EXPECT_TRUE(margins.at("slip").is_null()) << "the run has no such check";
  EXPECT_FALSE(margins.contains("heat"));
  EXPECT_FALSE(margins.contains("periodic")) << "it can only warn";
  std::filesystem::remove_all(folder_ / "e");
  folder_.write("study.yaml", head + "replicates: {count: 2}\n");
  const nlohmann::json several = answers(ask(asked)).at(0);
  EXPECT_EQ(several.at("margins").at("voltage"), several.at("figures").at("margin.voltage"));
  EXPECT_EQ(several.at("margins").at("voltage").size(), 2U);
  std::filesystem::remove_all(folder_ / "e");
  folder_.write("study.yaml", head + "guards: none\n");
  EXPECT_TRUE(answers(ask(asked)).at(0).at("margins").empty());
}

/// --set has the effect of a line of `set` in the file, after the others.
TEST_F(Evaluate, SetsKeysOfTheScenario) {
  const auto of_file = answers(ask(question("1", "0.7"), "--set duration=0.6")).at(0);
  EXPECT_EQ(of_file.at("figures").at("duration"), 0.6);
  const Result other = ask(question("1", "0.7"));
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "continue it as it was begun: gaitlab evaluate study.yaml --set duration=0.6 --out e"))
      << other.err;
  EXPECT_EQ(ask(question("1", "0.7"), "--set cpg.phase_lag=1").err,
            "--set cpg.phase_lag=1: error: cpg.phase_lag is a parameter of the study, which sets it in every run; expected "
            "another key, or a study without this parameter\n");
}

TEST_F(Evaluate, RefusesLinesThatAreNoQuestionsAndLosesNothing) {
  const std::string expected = R"(; expected {"id": 7, "parameters": {"KEY": VALUE}})";
  const auto refuses = [&](const std::string& line, const std::string& message) {
    const Result result = ask(question("1", "0.7") + "\n" + question("2", "0.8") + line + "\n");
    EXPECT_EQ(result.code, 2) << line.substr(0, 100);
    EXPECT_EQ(result.err, message + "\n") << line.substr(0, 100);
    EXPECT_EQ(answers(result).size(), 1U) << line.substr(0, 100);  // the batch before the refused line is answered
  };
  refuses("hello", "stdin:4:1: error: is not JSON" + expected);
  refuses(R"({"id": 1, "parameters": {"cpg.phase_lag": NaN}})", "stdin:4:43: error: is not JSON" + expected);
  refuses(R"({"id": 1, "parameters": {"cpg.phase_lag": 1e999}})",
          "stdin:4:1: error: holds a number that is too large" + expected);
  refuses("[1]", "stdin:4:1: error: is not a JSON object" + expected);
  refuses("{}", "stdin:4:1: error: has no id" + expected + "\nstdin:4:1: error: has no parameters" + expected);
  refuses(R"({"id": 1.5, "parameters": [], "x": 1})",
          "stdin:4:1: error: unknown key 'x'" + expected + "\nstdin:4:1: error: its id is not a whole number or a text" +
              expected + "\nstdin:4:1: error: its parameters are not an object" + expected);
  refuses(R"({"id": 1, "parameters": {"cpg.phase_lga": 1, "cpg.type": 3, "physics.step": null, "trace.period": 0.015}})",
          "stdin:4:1: error: has no value for the parameter 'cpg.phase_lag'\n"
          "stdin:4:1: error: cpg.type is 3; expected a word, in double quotes\n"
          "stdin:4:1: error: physics.step is null; expected a number\n"
          "stdin:4:1: error: unknown parameter 'cpg.phase_lga'; did you mean 'cpg.phase_lag'?");
  refuses(R"({"id": 1, "parameters": {"cpg.phase_lag": [[1]]}})", "stdin:4:1: error: holds values within values" + expected);
  refuses(std::string(2 << 20, '['), "stdin:4:1: error: the line is longer than 1048576 bytes; expected a shorter line");
  EXPECT_EQ(studies::Journal(folder_ / "e/study.db").rows(), 1U);
  EXPECT_EQ(answers(ask(question("1", "0.7"))).size(), 1U);
}

TEST_F(Evaluate, AFolderBelongsToOneStudy) {
  ASSERT_EQ(ask(question("1", "0.7")).code, 0);
  ASSERT_EQ(ask("").code, 0);
  ASSERT_EQ(ask("\n\n\n").code, 0);
  EXPECT_EQ(studies::Journal(folder_ / "e/study.db").head().runs, 1U);
  const Result sweep = call("sweep two.yaml --grid cpg.phase_lag=1:2:3 --out e --quiet");
  EXPECT_EQ(sweep.code, 2);
  EXPECT_TRUE(
      contains(sweep.err,
               "e/study.db: error: belongs to another study; choose another folder (--out), or continue it as it was begun: "
               "gaitlab evaluate study.yaml --out e"))
      << sweep.err;
}

}  // namespace
}  // namespace gaitlab::test
