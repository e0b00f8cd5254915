// `gaitlab swap`: the table, the figure, and what it refuses.
#include <nlohmann/json.hpp>

#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

namespace fs = std::filesystem;

class Swap : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory_symlink(kScenarios + "modules", folder / "modules");
    folder.write("creep.yaml",
                 "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncontact: {on: all}\nduration: 0.2\n"
                 "cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.4, phase_lag: 1.2, model: {amplitude_rate: 5}}\n");
  }
  Result call(const std::string& arguments) { return gaitlab("swap creep.yaml " + arguments, folder / ""); }
  Folder folder;
};

TEST_F(Swap, OneRowACpgAndAFigure) {
  const Result result = call("--cpg phase_oscillator,sine -j 2");
  EXPECT_EQ(result.code, 0) << result.err;
  // The scenario's own model is dropped for another type, and told.
  EXPECT_NE(result.err.find("amplitude_rate"), std::string::npos) << result.err;
  const std::size_t phase = result.out.find("\nphase_oscillator ");
  const std::size_t sine = result.out.find("\nsine ");
  ASSERT_NE(phase, std::string::npos) << result.out;
  ASSERT_NE(sine, std::string::npos) << result.out;
  EXPECT_LT(phase, sine);
  EXPECT_NE(result.out.find("\nfigure: runs/swap-creep/overlay.svg\n"), std::string::npos) << result.out;
  const std::string figure = read(folder / "runs/swap-creep/overlay.svg");
  for (const char* part : {"creep under 2 CPGs", ">phase_oscillator<", ">sine<", "travel of the centre of mass along x"})
    EXPECT_NE(figure.find(part), std::string::npos) << part;

  const Result again = call("--cpg phase_oscillator,sine --out again");
  EXPECT_EQ(again.out.substr(0, again.out.find("figure:")), result.out.substr(0, result.out.find("figure:")));
  EXPECT_EQ(read(folder / "again/overlay.svg"), figure);
}

TEST_F(Swap, WhatIsSetOfTheModelIsForItsOwnTypeAlone) {
  const Result result = call("--cpg sine,phase_oscillator --set cpg.model.amplitude_rate=3");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("creep.yaml: note: sine: dropped --set cpg.model.amplitude_rate=3\n"), std::string::npos)
      << result.err;
}

TEST_F(Swap, TheNumbersAreThoseOfARun) {
  const Result table = call("--cpg sine --quiet");
  EXPECT_EQ(table.err, "");
  ASSERT_EQ(gaitlab("run creep.yaml --set cpg.type=sine --quiet --out run", folder / "").code, 0);
  const auto summary = nlohmann::json::parse(read(folder / "run/summary.json"));
  EXPECT_NE(table.out.find(fmt::format("{:+.4f}, {:+.4f}", summary["displacement"][0].get<double>(),
                                       summary["displacement"][1].get<double>())),
            std::string::npos)
      << table.out;
  const auto joint = summary["judged"]["joint"].get<std::string>();
  const double peak = summary["per_joint"][joint]["judged"]["torque"]["peak"];
  EXPECT_NE(table.out.find(fmt::format("{:.3f} {}", peak, joint)), std::string::npos) << table.out;
}

TEST_F(Swap, BadInputIsToldAtOnceAndNothingIsRun) {
  Result result = call("--cpg sin,sine,hopff,sine");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("'sin'"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("did you mean 'hopf'?"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--cpg: error: names 'sine' twice"), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(fs::exists(folder / "runs"));
  EXPECT_EQ(call("").code, 2);
  result = call("--cpg sine,,hopf");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "--cpg: error: has an empty name in 'sine,,hopf'; expected types with commas between\n");
  EXPECT_EQ(call("--cpg hopff,sine").err, "--cpg: error: type 'hopff' is unknown; did you mean 'hopf'?\n");
  EXPECT_EQ(gaitlab("swap --cpg sine creep.yaml --out first", folder / "").code, 0);
}

TEST_F(Swap, OneThatDivergesKeepsItsRow) {
  folder.write("wild.yaml",
               "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.2\n"
               "cpg: {type: equations, model: {states: {phi: exp(700)*exp(700)}, output: phi}}\n");
  const Result wild = gaitlab("swap wild.yaml --cpg equations,sine", folder / "");
  EXPECT_EQ(wild.code, 1) << wild.out << wild.err;
  EXPECT_NE(wild.out.find("\nequations "), std::string::npos) << wild.out;
  EXPECT_NE(wild.out.find("\nsine "), std::string::npos) << wild.out;
  EXPECT_TRUE(fs::exists(folder / "runs/swap-wild/overlay.svg"));
}

}  // namespace
}  // namespace gaitlab::test
