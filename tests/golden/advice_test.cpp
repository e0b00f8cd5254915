// Tests of the advice on bands that are too wide. tests/app/approve_test.cpp shows that the advice for columns is effective.
#include "golden/advice.h"

#include <gtest/gtest.h>

namespace gaitlab::test {

using namespace golden;
namespace {

const Integrator kImplicit{"implicit", 1};
const Integrator kAdaptive{"adaptive", 0, true};

Scenario scenario_of(const Integrator& integrator) {
  Scenario scenario;
  scenario.file = "walk.yaml";
  scenario.physics.integrator = &integrator;
  return scenario;
}

/// Golden with these bands from halving the step, and with numbers of 0.5 N m.
Golden golden_of(const std::vector<double>& halving) {
  Golden golden;
  for (std::size_t i = 0; i < halving.size(); ++i) {
    golden.numbers.push_back({"m" + std::to_string(i) + "/active.torque.peak", "N m", 0.5});
    golden.number_bands.push_back({0, halving[i], 1e-6});
  }
  return golden;
}

TEST(WideNumbers, FivePercentIsNotWide) {
  EXPECT_EQ(golden::wide_numbers(golden_of({0.05, 0.001}), scenario_of(kImplicit)), "");
  EXPECT_EQ(golden::wide_number_names(golden_of({0.05, 0.001})), "");
}

TEST(WideNumbers, SaysWhatWouldPassWhyAndTheRemedy) {
  EXPECT_EQ(
      golden::wide_numbers(golden_of({0.001, 0.42}), scenario_of(kImplicit)),
      "walk.yaml: warning: the band of m1/active torque peak is 42 %: 0.71 N m would pass gaitlab test, although 0.5 N m was "
      "approved; half the step changes this number by 14 %, and the band is three times this change; take a smaller step\n");
  EXPECT_EQ(golden::wide_number_names(golden_of({0.001, 0.42})), "m1/active torque peak 42 %");
}

TEST(WideNumbers, APeakOfTheStartIsNamedAsOne) {
  Golden golden = golden_of({0.42});
  golden.numbers[0].at_start = 0.015;
  golden.numbers[0].value = -0.5;
  EXPECT_EQ(
      golden::wide_numbers(golden, scenario_of(kAdaptive)),
      "walk.yaml: warning: the band of m0/active torque peak is 42 %: -0.71 N m would pass gaitlab test, although -0.5 N m was "
      "approved; a tenth of physics.accuracy changes this number by 14 %, and the band is three times this change; make "
      "physics.accuracy smaller; the peak occurs at the start (t = 0.015 s), not in the gait: if the first set points are far "
      "from "
      "initial.angles, other initial angles may help\n");
}

TEST(WideNumbers, WhatGrowsFromRoundingNeedsAShorterRun) {
  Golden golden = golden_of({0.01});
  golden.number_bands[0].ensemble = 0.2;
  EXPECT_EQ(
      golden::wide_numbers(golden, scenario_of(kImplicit)),
      "walk.yaml: warning: the band of m0/active torque peak is 20 %: 0.6 N m would pass gaitlab test, although 0.5 N m was "
      "approved; starts that differ by 1e-7 rad change this number by 2 %, and the band is ten times this change; "
      "shorten the run, in which small differences grow\n");
}

TEST(WideNumbers, TheThreeWidestAreExplained) {
  const std::string text = golden::wide_numbers(golden_of({0.06, 0.3, 0.07, 0.2, 0.08}), scenario_of(kImplicit));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << text;
  EXPECT_LT(text.find("m1/"), text.find("m3/"));
  EXPECT_LT(text.find("m3/"), text.find("m4/"));
  EXPECT_TRUE(text.ends_with("\nwalk.yaml: warning: ... and 2 more numbers with bands above 5 %\n")) << text;
  EXPECT_EQ(golden::wide_number_names(golden_of({0.06, 0.3})), "m1/active torque peak 30 %, m0/active torque peak 6 %");
}

}  // namespace
}  // namespace gaitlab::test
