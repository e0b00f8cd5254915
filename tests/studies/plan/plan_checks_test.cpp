// Checks of a study before its first run.
#include "studies/plan/plan_checks.h"

#include <gtest/gtest.h>

#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

/// Values that no run can have are refused before the first run. A value that is possible with some value of another parameter
/// is not refused.
TEST(PlanValues, AreTriedWithTheOtherValues) {
  const auto problems = [](const std::string& lines) -> std::string {
    try {
      const SmallStudy study(lines);
    } catch (const InputError& error) {
      std::string all;
      for (const Problem& one : error.problems()) all += fmt::format("{}:{}: {}\n", one.place.line, one.place.column, one.text);
      return all;
    }
    return "";
  };
  const std::string grid = "method: {type: grid}\n";
  // `model.duty_factor` is a key of hopf alone, and the scenario's own type is phase_oscillator.
  EXPECT_EQ(problems("parameters: {cpg.type: {values: [phase_oscillator, hopf]}, cpg.model.duty_factor: "
                     "{values: [0.5, 0.6]}}\n" +
                     grid),
            "");
  EXPECT_EQ(problems("parameters: {cpg.type: {values: [phase_oscillator, hopf]}, cpg.model.duty_factor: "
                     "{values: [0.5, 2]}}\n" +
                     grid),
            "3:98: duty_factor is 2; expected 0.05 to 0.95\n");
  EXPECT_EQ(problems("parameters: {cpg.type: {values: [phase_oscillator, hopff]}}\n" + grid),
            "3:52: type 'hopff' is unknown; did you mean 'hopf'?\n");
  EXPECT_EQ(problems("parameters: {cpg.tpye: {values: [phase_oscillator, hopf]}}\n" + grid),
            "3:14: unknown key 'tpye'; did you mean 'type'?\n");
  // The ends of ranges count as values of the other parameters. A phase lag must be within 100 rad, regardless of the other
  // values.
  EXPECT_EQ(problems("parameters: {cpg.phase_lag: {values: [1, 200]}, cpg.frequency: {low: 0.5, high: 1}}\nmethod: {type: "
                     "random}\nbudget: {runs: 4}\n"),
            "3:42: phase_lag is 200 rad; expected -100 to 100 rad; 200 degrees are 3.491 rad\n");
}

}  // namespace
}  // namespace gaitlab::test
