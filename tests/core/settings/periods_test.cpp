#include "core/settings/periods.h"

#include <gtest/gtest.h>

#include "core/math/periods.h"
#include "tests/core/scenario/fakes.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

std::string check(const std::vector<Period>& periods, const Period& step) {
  Problems problems;
  check_periods(periods, step, {"s.yaml", 9, 1}, problems);
  return test::message_of([&] { problems.raise(); });
}

TEST(Periods, StepsThatFitAll) {
  EXPECT_EQ(fitting_steps({0.015, 0.005, 20}, 3e-5), (std::vector<double>{2.5e-5, 3.125e-5}));
  EXPECT_EQ(fitting_steps({0.015}, 7e-5), (std::vector<double>{6.25e-5, 7.5e-5}));
  EXPECT_EQ(fitting_steps({0.001}, 0.5), (std::vector<double>{0.001}));
  for (const double step : fitting_steps({0.015, 0.0123, 7}, 3.3e-5)) EXPECT_GT(math::whole_steps(0.0123, step), 0);
}

TEST(Periods, PeriodsThatFit) {
  EXPECT_EQ(fitting_periods(0.0151, 0.005), (std::vector<double>{0.015, 0.02}));
  EXPECT_EQ(fitting_periods(1e-5, 2.5e-5), (std::vector<double>{2.5e-5}));
}

TEST(Periods, NameBothValuesAndOfferWhatFits) {
  EXPECT_EQ(check({{"control period", 0.015}, {"duration", 20, SourceLocation{"s.yaml", 3, 11}}}, {"step", 2.5e-5}),
            test::kNoError);
  EXPECT_EQ(check({{"control period", 0.015}}, {"step", 7e-5, SourceLocation{"s.yaml", 4, 5}}),
            "s.yaml:4:5: error: control period 0.015 s is not a whole multiple of the step 7e-05 s (214.285714286 steps); "
            "steps that fit: 6.25e-05, 7.5e-05");
  EXPECT_EQ(check({{"control period", 0.01501, SourceLocation{"s.yaml", 2, 3}}}, {"step", 2.5e-5}),
            "s.yaml:2:3: error: control period 0.01501 s is not a whole multiple of the step 2.5e-05 s (600.4 steps); "
            "periods that fit: 0.015, 0.015025");
  EXPECT_EQ(check({{"control period", 0.015}}, {"step", 7e-5}).substr(0, 19), "s.yaml:9:1: error: ");
}

TEST(Periods, HostileValuesEnd) {
  for (const double a : {1e-9, 1e-3, 1.0, 3.3333333333, 1e6}) {
    for (const double b : {1e-9, 1.7e-9, 1e-3, 0.999999, 1e3}) check({{"a", a}, {"b", 0.1234567}}, {"step", b});
  }
}

}  // namespace
}  // namespace gaitlab
