// Tests of `gaitlab swap`: the table, the figure, and refused arguments.
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "core/settings/wording.h"
#include "report/verdict/numbers/numbers.h"
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

/// Cells of a CSV text without quotes and without line breaks in cells.
std::vector<std::vector<std::string>> cells(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& row = rows.emplace_back(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') {
        quoted = !quoted;
      } else if (c == ',' && !quoted) {
        row.emplace_back();
      } else {
        row.back() += c;
      }
    }
  }
  return rows;
}

/// The output states the energy that gears create. With eq. 2 it reduces the cost of transport of a caterpillar by a tenth;
/// directional gears create no energy.
TEST_F(Swap, NamesTheEnergyThatGearsCreate) {
  const auto swapped = [&](const std::string& more) {
    return gaitlab("swap '" + kScenarios +
                       "caterpillar.yaml' --cpg sine,hopf --set physics.engine=articulated --set duration=4" + more,
                   folder / "")
        .out;
  };
  const std::string created = swapped("");
  for (const char* cpg : {"\nsine: the gears create ", "\nhopf: the gears create "})
    EXPECT_NE(created.find(cpg), std::string::npos) << created;
  EXPECT_EQ(swapped(" --set actuator.efficiency_model=directional").find("the gears create"), std::string::npos);
}

TEST_F(Swap, OneRowACpgAndAFigure) {
  const Result result = call("--cpg phase_oscillator,sine -j 2");
  EXPECT_EQ(result.code, 0) << result.err;
  // For other types the `model` of the scenario is dropped, and a note states this.
  EXPECT_NE(result.err.find("amplitude_rate"), std::string::npos) << result.err;
  const std::size_t phase = result.out.find("\nphase_oscillator ");
  const std::size_t sine = result.out.find("\nsine ");
  ASSERT_NE(phase, std::string::npos) << result.out;
  ASSERT_NE(sine, std::string::npos) << result.out;
  EXPECT_LT(phase, sine);
  EXPECT_NE(result.out.find("\nfigure: runs/swap-creep/overlay.svg\n"), std::string::npos) << result.out;
  const std::string figure = read(folder / "runs/swap-creep/overlay.svg");
  for (const char* part : {"creep under 2 CPGs", ">phase_oscillator<", ">sine<", "x of the centre of mass"})
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
  // The row of the diverged run contains its outcome and no numbers.
  const auto numbers = nlohmann::json::parse(read(folder / "runs/swap-wild/swap.json"));
  for (const auto& [key, value] : numbers["equations"].items()) {
    EXPECT_EQ(value.is_null(), key != "outcome") << key;
    EXPECT_TRUE(numbers["sine"].contains(key)) << key;
  }
  const std::string outcome = numbers["equations"]["outcome"];
  EXPECT_NE(outcome, "done");
  EXPECT_EQ(numbers["sine"]["outcome"], "done");
  const std::vector<std::vector<std::string>> table = cells(read(folder / "runs/swap-wild/swap.csv"));
  ASSERT_EQ(table.size(), 3U);
  for (std::size_t column = 1; column < table[0].size(); ++column)
    EXPECT_EQ(table[1][column], table[0][column] == "outcome" ? outcome : "") << table[0][column];
}

TEST_F(Swap, PagesAreWrittenWhereTheyAreAskedFor) {
  EXPECT_EQ(call("--cpg phase_oscillator,sine --out plain").code, 0);
  EXPECT_FALSE(fs::exists(folder / "plain/swap.html"));
  const Result result = call("--cpg phase_oscillator,sine --report --out one");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("\npages: one/swap.html, and one per CPG\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("; so far: 3 of 4 joints reach the limit of their voltage: first "), std::string::npos)
      << result.out;
  const std::string page = read(folder / "one/swap.html");
  for (const char* part :
       {"<a href=\"sine.html\">sine</a>", "<a href=\"phase_oscillator.html\">", "? not judged", "data:image/png;base64,"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("<script"), std::string::npos);
  // The page has one number per cell, no zero with a sign, the robot, and images of joints with whole pixels.
  EXPECT_FALSE(std::regex_search(page, std::regex("<td>[^<]*[0-9] +[0-9][^<]*</td>"))) << page;
  EXPECT_FALSE(std::regex_search(page, std::regex("[−+-]0\\.0+<"))) << page;
  EXPECT_NE(page.find("<img class=\"robot\""), std::string::npos);
  EXPECT_NE(page.find("<img width=\"240\" height=\"64\""), std::string::npos) << page;
  EXPECT_NE(read(folder / "one/sine.html").find("id=\"meta\""), std::string::npos);
  EXPECT_EQ(call("--cpg phase_oscillator,sine --report --out two -j 2").code, 0);
  for (const char* file : {"swap.html", "sine.html", "phase_oscillator.html"})
    EXPECT_EQ(read(folder.path() / "one" / file), read(folder.path() / "two" / file)) << file;
}

TEST_F(Swap, CsvAndJsonHoldTheNumbersOfARun) {
  const Result result = call("--cpg phase_oscillator,sine --out two");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("\nnumbers: two/swap.csv, swap.json\n"), std::string::npos) << result.out;
  ASSERT_EQ(gaitlab("run creep.yaml --set cpg.type=sine --quiet --out run", folder / "").code, 0);
  const auto json = nlohmann::ordered_json::parse(read(folder / "two/swap.json"));
  auto run = nlohmann::ordered_json::parse(read(folder / "run/summary.json"));
  for (const char* key : {"wall_time", "real_time_factor"}) EXPECT_EQ(run.erase(key), 1U) << key;
  EXPECT_EQ(json["sine"], run);
  EXPECT_EQ(json.begin().key(), "phase_oscillator");

  const std::vector<std::vector<std::string>> table = cells(read(folder / "two/swap.csv"));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table[0][0], "cpg");
  EXPECT_EQ(table[1][0], "phase_oscillator");
  EXPECT_EQ(table[2][0], "sine");
  std::size_t column = 1;
  for (const report::SummaryNumber& number : report::summary_numbers()) {
    const nlohmann::ordered_json::json_pointer at(number.pointer());
    if (number.of_joint != nullptr || number.clock) continue;
    const bool known = json["sine"].contains(at);  // an unknown group is null
    const nlohmann::ordered_json value = known ? json["sine"][at] : nlohmann::ordered_json();
    EXPECT_EQ(value.is_structured(), number.list && known) << number.key;
    if (number.list) continue;
    const std::string unit = number.unit;
    EXPECT_EQ(table[0].at(column), unit.empty() ? number.key : fmt::format("{} ({})", number.key, unit));
    const std::string text = value.is_null()           ? ""
                             : value.is_string()       ? value.get<std::string>()
                             : value.is_number_float() ? number_text(value)
                                                       : value.dump();
    EXPECT_EQ(table[2].at(column), text) << number.key;
    ++column;
  }
  EXPECT_EQ(table[0].size(), column);
}

TEST_F(Swap, EveryFileIsTheSameWithAnyNumberOfThreads) {
  ASSERT_EQ(call("--cpg phase_oscillator,sine,hopf --out one").code, 0);
  ASSERT_EQ(call("--cpg phase_oscillator,sine,hopf --out more -j 3").code, 0);
  for (const std::string file : {"overlay.svg", "swap.csv", "swap.json"})
    EXPECT_EQ(read(folder / ("one/" + file)), read(folder / ("more/" + file))) << file;
}

/// Curves that coincide are listed: `equations` and `sine` have equal set points up to rounding, `keyframes` others.
TEST_F(Swap, CurvesOnEachOtherAreNamed) {
  folder.write("twins.yaml",
               "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.3\n"
               "cpg: {type: equations, frequency: 1, amplitude: 0.4, phase_lag: 1.2,\n"
               "  model: {states: {phi: omega}, initial: {phi: phase}, output: amplitude*sin(phi)}}\n");
  const Result result = gaitlab("swap twins.yaml --cpg equations,hopf,sine", folder / "");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("\ncoincide within 0.5 % of their range: equations, sine (set point and torque of m"),
            std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find(", 0 to 0.3 s)\nfigure: "), std::string::npos) << result.out;
  const std::string figure = read(folder / "runs/swap-twins/overlay.svg");
  EXPECT_NE(figure.find("; coincide: equations, sine<"), std::string::npos);
  const Result apart = call("--cpg sine");
  EXPECT_EQ(apart.out.find("coincide"), std::string::npos) << apart.out;
}

}  // namespace
}  // namespace gaitlab::test
