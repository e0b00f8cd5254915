// Tests of `gaitlab swap` with several scenarios, and of the files after a signal.
#include <nlohmann/json.hpp>

#include "tests/app/study_fixture.h"
#include "tests/folders.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;

class SwapMatrix : public StudyFixture {
 protected:
  SwapMatrix() {
    folder_.write("soft.yaml",
                  "gaitlab: 1\nname: soft\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncontact: {on: all}\n"
                  "physics: {engine: articulated}\ncpg: {type: sine, frequency: 0.3, amplitude: 0.1}\nduration: 3\n");
  }

  /// Calls the program, and sends a signal as soon as the folder `made` exists. The program must not inherit ignored signals,
  /// which a background job of a shell has.
  Result signalled(const std::string& arguments, const std::string& made, const std::string& signal) {
    folder_.write("call.sh", "env --default-signal=INT,HUP,TERM '" + std::string(gaitlab::test::build_folder()) +
                                 "/bin/gaitlab' " + arguments + " >out 2>err &\nwhile [ ! -d " + made +
                                 " ] && kill -0 $!; do sleep 0.01; done\nkill -" + signal + " $!\nwait $!\n");
    const int status = std::system(("cd '" + folder_.path().string() + "' && bash call.sh 2>/dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(folder_ / "out"), read(folder_ / "err")};
  }
};

TEST_F(SwapMatrix, IsATableOfCpgByScenario) {
  const Result result = call("swap two.yaml soft.yaml --cpg phase_oscillator,sine --out m -j 2");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')), "2 CPGs in 2 scenarios");
  EXPECT_TRUE(contains(result.out, "\ncpg              scenario        m/s     electr.      mech.  feasible\n")) << result.out;
  const std::size_t first = result.out.find("\nphase_oscillator two ");
  const std::size_t second = result.out.find("\nphase_oscillator soft ");
  const std::size_t third = result.out.find("\nsine             two ");
  const std::size_t fourth = result.out.find("\nsine             soft ");
  ASSERT_NE(fourth, std::string::npos) << result.out;
  EXPECT_TRUE(first < second && second < third && third < fourth) << result.out;
  EXPECT_TRUE(
      contains(result.out, "\nnumbers: m/swap.csv, swap.json\nof each scenario: m/NAME/overlay.svg, swap.csv, swap.json\n"))
      << result.out;

  const auto json = nlohmann::json::parse(read(folder_ / "m/swap.json"));
  ASSERT_EQ(call("run soft.yaml --no-report --set cpg.type=phase_oscillator --quiet --out r").code, 0);
  auto run = nlohmann::json::parse(read(folder_ / "r/summary.json"));
  const auto verdict = nlohmann::json::parse(read(folder_ / "r/verdict.json"));
  for (const char* key : {"wall_time", "real_time_factor"}) run.erase(key);
  auto cell = json.at("phase_oscillator").at("soft");
  EXPECT_EQ(cell.at("verdict"), verdict.at("verdict"));
  const std::string why = cell.at("why");
  cell.erase("verdict");
  cell.erase("why");
  EXPECT_EQ(cell, run);
  const bool feasible = verdict.at("verdict") == "feasible";
  EXPECT_EQ(why.empty(), feasible);
  EXPECT_TRUE(contains(result.out.substr(second, third - second), (feasible                                ? "  y"
                                                                   : verdict.at("verdict") == "infeasible" ? "  n  "
                                                                                                           : "  -  ") +
                                                                      why))
      << result.out;
  // The row contains the reason of the verdict.
  const std::string tense = json.at("sine").at("two").at("why");
  EXPECT_EQ(json.at("sine").at("two").at("verdict"), "not judged");
  EXPECT_FALSE(tense.empty());
  EXPECT_TRUE(contains(result.out, "  -  " + tense + "\n")) << result.out;

  const std::string csv = read(folder_ / "m/swap.csv");
  EXPECT_EQ(csv.substr(0, 30), "cpg,scenario,verdict,why,name,");
  EXPECT_TRUE(contains(csv, "\nsine,two,not judged,"));
  EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
  // The files of each scenario equal those of a swap with this scenario alone.
  ASSERT_EQ(call("swap soft.yaml --cpg phase_oscillator,sine --out alone").code, 0);
  for (const char* file : {"overlay.svg", "swap.csv", "swap.json"})
    EXPECT_EQ(read(folder_.path() / "m/soft" / file), read(folder_.path() / "alone" / file)) << file;
  ASSERT_EQ(call("swap two.yaml soft.yaml --cpg phase_oscillator,sine --out again").code, 0);
  for (const char* file : {"swap.csv", "swap.json", "two/overlay.svg"})
    EXPECT_EQ(read(folder_.path() / "m" / file), read(folder_.path() / "again" / file)) << file;
}

TEST_F(SwapMatrix, ARunThatBreaksOffKeepsItsRow) {
  folder_.write("wild.yaml",
                "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
                "cpg: {type: equations, model: {states: {phi: exp(700)*exp(700)}, output: phi}}\nduration: 0.2\n");
  folder_.write("mild.yaml",
                "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
                "cpg: {type: equations, model: {states: {phi: omega}, initial: {phi: phase}, output: 0.1*sin(phi)}}\n"
                "duration: 0.2\n");
  const Result result = call("swap wild.yaml mild.yaml --cpg equations --report --out m");
  EXPECT_EQ(result.code, 1) << result.err;
  const auto json = nlohmann::json::parse(read(folder_ / "m/swap.json")).at("equations");
  EXPECT_EQ(json.at("wild").at("verdict"), "failed");
  EXPECT_EQ(json.at("wild").at("why"), json.at("wild").at("outcome"));
  EXPECT_TRUE(json.at("wild").at("speed").is_null());
  EXPECT_EQ(json.at("mild").at("outcome"), "done");
  EXPECT_TRUE(contains(result.out, "  n  " + json.at("wild").at("why").get<std::string>())) << result.out;
  for (const char* page : {"m/wild/swap.html", "m/mild/equations.html"}) EXPECT_TRUE(fs::exists(folder_.path() / page)) << page;
}

TEST_F(SwapMatrix, WhatIsWrongIsToldOfAllAtOnce) {
  refused("swap two.yaml two.yaml --cpg sine", "two.yaml: error: has the same name, two, as two.yaml; expected another name:");
  folder_.write("taken.yaml", "gaitlab: 1\nname: swap.csv\nrobot: {modules: mtran}\nduration: 0.1\n");
  refused("swap two.yaml taken.yaml --cpg sine",
          "taken.yaml: error: its name, swap.csv, is also the name of an output file; expected another name:");
  refused("swap two.yaml soft.yaml --cpg sine,sine,hopff",
          "--cpg: error: names 'sine' twice\n--cpg: error: type 'hopff' is unknown; did you mean 'hopf'?");
  EXPECT_EQ(call("swap --cpg sine").code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "runs"));
}

/// A signal during a run of hours leaves no empty folder.
TEST_F(SwapMatrix, ASignalLeavesNoEmptyFolder) {
  const std::string options = " --cpg sine,hopf --set duration=100000 --seed 3 -j 2";
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const Result one = signalled("swap two.yaml" + options, "runs/swap-two", signal);
    EXPECT_EQ(one.code, 1) << signal;
    EXPECT_EQ(one.out, "");
    EXPECT_TRUE(one.err.starts_with("two.yaml: note: takes about ")) << one.err;
    EXPECT_TRUE(one.err.ends_with(
        "\ntwo.yaml: interrupted: nothing is written; run it again with\ngaitlab swap two.yaml --cpg sine,hopf --set "
        "duration=100000 --seed 3 -j 2\n"))
        << signal << one.err;
    EXPECT_FALSE(fs::exists(folder_ / "runs")) << signal;
  }
  const Result both = signalled("swap two.yaml soft.yaml --out m" + options, "m", "TERM");
  EXPECT_EQ(both.code, 1);
  EXPECT_TRUE(
      contains(both.err, "\ngaitlab swap two.yaml soft.yaml --cpg sine,hopf --set duration=100000 --seed 3 --out m -j 2\n"))
      << both.err;
  EXPECT_FALSE(fs::exists(folder_ / "m"));
}

/// A study that a signal stops can be continued, at any time after the creation of its folder.
TEST_F(SwapMatrix, ASweepThatIsStoppedGoesOn) {
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const std::string out = std::string("s") + signal;
    const std::string command = "sweep two.yaml --set duration=100000 --grid cpg.phase_lag=0.5:1.5:2 --quiet --out " + out;
    const Result stopped = signalled(command, out, signal);
    EXPECT_EQ(stopped.code, 1) << signal;
    EXPECT_TRUE(
        stopped.err.ends_with(" continue with\ngaitlab sweep two.yaml --grid cpg.phase_lag=0.5:1.5:2 --set duration=100000 "
                              "--out " +
                              out + "\n"))
        << stopped.err;
    EXPECT_TRUE(fs::exists(folder_.path() / out / "study.db")) << signal;
  }
}

}  // namespace
}  // namespace gaitlab::test
