// Tests of convergence() with traces of a known order.
#include "core/recording/convergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gaitlab {
namespace {

/// Trace of u(h) = cos t + 0.1 h^p sin t with the step h and the order p.
Trace wave(double h, double order) {
  Trace trace{{{"t", "s", ""}, {"u", "m", ""}, {"still", "m", ""}}, {}};
  for (int k = 0; k <= 1000; ++k) {
    const double t = 0.01 * k;
    trace.values.insert(trace.values.end(), {t, std::cos(t) + 0.1 * std::pow(h, order) * std::sin(t), 1.0});
  }
  return trace;
}

std::vector<Trace> halved(double h, double order) { return {wave(h, order), wave(h / 2, order), wave(h / 4, order)}; }

TEST(Convergence, FindsOrderErrorAndTheStepThatIsGood) {
  for (const double order : {1.0, 2.0, 4.0}) {
    const std::vector<Trace> traces = halved(0.5, order);
    const std::vector<ConvergenceRow> rows = convergence(traces, {"u"});
    ASSERT_EQ(rows.size(), 1U);
    const ConvergenceRow& row = rows[0];
    double square = 0;
    for (int k = 0; k <= 1000; ++k) square += std::sin(0.01 * k) * std::sin(0.01 * k) / 1001;
    double peak = 0;
    for (std::size_t k = 0; k < traces[2].rows(); ++k) peak = std::max(peak, std::abs(traces[2].at(k, 1)));
    const double rms = 0.1 * std::sqrt(square) / peak;
    // The error is exactly C h^p, so that the tolerances are only for rounding errors.
    EXPECT_NEAR(row.order.value(), order, 1e-9);
    EXPECT_NEAR(row.error[0], rms * (std::pow(0.5, order) - std::pow(0.125, order)), 1e-12);
    EXPECT_NEAR(row.left, rms * std::pow(0.125, order), 1e-12);
    EXPECT_NEAR(row.step_for(0.01, 0.125).value(), std::pow(0.01 / rms, 1 / order), 1e-9);
  }
}

TEST(Convergence, SaysNothingOfWhatDoesNotMove) {
  const std::vector<Trace> traces = halved(0.5, 1);
  const std::vector<ConvergenceRow> rows = convergence(traces, {"st*"});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].error, (std::vector<double>{0, 0}));
  EXPECT_FALSE(rows[0].order);
  EXPECT_FALSE(rows[0].step_for(0.01, 0.125));
  EXPECT_TRUE(convergence(traces, {"no such column"}).empty());
}

TEST(Convergence, TwoStepsHaveNoOrder) {
  const std::vector<std::vector<double>> values{{1.1, 0}, {1, 0}};
  const ConvergenceRow row = convergence("x", values);
  EXPECT_NEAR(row.error[0], 0.1, 1e-12);
  EXPECT_FALSE(row.order);
}

// The rounding error of a column that should be 0 is compared with the magnitude of the columns that have the same unit.
TEST(Convergence, RoundingIsNoError) {
  std::vector<Trace> traces = halved(0.5, 1);
  for (std::size_t i = 0; i < traces.size(); ++i) {
    for (std::size_t k = 0; k < traces[i].rows(); ++k) traces[i].values[3 * k + 2] = 1e-15 * static_cast<double>((k + i) % 3);
  }
  // The rounding error is 2e-15 m, relative to 1e-9 of the 1 m of column `u`.
  EXPECT_LT(convergence(traces, {"still"})[0].error[0], 3e-6);
}

}  // namespace
}  // namespace gaitlab
