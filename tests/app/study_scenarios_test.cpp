// Tests of studies with several scenarios, in each of which every point is simulated.
#include <nlohmann/json.hpp>

#include "studies/journal/journal.h"
#include "tests/app/study_fixture.h"
#include "tests/labels.h"

namespace gaitlab::test {
namespace {

const Label kLongStudyScenarios("StudyScenarios.AreSearchedAndVerifiedTogether", "long");

class StudyScenarios : public StudyFixture {
 protected:
  StudyScenarios() {
    // Module m1 of the three modules is assembled last, so that its joints have other numbers than in two.yaml.
    folder_.write("three.yaml",
                  "gaitlab: 1\nname: three\nrobot: {modules: mtran, docks: [[1, 2, 4, 0, 0], [1, 1, 4, 2, 0]]}\ncontact: {on: "
                  "all}\nphysics: {engine: articulated}\ncpg: {type: phase_oscillator, frequency: 1}\ntrace: {period: 0.015}\n"
                  "duration: 0.45\nground: {friction: 0.5}\n");
    study("");
  }
  void study(const std::string& lines, const std::string& name = "s.yaml",
             const std::string& scenarios = "{short: two.yaml, long: three.yaml}") {
    folder_.write(name, "gaitlab_study: 1\nscenarios: " + scenarios +
                            "\nparameters: {cpg.phase_lag: {low: 0.5, high: 1.5, count: 2}}\nguards: none\n" + lines);
  }
  std::string error(const std::string& lines, const std::string& head = "scenarios: {short: two.yaml, long: three.yaml}") {
    folder_.write("e.yaml", "gaitlab_study: 1\n" + head + "\n" + lines);
    const Result result = call("sweep e.yaml --out e");
    EXPECT_EQ(result.code, 2) << result.out;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "e"));
    return result.err;
  }
};

TEST_F(StudyScenarios, EveryPointRunsInEach) {
  study(
      "replicates: {count: 2, vary: {ground.friction: {times: {uniform: [0.9, 1.1]}}}}\nquantities: [speed, "
      "'torque.peak[m1/active]']\n");
  const Result sweep = call("sweep s.yaml --out s");
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  const auto rows = table("s");
  ASSERT_EQ(rows.size(), 8U);
  const std::vector<std::string> names{"short", "short", "long", "long"};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k].at("scenario"), names[k % 4]) << k;
    EXPECT_EQ(rows[k].at("replicate"), std::to_string(k % 2)) << k;
    EXPECT_EQ(rows[k].at("seed"), rows[k % 2].at("seed")) << "a replicate has its seed in every scenario";
    EXPECT_EQ(rows[k].at("point"), rows[k < 4 ? 0 : 4].at("point")) << k;
  }
  EXPECT_NE(rows[0].at("point"), rows[4].at("point"));
  // A factor multiplies the value of each scenario.
  EXPECT_NEAR(std::stod(rows[2].at("ground.friction")) / std::stod(rows[0].at("ground.friction")), 0.5 / 0.8, 1e-9);
  for (const std::size_t k : {1U, 6U}) {
    const auto& row = rows[k];
    const std::string file = row.at("scenario") == "short" ? "two.yaml" : "three.yaml";
    const std::string out = " --out r" + std::to_string(k);
    ASSERT_EQ(call("run " + file + " --no-report --set cpg.phase_lag=" + row.at("cpg.phase_lag") +
                   " --set ground.friction=" + row.at("ground.friction") + " --seed " + row.at("seed") + out)
                  .code,
              0);
    const auto summary = nlohmann::json::parse(read(folder_ / ("r" + std::to_string(k) + "/summary.json")));
    EXPECT_EQ(std::stod(row.at("speed")), summary.at("speed").get<double>());
    EXPECT_EQ(std::stod(row.at("torque.peak[m1/active]")),
              summary.at("per_joint").at("m1/active").at("torque").at("peak").get<double>());
    const Result again = call("study rerun s " + row.at("run"));
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_TRUE(contains(again.out, "the quantities are equal to those in the journal")) << again.out;
  }
  // Points are ordered by the worst of their four rows. The table contains the value of each scenario.
  const std::string shown = call("study show s").out;
  EXPECT_TRUE(contains(shown, "speed (worst)  in short  in long")) << shown;
  double worst = 1;
  for (std::size_t k = 0; k < 4; ++k) worst = std::min(worst, std::stod(rows[k].at("speed")));
  EXPECT_TRUE(contains(shown, fmt::format("{:.4g}", worst))) << shown;
  const std::string csv = read(folder_ / "s/replicates.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "point,scenario,replicate,speed,kept");
  EXPECT_TRUE(contains(csv, ",long,1,"));
  EXPECT_TRUE(
      contains(call("sweep s.yaml --dry-run").out, "8 runs: 2 points, 4 runs each\nfirst  scenario short: cpg.phase_lag=0.5 "));
}

TEST_F(StudyScenarios, AreTheSameBytesHoweverTheyRun) {
  study("replicates: {count: 2}\n");
  ASSERT_EQ(call("sweep s.yaml --out one -j 1 --lanes 1 --quiet").code, 0);
  ASSERT_EQ(call("sweep s.yaml --out two -j 2 --quiet").code, 0);
  for (const char* shard : {"1/3", "0/3", "2/3"})
    ASSERT_EQ(call(std::string("sweep s.yaml --out parts --quiet --shard ") + shard).code, 0);
  ASSERT_EQ(call("study merge parts").code, 0);
  const std::string rows = read(folder_ / "one/table.csv");
  EXPECT_EQ(read(folder_ / "two/table.csv"), rows);
  EXPECT_EQ(read(folder_ / "parts/table.csv"), rows);
  // The same study continues. A study with other scenarios, or with other names of the scenarios, is a different study.
  EXPECT_EQ(call("sweep s.yaml --out one --quiet").code, 0);
  EXPECT_EQ(studies::Journal(folder_ / "one/study.db").effort().runs, 8U);
  study("replicates: {count: 2}\n", "s.yaml", "{short: three.yaml, long: two.yaml}");
  const Result other = call("sweep s.yaml --out one");
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "one/study.db: error: belongs to another study")) << other.err;
}

TEST_F(StudyScenarios, AnswerOneAnotherByName) {
  ASSERT_EQ(call("sweep s.yaml --out s --quiet").code, 0);
  const Result same = call("sweep s.yaml --out same --answers s");
  EXPECT_TRUE(contains(same.out, "4 of 4 runs were taken from other studies")) << same.out << same.err;
  EXPECT_EQ(read(folder_ / "same/table.csv"), read(folder_ / "s/table.csv"));
  study("", "swapped.yaml", "{long: two.yaml, short: three.yaml}");
  const Result swapped = call("sweep swapped.yaml --out swapped --answers s");
  EXPECT_TRUE(contains(swapped.out, "0 of 4 runs were taken from other studies")) << swapped.out << swapped.err;
  // One file under two names has a row per name.
  study("", "twins.yaml", "{a: two.yaml, b: two.yaml}");
  ASSERT_EQ(call("sweep twins.yaml --out twins --quiet").code, 0);
  const auto rows = table("twins");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].at("scenario") + rows[1].at("scenario"), "ab");
  EXPECT_EQ(rows[0].at("speed"), rows[1].at("speed"));
}

TEST_F(StudyScenarios, WhatFailsIsToldWithItsScenario) {
  folder_.write("wild.yaml",
                "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
                "cpg: {type: equations, model: {states: {phi: exp(700)*exp(700)}, output: phi}}\nduration: 0.3\n");
  study("", "s.yaml", "{calm: two.yaml, wild: wild.yaml}");
  const Result sweep = call("sweep s.yaml --out s");
  EXPECT_EQ(sweep.code, 0) << sweep.err;
  EXPECT_TRUE(contains(sweep.out, "first: run 1 in wild: ")) << sweep.out;
}

TEST_F(StudyScenarios, AreSearchedAndVerifiedTogether) {
  folder_.write(
      "o.yaml",
      "gaitlab_study: 1\nscenarios: {short: two.yaml, long: three.yaml}\nguards: none\nset: [physics.step=0.001, duration=3]\n"
      "parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nobjective: {minimize: torque.peak}\n"
      "verify: {best: 1, change: 0.5, engine: bullet}\nbudget: {runs: 48}\n");
  ASSERT_EQ(call("optimize o.yaml --out o --quiet").code, 0);
  studies::Journal journal(folder_ / "o/study.db");
  EXPECT_EQ(journal.head().replicates, 2U);
  ASSERT_FALSE(journal.generations().empty());
  EXPECT_EQ(journal.generations()[0].runs, 32U);
  const auto rows = table("o");
  ASSERT_EQ(rows.size(), 48U);
  double best = 1e9;
  for (std::size_t k = 0; k < rows.size(); k += 2) {
    EXPECT_EQ(rows[k].at("cpg.amplitude"), rows[k + 1].at("cpg.amplitude"));
    best = std::min(best, std::max(std::stod(rows[k].at("torque.peak")), std::stod(rows[k + 1].at("torque.peak"))));
  }
  const std::vector<studies::Verification> tried = journal.verifications();
  ASSERT_EQ(tried.size(), 20U) << "with the worlds, in both scenarios";
  EXPECT_EQ(tried[0].objectives.front(), best) << "the worst scenario counts";
  for (const studies::Verification& v : tried) EXPECT_EQ(v.reason, "");
  EXPECT_EQ(call("optimize o.yaml --out o --quiet --runs 47").code, 0);  // the budget is too small for the last point
  folder_.write("few.yaml",
                "gaitlab_study: 1\nscenarios: {short: two.yaml, long: three.yaml}\n"
                "parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nbudget: {runs: 31}\n");
  EXPECT_EQ(call("optimize few.yaml").err,
            "few.yaml:1:1: error: a budget of 31 runs is too small: the first generation of all searches has 32 runs\n");
}

TEST_F(StudyScenarios, AreAskedTogether) {
  folder_.write("q", "{\"id\": 1, \"parameters\": {\"cpg.phase_lag\": 1}}\n");
  const Result result = call("evaluate s.yaml --out e --quiet < q");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto answer = nlohmann::json::parse(result.out);
  const auto speeds = answer.at("figures").at("speed").get<std::vector<double>>();
  ASSERT_EQ(speeds.size(), 2U);
  EXPECT_EQ(answer.at("objective").at(0), std::min(speeds[0], speeds[1]));
  EXPECT_EQ(call("evaluate s.yaml --out e --quiet < q").out, result.out);
  EXPECT_EQ(studies::Journal(folder_ / "e/study.db").effort().runs, 2U);
}

TEST_F(StudyScenarios, OneAloneHasNoColumnOfThem) {
  ASSERT_EQ(call("sweep two.yaml --grid cpg.phase_lag=0.5:1.5:2 --out s --quiet").code, 0);
  EXPECT_EQ(table("s")[0].count("scenario"), 0U);
  EXPECT_EQ(read(folder_ / "s/table.csv").substr(0, 65), "run,point,replicate,seed,outcome,message,simulated,cpg.phase_lag,");
}

TEST_F(StudyScenarios, WrongOnesAreRefused) {
  const std::string parameters = "parameters: {cpg.phase_lag: {low: 0.5, high: 1.5, count: 2}}\n";
  EXPECT_EQ(error(parameters, "scenario: two.yaml\nscenarios: {a: two.yaml}"),
            "e.yaml:3:12: error: the study has `scenario` and `scenarios`; expected one of them\n");
  EXPECT_EQ(error(parameters, "seed: 1"), "e.yaml:1:1: error: missing key 'scenario'\n");
  EXPECT_EQ(error(parameters, "scenarios: {}"),
            "e.yaml:2:12: error: scenarios is empty; expected 1 to 1000 names with their files: {flat: flat.yaml, rubble: "
            "rubble.yaml}\n");
  EXPECT_EQ(error(parameters, "scenarios: two.yaml"),
            "e.yaml:2:12: error: scenarios is 'two.yaml'; expected 1 to 1000 names with their files: {flat: flat.yaml, rubble: "
            "rubble.yaml}\n");
  EXPECT_EQ(error(parameters, "scenarios: {a b: two.yaml, c: [1]}"),
            "e.yaml:2:13: error: scenario name 'a b' is not allowed; expected letters, digits, `_`, `.` and `-`\n"
            "e.yaml:2:31: error: scenario c is a list; expected the name of a file\n");
  EXPECT_TRUE(contains(error(parameters, "scenarios: {a: two.yaml, b: none.yaml}"), "none.yaml"));
}

TEST_F(StudyScenarios, WhatOneLacksIsToldWithItsName) {
  folder_.write("sine.yaml",
                "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
                "cpg: {type: sine, frequency: 1}\nduration: 0.3\n");
  const std::string head = "scenarios: {short: two.yaml, sine: sine.yaml}";
  const std::string lag = "parameters: {cpg.phase_lag: {low: 0.5, high: 1.5, count: 2}}\n";
  EXPECT_EQ(error("parameters: {cpg.model.coupling: {low: 1, high: 2, count: 2}}\n", head),
            "e.yaml:3:14: error: unknown key 'coupling'; coupling is a key of cpg equations, hopf, "
            "kuramoto_amplitude, matsuoka, phase_oscillator, van_der_pol (in scenario sine)\n");
  EXPECT_EQ(error("parameters: {cpg.phase_lagg: {low: 1, high: 2, count: 2}}\n", head),
            "e.yaml:3:14: error: unknown key 'phase_lagg'; did you mean 'phase_lag'?\n");
  EXPECT_EQ(error("set: [cpg.model.coupling=2]\n" + lag, head),
            "e.yaml:3:7: error: unknown key 'coupling'; coupling is a key of cpg equations, hopf, "
            "kuramoto_amplitude, matsuoka, phase_oscillator, van_der_pol (in scenario sine)\n");
  EXPECT_EQ(error(lag + "constraints: ['torque.peak[m2/active] <= 1']\n"),
            "e.yaml:4:16: error: no joint is called 'm2/active'; did you mean 'm0/active'? (in scenario short)\n");
  EXPECT_EQ(error(lag + "stop: ['torque.peak[m2/active] > 1']\n"),
            "e.yaml:4:9: error: no joint is called 'm2/active'; did you mean 'm0/active'? (in scenario short)\n");
  EXPECT_EQ(error(lag + "quantities: [speed, 'torque.peak[m*/active]']\n"),
            "e.yaml:4:13: error: there is a quantity 'torque.peak[m2/active]', which the first scenario does not have (in "
            "scenario long)\n");
}

TEST_F(StudyScenarios, TheEngineOfOneDoesNotVerify) {
  std::string other = read(folder_ / "two.yaml");
  folder_.write("bullet.yaml", other.replace(other.find("articulated"), 11, "bullet, step: 2.5e-5"));
  folder_.write("o.yaml",
                "gaitlab_study: 1\nscenarios: {short: two.yaml, long: bullet.yaml}\n"
                "parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nbudget: {runs: 48}\nverify: {engine: bullet}\n");
  const Result result = call("optimize o.yaml --dry-run");
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(contains(result.err, "verify.engine is bullet, the engine of the study itself; expected another")) << result.err;
  EXPECT_TRUE(contains(result.err, "(in scenario long)")) << result.err;
}

TEST_F(StudyScenarios, AreAllInTheEstimate) {
  folder_.write("o.yaml",
                "gaitlab_study: 1\nscenarios: {short: two.yaml, long: three.yaml}\n"
                "parameters: {cpg.amplitude: {low: 0.05, high: 0.2}}\nbudget: {runs: 48}\n");
  const Result result = call("optimize o.yaml --dry-run -j 1");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "48 runs: 24 points, 2 runs each\n")) << result.out;
  EXPECT_TRUE(contains(result.out, "\n18 s simulated in all\n")) << result.out;
}

// Margins of guards are relative to the limits of each scenario. `study show` prints a limit only if it applies to every
// scenario.
TEST_F(StudyScenarios, GuardsAreMarginsOfEachScenariosOwnLimits) {
  folder_.write("strict.yaml", read(folder_ / "two.yaml") + "limits: {saturated_share: 0.03}\n");
  const auto limits = [&](const std::string& name, const std::string& scenarios) {
    folder_.write(name + ".yaml", "gaitlab_study: 1\nscenarios: " + scenarios +
                                      "\nparameters: {cpg.phase_lag: {low: 0.5, high: 1.5, count: 2}}\n"
                                      "constraints: [torque.peak <= 5]\n");
    const Result result = call("sweep " + name + ".yaml --quiet --out " + name);
    EXPECT_EQ(result.code, 0) << result.err;
    std::vector<std::string> texts;
    const studies::Journal journal(folder_ / (name + "/study.db"));
    for (const studies::Limit& one : journal.head().limits) texts.push_back(one.text);
    return texts;
  };
  const std::vector<std::string> same = limits("same", "{a: two.yaml, b: three.yaml}");
  EXPECT_EQ(std::ranges::count(same, "margin.voltage >= 0"), 1);
  EXPECT_EQ(limits("differ", "{a: two.yaml, b: strict.yaml}"), same);
}

}  // namespace
}  // namespace gaitlab::test
