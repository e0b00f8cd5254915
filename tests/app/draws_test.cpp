// `gaitlab run --draws`: verdicts on many robots from the same drawings; and replicates of a study, which are such robots.
#include <nlohmann/json.hpp>

#include "tests/app/study_fixture.h"
#include "tests/labels.h"

namespace gaitlab::test {
namespace {

const Label kLongDraws(
    "DrawnRobots.AreTheRunsOfTheirSeeds:DrawnRobots.NeedSomethingToDraw:DrawnRobots.ReplicatesOfAStudyAreRobots:DrawnRobots."
    "DecideTheExitCode",
    "long");

class DrawnRobots : public StudyFixture {
 protected:
  DrawnRobots() {
    folder_.write("walk.yaml", R"(gaitlab: 1
robot:
  modules: mtran
  docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0], [1, 4, 4, 3, 0], [1, 5, 4, 4, 0], [1, 6, 4, 5, 0], [1, 7, 4, 6, 0]]
physics: {engine: articulated}
contact: {on: all}
cpg: {type: phase_oscillator, frequency: 0.5, amplitude: 0.7, phase_lag: 1.2}
duration: 8
tolerances: {mass: 0.03, inertia: 0.05, dock_angle: 0.01, foot_friction: 0.1, R: 0.07, Kt: 0.05, gear_friction: 0.1, supply: 0.02}
)");
  }
  nlohmann::json json(const std::string& file) { return nlohmann::json::parse(read(folder_ / file)); }
};

// --draws in lanes gives the same verdicts as a run for each seed.
TEST_F(DrawnRobots, AreTheRunsOfTheirSeeds) {
  const Result many = call("run walk.yaml --draws 6 -j 2 --no-report --out many");
  ASSERT_EQ(many.code, 0) << many.err;
  const nlohmann::json draws = json("many/verdict.json")["draws"];
  ASSERT_EQ(draws["count"], 6);
  ASSERT_EQ(draws["each"].size(), 6U);
  int feasible = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    const std::string out = "one" + std::to_string(seed);
    ASSERT_EQ(call("run walk.yaml --no-report --seed " + std::to_string(seed) + " --out " + out).code, 0);
    const nlohmann::json one = draws["each"][static_cast<std::size_t>(seed - 1)];
    const nlohmann::json alone = json(out + "/verdict.json");
    EXPECT_EQ(one["seed"], seed);
    EXPECT_EQ(one["verdict"], alone["verdict"]) << seed;
    EXPECT_EQ(one["distance"], json(out + "/summary.json")["distance"]) << seed;
    feasible += alone["verdict"] == "feasible" ? 1 : 0;
    std::vector<std::string> failing;
    for (const nlohmann::json& check : alone["checks"]) {
      if (check["status"] == "fail") failing.push_back(check["id"]);
    }
    ASSERT_EQ(one["fails"].size(), failing.size()) << seed;
    for (std::size_t k = 0; k < failing.size(); ++k) EXPECT_EQ(one["fails"][k]["check"], failing[k]) << seed;
  }
  EXPECT_EQ(draws["feasible"], feasible);
  EXPECT_GT(feasible, 0);
  EXPECT_LT(feasible, 6);
  const std::string text = draws["text"];
  EXPECT_TRUE(contains(text, "feasible in " + std::to_string(feasible) + " of 6 robots; voltage fails in")) << text;
  EXPECT_TRUE(contains(many.out, "draws     " + text)) << many.out;
  EXPECT_TRUE(contains(read(folder_ / "one2/verdict.json"), "draws") == false);

  // A report on the folder has the draws without simulating them.
  const Result again = call("report many --no-report");
  const Result page = again.code == 0 ? again : call("report many");
  ASSERT_EQ(page.code, 0) << page.err;
  EXPECT_TRUE(contains(page.out, text)) << page.out;
}

TEST_F(DrawnRobots, DecideTheExitCode) {
  EXPECT_EQ(call("run walk.yaml --seed 2 --fail-infeasible --no-report --out a").code, 0);
  EXPECT_EQ(call("run walk.yaml --seed 2 --draws 8 --fail-infeasible --no-report --out b").code, 3);
}

TEST_F(DrawnRobots, NeedSomethingToDraw) {
  const Result none = call("run walk.yaml --set tolerances={} --draws 4 --out none");
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(
      contains(none.err, "--draws: error: the seed has no effect, because no tolerance, sensor or lost set point is drawn"))
      << none.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
  const Result stated = call("run walk.yaml --set as_built={mass:\\ 1} --draws 1 --no-report --out stated");
  EXPECT_EQ(stated.code, 0) << stated.err;
  // The resolved scenario of a run, an encoder without errors and a single module have no draws.
  ASSERT_EQ(call("run walk.yaml --set duration=1 --no-report --out drawn").code, 0);
  for (const char* same :
       {"run drawn/scenario.resolved.yaml", "run walk.yaml --set tolerances={} --set 'sensors={type: encoder}'",
        "run walk.yaml --set robot.docks=[] --set 'tolerances={dock_angle: 0.01}'"}) {
    EXPECT_EQ(call(std::string(same) + " --draws 2 --out none").code, 2) << same;
  }
  EXPECT_EQ(call("run walk.yaml --seed 8999999999999999999 --draws 3 --out none").code, 2);
  const Result zero = call("run walk.yaml --draws 0 --out none");
  EXPECT_EQ(zero.code, 2);
  const Result sensors =
      call("run walk.yaml --set tolerances={} --set 'sensors={type: encoder, noise: 0.001}' --draws 2 --no-report --out noise");
  EXPECT_EQ(sensors.code, 0) << sensors.err;
  EXPECT_TRUE(contains(sensors.out, "of 2 draws")) << sensors.out;
  const Result lost = call(
      "run walk.yaml --set tolerances={} --set 'at=[{t: 0, fault: {joint: \"*\", kind: lost, share: 0.1}}]' --draws 2 "
      "--no-report "
      "--out lost");
  EXPECT_EQ(lost.code, 0) << lost.err;
}

TEST_F(DrawnRobots, ReplicatesOfAStudyAreRobots) {
  folder_.write("s.yaml",
                "gaitlab_study: 1\nscenario: walk.yaml\nparameters: {cpg.amplitude: {values: [0.4, 0.7]}}\nguards: verdict\n"
                "objective: {maximize: speed}\nquantities: [speed]\nreplicates: {count: 4, combine: share(0.25)}\n");
  const Result sweep = call("sweep s.yaml --out s");
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  EXPECT_TRUE(contains(sweep.out, "4 of 4")) << sweep.out;
  const auto rows = table("s");
  ASSERT_EQ(rows.size(), 8U);
  for (const std::size_t k : {1U, 6U}) {
    const auto& row = rows[k];
    const std::string out = "r" + std::to_string(k);
    ASSERT_EQ(call("run walk.yaml --no-report --set cpg.amplitude=" + row.at("cpg.amplitude") + " --seed " + row.at("seed") +
                   " --out " + out)
                  .code,
              0);
    EXPECT_EQ(json(out + "/summary.json")["speed"], std::stod(row.at("speed"))) << k;
    EXPECT_EQ(json(out + "/verdict.json")["verdict"], row.at("verdict")) << k;
  }
}

}  // namespace
}  // namespace gaitlab::test
