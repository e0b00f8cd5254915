// The physical pendulum against the elliptic integral.
#include "fixture.h"
#include "report/summary.h"

namespace gaitlab::test {
namespace {

/// Complete elliptic integral of the first kind by the arithmetic-geometric mean (Abramowitz and Stegun 17.6).
double elliptic_k(double k) {
  double a = 1;
  double b = std::sqrt(1 - k * k);
  for (int i = 0; i < 30; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::numbers::pi / (2 * a);
}

TEST(Pendulum, PeriodIsTheEllipticIntegral) {
  EXPECT_NEAR(elliptic_k(0.5), 1.6857503548125961, 1e-15);  // the oracle itself: Abramowitz and Stegun, table 17.1 (m = 0.25)
  const RunRecord record = run(shipped("pendulum.yaml"));
  const double period = 4 * elliptic_k(std::sin(0.5)) * std::sqrt(2.0 / (3 * 9.81));
  // Downward zero crossings of the angle; linear between rows 5 ms apart misses by less than (5 ms)^2 * curvature: 1e-6 s.
  std::vector<double> crossings;
  const Table table(record.trace);
  for (std::size_t row = 1; row < record.trace.rows(); ++row) {
    const double before = table.at(row - 1, "joint.0.angle");
    const double after = table.at(row, "joint.0.angle");
    if (before > 0 && after <= 0) crossings.push_back(table.at(row, "t") - 0.005 * after / (after - before));
  }
  ASSERT_GE(crossings.size(), 5U);
  EXPECT_NEAR((crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1), period, 1e-6);
}

TEST(Pendulum, EnergyIsKeptByRungeKutta) {
  const RunRecord record = run(shipped("pendulum.yaml"));
  const Table table(record.trace);
  const auto energy = [&](std::size_t row) { return table.at(row, "energy.kinetic") + table.at(row, "energy.potential"); };
  // Order 4 at 0.1 ms: below the rounding of 1e5 steps, 1e5 * 1e-16 * 10 J.
  for (std::size_t row = 0; row < record.trace.rows(); ++row) EXPECT_NEAR(energy(row), energy(0), 1e-10);
}

}  // namespace
}  // namespace gaitlab::test
