// Every error in a study file has a message and is reported before any run.
#include "studies/study/study_file.h"

#include "app/study/study_quantities.h"
#include "studies/plan/plan.h"
#include "studies/plan/plan_checks.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

class StudyFile : public ::testing::Test {
 protected:
  StudyFile() {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder_ / "modules");
    folder_.write("two.yaml",
                  "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
                  "cpg: {type: phase_oscillator, frequency: 1}\nduration: 0.1\n");
  }

  /// Error message, without the folder, of a study file that is read and applied to two.yaml.
  std::string error(const std::string& text) { return error_of(folder_.write("s.yaml", text), studies::Purpose::sweep); }
  std::string error_of(const std::string& file, studies::Purpose purpose) {
    std::string what =
        message_of([&] { const studies::Plan plan(studies::read_study(file, purpose), app::quantity_offer(), catalog()); });
    for (std::size_t at = 0; (at = what.find(folder_.path().string() + "/")) != std::string::npos;)
      what.erase(at, folder_.path().string().size() + 1);
    return what;
  }
  /// Error message of a search study that is correct except for these lines.
  std::string search(const std::string& lines) {
    const std::string file = folder_.write("s.yaml",
                                           "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.frequency: {low: 0.5, "
                                           "high: 1}}\n" +
                                               lines);
    return error_of(file, studies::Purpose::optimize);
  }
  /// Error message of a sweep study that is correct except for these lines.
  std::string with(const std::string& lines) {
    return error("gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.frequency: {low: 0.5, high: 1, count: 3}}\n" + lines);
  }
  /// Error message of a sweep study with these parameters.
  std::string parameters(const std::string& text, const std::string& more = "") {
    return error("gaitlab_study: 1\nscenario: two.yaml\nparameters: {" + text + "}\n" + more);
  }

  Folder folder_;
};

TEST_F(StudyFile, IsTaken) {
  EXPECT_EQ(with(""), kNoError);
  EXPECT_EQ(with("objective: {minimize: \"torque.peak[m0/active] / max(speed, 1e-6)\"}\nconstraints: [torque.rms <= 0.6]\n"
                 "guards: {stops: 0.2, dock_bending: {margin: 0.2}, periodic: true, slip: false}\nreplicates: {count: 3, vary: "
                 "{actuator.R: {times: {uniform: [0.9, 1.1]}}}}\n"),
            kNoError);
}

TEST_F(StudyFile, ItsRulesForStoppingAreChecked) {
  EXPECT_EQ(with("stop: [fell, saturated.voltage > 0.3 after 0.04, \"torque.peak[m0/active] > 2\"]\n"), kNoError);
  EXPECT_EQ(with("stop: [feel]\n"), "s.yaml:4:8: error: unknown quantity 'feel'; did you mean 'fell'?");
  EXPECT_EQ(with("stop: [fell after noon]\n"),
            "s.yaml:4:8: error: a rule ends with after 'noon'; expected a number of seconds: fell after 2");
  EXPECT_TRUE(
      contains(with("stop: [limit_cycle.found]\n"),
               "s.yaml:4:8: error: limit_cycle.found is known only after a run has ended; a stop rule can use simulated, "));
  EXPECT_EQ(with("stop: [fell, distance > 1 after 4]\n"),
            "s.yaml:4:14: error: the rule begins at 4 s, but the run ends at 0.1 s; expected a smaller number after `after`");
  EXPECT_EQ(with("stop: [fell after 4]\nset: [duration=5]\n"), kNoError);
  EXPECT_EQ(parameters("duration: {values: [1, 5]}", "stop: [fell after 4]\n"), kNoError);
  EXPECT_EQ(with("stop: fell\n"), "s.yaml:4:7: error: stop is 'fell'; expected a list of texts, or none");
  EXPECT_EQ(with("stop: none\n"), kNoError);
  EXPECT_EQ(with("stop: [hopeless, fell, hopeless after 0.05]\n"), kNoError);
  EXPECT_EQ(with("stop: [hopeless after 4]\n"),
            "s.yaml:4:8: error: the rule begins at 4 s, but the run ends at 0.1 s; expected a smaller number after `after`");
}

/// The rule `hopeless` is the default of searches, of points that another program requests, and of no sweep; nor where a point
/// can be kept although some of its runs break a limit.
TEST_F(StudyFile, StopsHopelessRunsOfSearches) {
  using studies::Purpose;
  const auto stops = [&](const std::string& lines, Purpose purpose = Purpose::optimize) {
    const std::string head = "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.frequency: {low: 0.5, high: 1}}\n";
    std::vector<std::string> texts;
    for (const studies::StopText& stop :
         studies::read_study(folder_.write("s.yaml", head + "budget: {runs: 640}\n" + lines), purpose).stops)
      texts.push_back(stop.when.text);
    return texts;
  };
  using Texts = std::vector<std::string>;
  const Texts usual{"hopeless"};
  EXPECT_EQ(stops(""), usual);
  EXPECT_EQ(stops("", Purpose::evaluate), usual);
  EXPECT_EQ(stops("", Purpose::sweep), Texts{});
  EXPECT_EQ(stops("stop: none\n"), Texts{});
  EXPECT_EQ(stops("stop: []\n"), Texts{});
  EXPECT_EQ(stops("stop: [fell]\n"), Texts{"fell"});
  EXPECT_EQ(stops("stop: [hopeless, fell]\n", Purpose::sweep), (Texts{"hopeless", "fell"}));
  EXPECT_EQ(stops("replicates: {count: 2}\n"), usual);
  EXPECT_EQ(stops("replicates: {count: 2, combine: mean}\n"), usual);
  for (const char* combine : {"median", "quantile(0.5)", "share(0.5)"})
    EXPECT_EQ(stops(std::string("replicates: {count: 2, combine: ") + combine + "}\n"), Texts{}) << combine;
  EXPECT_EQ(stops("robust: true\n"), Texts{});
}

TEST_F(StudyFile, ItsSensitivityIsChecked) {
  const std::string both = "cpg.frequency: {low: 0.5, high: 1}";
  EXPECT_EQ(parameters(both, "method: {type: morris, trajectories: 4}\n"), kNoError);
  EXPECT_EQ(parameters(both, "method: {type: sobol_indices, samples: 8}\n"), kNoError);
  EXPECT_EQ(parameters(both, "method: {type: morris}\nbudget: {runs: 100}\n"),
            "s.yaml:1:1: error: method morris takes no budget of runs; expected method: {trajectories: N}");
  EXPECT_EQ(parameters("cpg.frequency: {values: [0.5, 1]}", "method: {type: morris}\n"),
            "s.yaml:3:14: error: cpg.frequency has a list of values, but method morris needs `low` and `high`");
}

TEST_F(StudyFile, ItsParametersAreChecked) {
  EXPECT_EQ(parameters("cpg.frequency: {low: 1 Hz, high: 2, count: 3}"),
            "s.yaml:3:35: error: low is '1 Hz'; expected a number");
  EXPECT_EQ(parameters("cpg.frequency: {low: 2, high: 1, count: 3}"),
            "s.yaml:3:14: error: cpg.frequency: low is 2, not below high, 1");
  EXPECT_EQ(parameters("cpg.frequency: {low: 0, high: 1, scale: log, count: 3}"),
            "s.yaml:3:14: error: cpg.frequency: low is 0; expected more than 0 for a logarithm");
  EXPECT_EQ(parameters("cpg.frequency: {low: 0.1, count: 3}"), "s.yaml:3:29: error: missing key 'high'");
  EXPECT_EQ(parameters("cpg.frequency: {values: [1, fast]}"),
            "s.yaml:3:38: error: cpg.frequency.values mixes numbers and words; expected one or the other");
  EXPECT_EQ(parameters("cpg.frequency: {values: [1, 2, 1.0]}"), "s.yaml:3:45: error: cpg.frequency.values holds '1' twice");
  EXPECT_EQ(parameters("cpg.frequency: {values: []}"),
            "s.yaml:3:38: error: cpg.frequency.values is empty; expected a list of values: [0.5, 1, 2]");
  EXPECT_EQ(parameters("cpg.frequency: {low: 1, high: 2, cuont: 3}"),
            "s.yaml:3:47: error: unknown key 'cuont'; did you mean 'count'?");
  EXPECT_EQ(parameters("cpg.frequancy: {low: 1, high: 2, count: 3}"),
            "s.yaml:3:14: error: unknown key 'frequancy'; did you mean 'frequency'?");
  EXPECT_EQ(parameters("cpg.frequency: {low: 1, high: 2}", "method: {type: grid}\n"),
            "s.yaml:3:14: error: cpg.frequency has no count; expected one for a grid, or method: {type: random} or sobol");
  EXPECT_EQ(parameters("cpg.frequency: {low: 1, high: 2}"),
            "s.yaml:1:1: error: missing budget: {runs: N}, which method random needs");
  EXPECT_EQ(parameters("cpg.frequency: {low: 1, high: 2, count: 3}", "method: {type: sobol}\nbudget: {runs: 9}\n"),
            "s.yaml:3:14: error: cpg.frequency has a count, which only method grid uses; method.type is sobol");
  EXPECT_EQ(
      parameters("cpg.frequency: {low: 1, high: 2}", "method: {type: random}\nbudget: {runs: 2}\nreplicates: {count: 3}\n"),
      "s.yaml:1:1: error: a budget of 2 runs is less than the 3 replicates of one point");
}

TEST_F(StudyFile, ItsExpressionsAreChecked) {
  EXPECT_EQ(with("objective: {maximize: spee}\n"), "s.yaml:4:23: error: unknown quantity 'spee'; did you mean 'speed'?");
  EXPECT_EQ(with("objective: {maximize: speed + }\n"),
            "s.yaml:4:30: error: found the end of the text; expected a number, a name or '('");
  EXPECT_EQ(with("objective: {maximize: 2*lg(speed)}\n"), "s.yaml:4:25: error: unknown function 'lg'; did you mean 'log'?");
  EXPECT_EQ(with("objective: {maximize: min(speed)}\n"), "s.yaml:4:23: error: min takes 2 arguments, found 1");
  EXPECT_EQ(with("objective: {maximise: speed}\n"), "s.yaml:4:13: error: unknown key 'maximise'; did you mean 'maximize'?");
  EXPECT_EQ(with("constraints: [torque.rms]\n"),
            "s.yaml:4:15: error: 'torque.rms' is not a constraint; expected a <= b, a >= b or a == b");
  EXPECT_EQ(with("constraints: ['torque.rms[m9/active] <= 1']\n"),
            "s.yaml:4:16: error: no joint is called 'm9/active'; did you mean 'm0/active'?");
  EXPECT_EQ(with("constraints: ['speed[m0/active] <= 1']\n"),
            "s.yaml:4:16: error: 'speed' applies to the whole robot; expected it without [m0/active]");
  EXPECT_EQ(with("guards: {stop: 0.1}\n"), "s.yaml:4:10: error: unknown check 'stop'; did you mean 'stops'?");
  EXPECT_EQ(with("guards: {slip: false, voltge: {margin: 0.1}}\n"),
            "s.yaml:4:23: error: unknown check 'voltge'; did you mean 'voltage'?");
  EXPECT_EQ(with("guards: {stops: much}\n"),
            "s.yaml:4:17: error: guards.stops is 'much'; expected a limit, {margin: NUMBER}, true or false");
  EXPECT_EQ(with("guards: {stops: {limit: 1}}\n"),
            "s.yaml:4:17: error: guards.stops is a map; expected a limit, {margin: NUMBER}, true or false");
  EXPECT_EQ(with("guards: {field: 2}\n"),
            "s.yaml:4:10: error: field has no limit that a number could replace; expected {margin: NUMBER}, true or false");
  EXPECT_EQ(with("guards: walk\n"),
            "s.yaml:4:9: error: guards is 'walk'; expected verdict, none, or checks of the verdict: {stops: 0.1, "
            "dock_bending: {margin: 0.2}, periodic: true, slip: false}");
}

TEST_F(StudyFile, ASearchIsChecked) {
  EXPECT_EQ(search("budget: {runs: 16}\n"), kNoError);
  EXPECT_EQ(search("budget: {runs: 16}\nmethod: {population: 8}\n"), kNoError) << "of the usual search";
  EXPECT_EQ(search("budget: {runs: 64}\nobjective: [{maximize: speed}, {minimize: torque.peak}]\n"), kNoError);
  EXPECT_EQ(search(""), "s.yaml:1:1: error: missing budget: {runs: N}, which method scbo needs");
  EXPECT_EQ(search("budget: {runs: 15}\n"),
            "s.yaml:1:1: error: a budget of 15 runs is too small: the first generation of all searches has 16 runs");
  EXPECT_EQ(search("budget: {runs: 63}\nmethod: {type: cma, instances: 2}\nreplicates: {count: 2}\n"),
            "s.yaml:1:1: error: a budget of 63 runs is too small: the first generation of all searches has 64 runs");
  EXPECT_EQ(search("budget: {runs: 64}\nmethod: {type: cmaes}\n"),
            "s.yaml:5:16: error: type 'cmaes' is unknown; known names: grid, random, sobol, morris, sobol_indices, scbo, "
            "cma_gp, cma, xnes, sade, pso, nsga2");
  EXPECT_EQ(search("budget: {runs: 64}\nmethod: {type: cma, population: 4}\n"),
            "s.yaml:1:1: error: a population of 4 is too small for method cma; expected at least 5");
  EXPECT_EQ(search("budget: {runs: 64}\nmethod: {type: cma, popul: 8}\n"),
            "s.yaml:5:21: error: unknown key 'popul'; did you mean 'population'?");
  EXPECT_EQ(search("budget: {runs: 64}\nmethod: {type: cma, sigma: 2}\n").substr(0, 28), "s.yaml:5:28: error: sigma is");
  EXPECT_EQ(search("budget: {runs: 64}\nmethod: {type: nsga2}\n"),
            "s.yaml:1:1: error: method nsga2 is for two or three objectives; expected scbo, cma_gp, cma, xnes, sade or pso");
  EXPECT_EQ(search("budget: {runs: 64}\nmethod: {type: pso}\nobjective: [{maximize: speed}, {minimize: torque.peak}]\n"),
            "s.yaml:1:1: error: method pso is for one objective; expected nsga2");
  EXPECT_EQ(search("budget: {runs: 64}\nmethod: {type: nsga2, population: 18}\nobjective: [{maximize: speed}, {minimize: "
                   "torque.peak}]\n"),
            "s.yaml:1:1: error: a population of 18 does not suit method nsga2; expected a multiple of 4 that is at least 8");
  EXPECT_EQ(search("budget: {runs: 64, wall: 1 h}\n"), "s.yaml:4:20: error: unknown key 'wall'; known keys: runs");
  EXPECT_EQ(search("budget: {runs: 64}\nverify: {engine: bulet}\n"),
            "s.yaml:5:18: error: verify.engine 'bulet' is not known; did you mean 'bullet'?");
  EXPECT_EQ(
      search("budget: {runs: 64}\nverify: {engine: articulated}\n"),
      "s.yaml:5:18: error: verify.engine is articulated, the engine of the study itself; expected another, or `none`; engines: "
      "bullet, articulated");
  EXPECT_EQ(search("budget: {runs: 64}\nverify: {best: 0}\n").substr(0, 27), "s.yaml:5:16: error: best is");
  EXPECT_EQ(parameters("cpg.type: {values: [hopf, sine]}", "method: {type: cma}\nbudget: {runs: 64}\n"),
            "s.yaml:1:1: error: method cma has nothing to search: no parameter has `low` and `high`");
}

/// docs/studies.md: scbo up to 10 parameters and a budget up to 2000 points, else cma_gp; nsga2 for several objectives.
TEST_F(StudyFile, TheUsualSearchDependsOnPointsAndParameters) {
  const auto method = [&](const std::string& lines) {
    const std::string head = "gaitlab_study: 1\nscenario: two.yaml\nparameters: {cpg.frequency: {low: 0.5, high: 1}}\n";
    return studies::read_study(folder_.write("s.yaml", head + lines), studies::Purpose::optimize).method;
  };
  EXPECT_EQ(method("budget: {runs: 2000}\n"), studies::Method::scbo);
  EXPECT_EQ(method("budget: {runs: 2001}\n"), studies::Method::cma_gp);
  EXPECT_EQ(method("budget: {runs: 6000}\nreplicates: {count: 3}\n"), studies::Method::scbo) << "points, not runs";
  EXPECT_EQ(method("budget: {runs: 64}\nobjective: [{maximize: speed}, {minimize: torque.peak}]\n"), studies::Method::nsga2);
}

TEST_F(StudyFile, StartPointsAreChecked) {
  const std::string head = "budget: {runs: 64}\n";
  EXPECT_EQ(search(head + "start: []\n"), kNoError);
  EXPECT_EQ(search("budget: {runs: 17}\nstart: [{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}]\n"),
            "s.yaml:1:1: error: a budget of 17 runs is too small: the first generation of all searches has 18 runs");
  EXPECT_EQ(search(head + "method: {type: scbo, population: 1001}\n"),
            "s.yaml:1:1: error: a population of 1001 is too large for method scbo; expected at most 1000");
  EXPECT_EQ(search(head + "start: 3\n"), "s.yaml:5:8: error: start is 3; expected a list of points: [{cpg.frequency: 0.5}]");
  EXPECT_EQ(search(head + "start: [3]\n"),
            "s.yaml:5:9: error: a point of start is 3; expected a list of points: [{cpg.frequency: 0.5}]");
  EXPECT_EQ(search(head + "start: [{cpg.frequncy: 1}]\n"),
            "s.yaml:5:10: error: unknown parameter 'cpg.frequncy'; did you mean 'cpg.frequency'?");
  EXPECT_EQ(search(head + "start: [{cpg.frequency: 99}]\n").substr(0, 57),
            "s.yaml:5:25: error: cpg.frequency is 99; expected 0.5 to ");
  EXPECT_EQ(parameters("cpg.frequency: {values: [0.5, 1]}, cpg.phase_lag: {low: 0, high: 1}",
                       "method: {type: cma}\nbudget: {runs: 64}\nstart: [{cpg.frequency: 0.7}]\n"),
            "s.yaml:6:25: error: cpg.frequency is 0.7; expected one of its values: 0.5, 1");
  EXPECT_EQ(search(head + "method: {type: random}\nstart: [{cpg.frequency: 1}]\n"),
            "s.yaml:6:9: error: start is for searches such as scbo; method random does not search");
}

TEST_F(StudyFile, TheSeedBelongsToTheReplicates) {
  constexpr const char* kWhy = "seed cannot be chosen here; expected replicates: {count: N}, whose runs differ in their seed";
  EXPECT_EQ(parameters("seed: {values: [3, 4]}", ""), std::string("s.yaml:3:14: error: ") + kWhy);
  EXPECT_EQ(with("replicates: {count: 3, vary: {seed: {values: [1, 2]}}}\n"), std::string("s.yaml:4:31: error: ") + kWhy);
}

TEST_F(StudyFile, ItsReplicatesAreChecked) {
  EXPECT_EQ(with("replicates: {vary: {ground.friction: {normal: [0.8]}}}\n"),
            "s.yaml:4:47: error: ground.friction is not normal: [MEAN, DEVIATION]\ns.yaml:4:13: error: missing key 'count'");
  EXPECT_EQ(
      with("replicates: {count: 3, vary: {ground.friction: {normal: [0.8, 0.1], uniform: [0, 1]}}}\n"),
      "s.yaml:4:48: error: ground.friction has several laws; expected one of normal: [MEAN, DEVIATION], uniform: [LOW, HIGH], "
      "values: [...]");
  EXPECT_EQ(
      with("replicates: {count: 3, vary: {cpg.frequency: {uniform: [0.5, 1]}}}\n"),
      "s.yaml:3:14: error: cpg.frequency is a parameter and drawn for every replicate; expected vary: {cpg.frequency: {times: "
      "...}}, or one of the two");
  EXPECT_EQ(with("replicates: {count: 3, combine: best}\n"),
            "s.yaml:4:33: error: combine is 'best'; expected mean, worst, median, quantile(Q), share(Q) with Q from 0 to 1");
  EXPECT_EQ(with("replicates: {count: 3, vary: {robot.modules: {times: {uniform: [1, 2]}}}}\n").substr(0, 20),
            "s.yaml:4:31: error: ");
}

TEST_F(StudyFile, ThoseThatComeWithTheProgramAreTaken) {
  std::size_t searches = 0;
  for (const auto& file : std::filesystem::directory_iterator(kScenarios + "studies")) {
    const std::string name = file.path().string();
    const auto method = studies::read_study(name, studies::Purpose::sweep).method;
    searches += studies::is_search(method) ? 1 : 0;
    const auto purpose = studies::is_search(method) ? studies::Purpose::optimize : studies::Purpose::sweep;
    EXPECT_EQ(error_of(name, purpose), kNoError) << name;
    const studies::Plan plan(studies::read_study(name, purpose), app::quantity_offer(), catalog());
    EXPECT_TRUE(short_runs(plan).empty()) << name << ": " << short_runs(plan).front().text;
    EXPECT_TRUE(plan.study().notes.empty()) << name;
  }
  EXPECT_GE(searches, 4U);
  const studies::Study robust = studies::read_study(kScenarios + "studies/hexapod-robust.yaml", studies::Purpose::optimize);
  EXPECT_EQ(robust.method, studies::Method::scbo);
  EXPECT_EQ(robust.replicates.count, 8);
  EXPECT_EQ(robust.replicates.combine, studies::Combine::worst);
}

TEST_F(StudyFile, AllThatIsWrongIsToldAtOnce) {
  EXPECT_EQ(error("gaitlab_study: 1\nscenari: two.yaml\nparameters: {a: {low: 1, high: x}}\nseed: -1\n").substr(0, 7),
            "s.yaml:");
  EXPECT_EQ(error("gaitlab_study: 2\n"), "s.yaml:1:16: error: gaitlab_study is 2; expected 1, the only format version");
}

}  // namespace
}  // namespace gaitlab::test
