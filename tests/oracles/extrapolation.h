// Integrator of order 16 that is independent of the program's integrators: the extrapolated modified midpoint rule of Gragg,
// Bulirsch and Stoer (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.9).
#pragma once
#include <array>
#include <cstddef>

namespace gaitlab::oracle {

/// Solution of x' = rate(x) at time t after the state `x`, by `steps` equal steps.
template <std::size_t N, class Rate>
std::array<double, N> integrate(const Rate& rate, std::array<double, N> x, double t, int steps) {
  using State = std::array<double, N>;
  constexpr std::size_t kColumns = 8;
  const double h = t / steps;
  const auto moved = [](const State& from, double reach, const State& slope) {
    State to = from;
    for (std::size_t i = 0; i < N; ++i) to[i] += reach * slope[i];
    return to;
  };
  // Modified midpoint rule with n sub-steps, and with Gragg's smoothing at the end.
  const auto midpoint = [&](const State& from, int n) {
    const double sub = h / n;
    State before = from;
    State now = moved(from, sub, rate(from));
    for (int i = 1; i < n; ++i) {
      const State next = moved(before, 2 * sub, rate(now));
      before = now;
      now = next;
    }
    const State end = moved(now, sub, rate(now));
    for (std::size_t i = 0; i < N; ++i) now[i] = (before[i] + end[i]) / 2;
    return now;
  };
  for (int step = 0; step < steps; ++step) {
    std::array<State, kColumns> column;
    for (std::size_t j = 0; j < kColumns; ++j) {
      const double nj = 2.0 * static_cast<double>(j + 1);
      State fresh = midpoint(x, static_cast<int>(nj));
      for (std::size_t m = 1; m <= j; ++m) {
        const double ratio = nj / (2.0 * static_cast<double>(j - m + 1));
        const State old = column[m - 1];
        column[m - 1] = fresh;
        for (std::size_t i = 0; i < N; ++i) fresh[i] += (fresh[i] - old[i]) / (ratio * ratio - 1);
      }
      column[j] = fresh;
    }
    x = column[kColumns - 1];
  }
  return x;
}

}  // namespace gaitlab::oracle
