// Tests of `gaitlab test`: complete messages, exit codes, and changes that a golden detects.
#include <regex>
#include <sstream>

#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "tests/app/golden_command.h"
#include "tests/folders.h"
#include "tests/labels.h"

namespace gaitlab::test {

using namespace golden;
namespace {

const Label kLongGolden("GoldenCommand.FailsWhatIsInfeasible", "long");

/// JUnit text without the times of the runs.
std::string without_times(const std::string& junit) {
  return std::regex_replace(junit, std::regex(" time=\"[0-9]+[.][0-9]{3}\""), "");
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

int lines(const std::string& text) { return static_cast<int>(split(text).size()); }

namespace fs = std::filesystem;

TEST_F(GoldenCommand, ApprovedIsGreen) {
  EXPECT_TRUE(told.starts_with("good.golden: approval 1: 19 columns of 6 rows, 17 numbers, ")) << told;
  expect_contains(told, " kB; bands made\n  widest band: m");
  const Golden golden = read_golden(folder / "good.golden");
  EXPECT_EQ(golden.origin.engine, "bullet");
  EXPECT_EQ(golden.origin.integrator, "semi_implicit");
  EXPECT_EQ(golden.origin.step, 2.5e-5);
  EXPECT_EQ(golden.origin.scenario, hash(resolved(read_scenario(folder / "good.yaml", {}, catalog()))));
  EXPECT_NE(golden.origin.build.find("(" + golden.origin.compiler), std::string::npos);
  EXPECT_EQ(golden.history.front().reason, "first golden");
  EXPECT_EQ(golden.verdict, Word::not_judged);
  EXPECT_EQ(golden.run.trace.columns[1].name, "joint.0.angle");
  EXPECT_LT(golden.run.trace.find("joint.3.torque"), golden.run.trace.columns.size());
  EXPECT_LT(golden.run.trace.find("base.qw"), golden.run.trace.columns.size());
  for (const Band& band : golden.bands) EXPECT_LE(band.width(), 0.002);
  EXPECT_EQ(fs::exists(folder / "good.golden/trace.golden.next"), false);

  const Result result = call("test good.yaml");
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out,
            "scenario   worst column     RMS/band  worst number  change/band  verdict\n"
            "good.yaml  m0/active angle         0  distance                0  passed\n"
            "\n"
            "1 passed, 0 failed\n");
  EXPECT_EQ(result.err, "");
  EXPECT_FALSE(fs::exists(folder / "runs"));
}

/// If a run agrees with its golden but is infeasible, the exit code is 3. Other errors have precedence.
TEST_F(GoldenCommand, FailsWhatIsInfeasible) {
  // The run has three periods, which are sufficient evidence.
  std::string walk = kGait + "physics: {engine: articulated, accuracy: 0.001}\n";
  walk.replace(walk.find("duration: 0.1"), 13, "duration: 3");
  walk.replace(walk.find("amplitude: 0.6"), 14, "amplitude: 0.1");
  folder.write("good.yaml", walk);
  ASSERT_EQ(call("approve good.yaml --reason 'a whole gait'").code, 0);
  EXPECT_EQ(call("test good.yaml --fail-infeasible").code, 0);
  // An engine with given steps refuses an accuracy, so that it is left out. The bands were made for that accuracy. They are
  // therefore widened by three times the change that half the engine's step causes.
  const Result other = call("test good.yaml --engine bullet");
  EXPECT_EQ(other.code, 0) << other.out;
  EXPECT_EQ(other.err.find("error"), std::string::npos) << other.err;  // a slow machine prints progress
  folder.write("good.yaml", kGait);
  ASSERT_EQ(call("approve good.yaml --reason 'the default engine' --replace").code, 0);
  const Result explicit_run = call("test good.yaml --engine bullet");  // with its explicit integrator, which shares nothing
  EXPECT_NE(explicit_run.code, 2) << explicit_run.err;                 // the run is short, so that bands are close
  EXPECT_EQ(explicit_run.out.find("         0  distance                0  passed"), std::string::npos) << explicit_run.out;
  folder.write("good.yaml", walk);
  ASSERT_EQ(call("approve good.yaml --reason 'a whole gait' --replace").code, 0);
  folder.write("good.yaml", walk + "actuator: {Kt: 0.004}\n");
  EXPECT_EQ(call("test good.yaml --engine bullet").code, 4);
  folder.write("good.yaml", walk);
  folder.write("good.yaml", walk + "limits: {tracking_error: 1e-6}\n");
  EXPECT_EQ(call("test good.yaml").code, 0);
  const Result result = call("test good.yaml --fail-infeasible --junit result.xml");
  EXPECT_EQ(result.code, 3);
  expect_contains(result.out, "  INFEASIBLE\n\n0 passed, 0 failed, 1 infeasible\n");
  expect_contains(result.err, "good.yaml: infeasible: joint ");
  expect_contains(read(folder / "result.xml"), "<failure message=\"INFEASIBLE\">good.yaml: infeasible: joint ");
  folder.write("good.yaml", walk + "limits: {tracking_error: 1e-6}\nactuator: {Kt: 0.0039895}\n");
  EXPECT_EQ(call("test good.yaml --fail-infeasible").code, 4);
}

/// A regression beside an infeasible gait is a regression.
TEST_F(GoldenCommand, ARegressionPrecedesAnInfeasibleGait) {
  std::string walk = kGait + "physics: {engine: articulated, accuracy: 0.001}\n";
  walk.replace(walk.find("duration: 0.1"), 13, "duration: 3");
  walk.replace(walk.find("amplitude: 0.6"), 14, "amplitude: 0.1");
  folder.write("walk.yaml", walk);
  ASSERT_EQ(call("approve walk.yaml --reason 'a whole gait'").code, 0);
  folder.write("walk.yaml", walk + "limits: {tracking_error: 1e-6}\n");
  EXPECT_EQ(call("test walk.yaml good.yaml --fail-infeasible").code, 3);
  folder.write("good.yaml", kCaterpillar + "actuator: {Kt: 0.0039895}\n");
  const Result both = call("test walk.yaml good.yaml --fail-infeasible");
  EXPECT_EQ(both.code, 4);
  expect_contains(both.out, "0 passed, 1 failed, 1 infeasible\n");
}

TEST_F(GoldenCommand, AnotherMotorIsARegression) {
  folder.write("good.yaml", kCaterpillar + "actuator: {Kt: 0.0039895}\n");
  const Result result = call("test good.yaml --junit result.xml");
  EXPECT_EQ(result.code, 4);
  EXPECT_EQ(result.err, "");
  expect_contains(result.out, " of 19 columns and ");
  expect_contains(result.out,
                  " of 17 numbers outside their bands\nsince approval 1 (first golden):\n"
                  "  actuator.Kt: 0.00395 -> 0.0039895\n  column ");
  expect_contains(result.out, "\n  m1/passive torque ");
  EXPECT_EQ(result.out.find("joint."), std::string::npos) << result.out;
  expect_contains(result.out, " more: --all shows them; page: runs/test/good.failure.html\n  figure: runs/test/good.svg\n");
  EXPECT_LE(lines(result.out), 24) << result.out;
  for (const std::string& line : split(result.out)) EXPECT_LE(line.size(), 100U) << line;
  expect_contains(result.out, "\n0 passed, 1 failed\n");
  const std::string figure = read(folder / "runs/test/good.svg");
  expect_contains(figure, "good: ");
  expect_contains(figure, "outside from ");
  expect_contains(figure, ">good: the worst 6 of ");
  expect_contains(figure, ">m1/passive torque (N m)");
  EXPECT_EQ(figure.find("joint."), std::string::npos);
  const std::string bands = ">3 bands<";  // label that appears once per panel
  std::size_t panels = 0;
  for (std::size_t at = figure.find(bands); at != std::string::npos; at = figure.find(bands, at + 1)) ++panels;
  EXPECT_EQ(panels, 6U);
  const std::string page = read(folder / "runs/test/good.failure.html");
  expect_contains(page,
                  "\"overlay\":{\"labels\":[\"golden\",\"now\"],\"folders\":[\"\",\"\"],\"differs\":[\"actuator.Kt: 0.00395 -> "
                  "0.0039895\"]");
  expect_contains(page, " numbers outside their bands. The golden is of approval 1 (first golden)\",\"strays\":[{\"signal\":");
  expect_contains(page, "{\"signal\":\"joint.3.torque\",\"unit\":\"N m\",\"ratio\":");
  EXPECT_EQ(page.find(folder / ""), std::string::npos);
  const std::string junit = without_times(read(folder / "result.xml"));
  EXPECT_NE(junit, read(folder / "result.xml"));
  expect_contains(junit,
                  "<testsuite name=\"gaitlab test\" tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\">\n"
                  "<testcase classname=\"golden\" name=\"good.yaml\"><failure message=\"");
  const std::size_t told = result.out.find("since approval");  // start of the text that is also in the XML
  const std::string text = result.out.substr(told, result.out.find("\n\n", told) + 1 - told);
  expect_contains(junit, std::regex_replace(text, std::regex(">"), "&gt;") + "</failure>");
  EXPECT_TRUE(junit.ends_with("</failure></testcase>\n</testsuite>\n</testsuites>\n")) << junit;
}

/// With --all the output contains the whole table. The XML contains only the short output.
TEST_F(GoldenCommand, AllShowsWhatTheFirstLookLeavesOut) {
  folder.write("good.yaml", kCaterpillar + "actuator: {Kt: 0.0039895}\n");
  const Result first = call("test good.yaml --junit first.xml");
  const Result all = call("test good.yaml --all --junit all.xml");
  EXPECT_EQ(all.code, 4);
  EXPECT_EQ(all.out.find("--all"), std::string::npos) << all.out;
  expect_contains(all.out, "\n  number ");
  expect_contains(all.out, "\n  m1/passive torque RMS ");
  expect_contains(all.out, "\n  page: runs/test-2/good.failure.html\n  figure: runs/test-2/good.svg\n");
  std::smatch more;
  ASSERT_TRUE(std::regex_search(first.out, more, std::regex("  and ([0-9]+) more: --all shows them;"))) << first.out;
  // The output with --all has one more line per omitted row, and one additional line.
  EXPECT_EQ(lines(all.out), lines(first.out) + std::stoi(more[1]) + 1);
  EXPECT_EQ(std::regex_replace(without_times(read(folder / "all.xml")), std::regex("runs/test-2/"), "runs/test/"),
            without_times(read(folder / "first.xml")));
}

/// A changed verdict is reported, also if the run is within its bands. Older goldens contain no verdict, and nothing is
/// reported.
TEST_F(GoldenCommand, TellsAnotherVerdict) {
  Golden golden = read_golden(folder / "good.golden");
  folder.write("good.yaml", kCaterpillar + "limits: {tracking_error: 1e-6}\n");
  Result result = call("test good.yaml");
  EXPECT_EQ(result.code, 0);
  golden.verdict = Word::feasible;
  write_golden(golden, folder / "good.golden");
  result = call("test good.yaml");
  EXPECT_EQ(result.code, 0);
  expect_contains(result.err, "good.yaml: note: the verdict was feasible when it was approved, and is ");
  folder.write("good.yaml", kCaterpillar + "actuator: {Kt: 0.0039895}\n");
  result = call("test good.yaml");
  EXPECT_EQ(result.code, 4);
  expect_contains(result.out, "\n  actuator.Kt: 0.00395 -> 0.0039895\n  verdict: feasible -> not judged: ");
  expect_contains(read(folder / "runs/test/good.failure.html"), "\"verdict: feasible -> not judged: ");
  golden.verdict = Word::not_judged;
  write_golden(golden, folder / "good.golden");
  result = call("test good.yaml");
  EXPECT_EQ(result.code, 4);
  EXPECT_EQ(result.out.find("  verdict: "), std::string::npos) << result.out;
}

TEST_F(GoldenCommand, HalfTheStepIsNone) {
  folder.write("good.yaml", finer(kCaterpillar));
  const Result result = call("test good.yaml");
  EXPECT_EQ(result.code, 0) << result.out;  // by calibration, differences are at most a third of each band
}

TEST_F(GoldenCommand, AnotherScenarioWithAGivenGolden) {
  folder.write("stiff.yaml", kCaterpillar + "controller: {Kp: 102}\nname: stiff&<feet>\n");
  EXPECT_EQ(call("test stiff.yaml --golden good.golden").code, 2);  // the option requires a name, not a folder
  folder.write("stiff.yaml", kCaterpillar + "controller: {Kp: 102}\nname: stiff\n");
  Result result = call("test stiff.yaml --golden good.golden --out figures");
  EXPECT_EQ(result.code, 4);
  expect_contains(result.out, "\n  figure: figures/stiff.svg\n");
  expect_refused("test stiff.yaml --golden good.golden --out figures", "--out figures: error: exists and is not empty");
  expect_refused("test . --golden good.golden",
                 "--golden: error: is the golden of one scenario; name exactly one scenario with it");
  result = call("test stiff.yaml --golden no.golden");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "no.golden: error: there is no such golden; gaitlab approve makes it\n");
}

TEST_F(GoldenCommand, OtherTextSameRunIsANote) {
  folder.write("good.yaml", kCaterpillar + "name: renamed\n");
  const Result result = call("test good.yaml");
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "good.yaml: note: the resolved scenario has changed since the golden was approved\n");
}

TEST_F(GoldenCommand, OtherFormIsARegression) {
  folder.write("good.yaml", kCaterpillar + "trace: {period: 0.025}\n");
  Result result = call("test good.yaml");
  EXPECT_EQ(result.code, 4);
  expect_contains(result.out, "\n  a row every 0.025 s, in the golden every 0.02 s\n");
  std::string shorter = kCaterpillar;
  shorter.replace(shorter.find("0.1"), 3, "0.08");
  folder.write("good.yaml", shorter);
  result = call("test good.yaml");
  EXPECT_EQ(result.code, 4);
  expect_contains(result.out, "\n  5 rows, in the golden 6\n");
}

TEST_F(GoldenCommand, NoGolden) {
  folder.write("new.yaml", kCaterpillar);
  Result result = call("test new.yaml");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err,
            "new.yaml: error: has no golden (new.golden does not exist); make it: gaitlab approve new.yaml --reason TEXT\n");
  result = call("test good.yaml new.yaml");
  EXPECT_EQ(result.code, 2);
  expect_contains(result.out, "1 passed, 0 failed, 1 not tested\n");
  result = call("test . --junit result.xml");
  EXPECT_EQ(result.code, 0);
  expect_contains(result.out, "./new.yaml   -                       -  -                       -  skipped: no golden\n");
  expect_contains(result.out, "\n1 passed, 0 failed, 1 skipped\n");
  expect_contains(without_times(read(folder / "result.xml")),
                  "<testcase classname=\"golden\" name=\"./new.yaml\"><skipped message=\"no golden\"></skipped></testcase>\n");
  fs::remove_all(folder / "good.golden");
  result = call("test .");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "gaitlab: error: nothing was tested: no scenario has a golden; make one with gaitlab approve\n");
  expect_refused("test", "scenarios: error: there is no such scenario or folder");
  fs::create_directory(folder / "empty");
  expect_refused("test empty good.yaml", "empty: error: holds no scenario (*.yaml, *.yml)");
  folder.write("good.golden", "no folder");
  EXPECT_EQ(call("test good.yaml").err, "good.golden: error: is not a golden: a golden is a folder\n");
}

TEST_F(GoldenCommand, UnreadableGoldenOrScenarioIsNotTested) {
  folder.write("other.yaml", kCaterpillar + "name: good\n");  // the default name is the file name
  fs::copy(folder / "good.golden", folder / "other.golden");
  folder.write("good.golden/trace.golden", read(folder / "good.golden/trace.golden").substr(0, 500));
  Result result = call("test .");
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(result.err.starts_with("./good.golden/trace.golden: error: is truncated: 500 of ")) << result.err;
  expect_contains(result.out, "  NOT TESTED\n");
  expect_contains(result.out, "\n1 passed, 0 failed, 1 not tested\n");
  folder.write("other.yaml", kCaterpillar + "durtion: 1\n");
  result = call("test other.yaml");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "other.yaml:7:1: error: unknown key 'durtion'; did you mean 'duration'?\n");
}

TEST_F(GoldenCommand, ARunThatDiverges) {
  const std::string wild =
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.1\nactuator: {type: torque}\n"
      "controller: {type: hold, period: 0.05, command: {default: 0, m1/passive: 1e6}}\nphysics: {step: 2.5e-5}\n";
  folder.write("good.yaml", wild);
  Result result = call("test good.yaml");
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(result.err.starts_with("good.yaml: error: diverged at step 1, t = 2.5e-05 s: joint m1/passive turns at"));
  folder.write("wild.yaml", wild);
  result = call("approve wild.yaml --reason 'it flies'");
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(result.err.starts_with("gaitlab: error: wild.yaml: diverged at step 1, ")) << result.err;
  EXPECT_FALSE(fs::exists(folder / "wild.golden"));
}

TEST_F(GoldenCommand, Engines) {
  EXPECT_EQ(call("test good.yaml --engine bullet").code, 0);
  expect_refused("test good.yaml --engine bulet", "--engine: error: engine 'bulet' is unknown; did you mean 'bullet'?");
}

TEST_F(GoldenCommand, AFileThatCannotBeWrittenHidesNothing) {
  expect_refused("test good.yaml --junit no/where.xml",
                 "--junit no/where.xml: error: cannot be written: No such file or directory");
  const std::string before = bytes("good.golden");
  expect_refused(
      "test good.yaml --junit good.golden/golden.json",
      "--junit good.golden/golden.json: error: exists and is not XML, so it is not overwritten; expected another file");
  EXPECT_EQ(bytes("good.golden"), before);
  EXPECT_EQ(call("test good.yaml --junit ''").code, 2);
  expect_refused("test good.yaml --junit modules", "--junit modules: error: is a folder");
  folder.write("good.yaml", kCaterpillar + "actuator: {Kt: 0.0039895}\n");
  folder.write("runs", "a file");  // a file at the path of the figure's folder
  const Result result = call("test good.yaml");
  EXPECT_EQ(result.code, 4);
  expect_contains(result.out, "\n0 passed, 1 failed\n");
  expect_contains(result.err, "runs");
  const std::string command = "cd '" + folder.path().string() + "' && '" + std::string(gaitlab::test::build_folder()) +
                              "/bin/gaitlab' check good.yaml >/dev/full 2>full";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
  EXPECT_EQ(read(folder / "full").find("defect"), std::string::npos) << read(folder / "full");
  expect_contains(read(folder / "full"), "gaitlab: error: ");
}

TEST_F(GoldenCommand, LineEndsThatGitChanged) {
  std::string json = read(folder / "good.golden/golden.json");
  for (std::size_t at = json.find('\n'); at != std::string::npos; at = json.find('\n', at + 2)) json.replace(at, 1, "\r\n");
  folder.write("good.golden/golden.json", json);
  const Result result = call("test good.yaml");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err,
            "good.golden/golden.json: error: has other line ends than when it was written; `*.golden/** -text` in "
            ".gitattributes preserves them\n");
}

}  // namespace
}  // namespace gaitlab::test
