// Classical Runge-Kutta method of order 4: its constants, and its step for x' = f(t, x).
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gaitlab::math {

/// Computes x+ = x + h sum_i weight_i k_i, where k_1 = f(t, x) and k_(i+1) = f(t + reach_i h, x + reach_i h k_i). The method is
/// stable for h |lambda| < 2.8.
class RungeKutta {
 public:
  static constexpr std::array<double, 4> kWeight{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  static constexpr std::array<double, 4> kReach{0.5, 0.5, 1.0, 0.0};

  /// Only the constructor allocates.
  explicit RungeKutta(std::size_t numbers) : k_(4, std::vector<double>(numbers)), at_(numbers) {}

  /// Six times the weighted sum, in two orders of addition, whose results differ in the last bit.
  static double paired(double k1, double k2, double k3, double k4) { return k1 + 2 * (k2 + k3) + k4; }
  static double in_order(double k1, double k2, double k3, double k4) { return k1 + 2 * k2 + 2 * k3 + k4; }

  /// Advances x by a step h. slope(reach, at, out) computes f at time t + reach h and state `at`. `sum` is paired or in_order.
  template <class Slope, class Sum>
  void step(std::span<double> x, double h, const Slope& slope, const Sum& sum) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double reach = i == 0 ? 0 : kReach[i - 1];
      for (std::size_t j = 0; j < x.size(); ++j) at_[j] = x[j] + (i == 0 ? 0 : reach * h * k_[i - 1][j]);
      slope(reach, std::span<const double>(at_), std::span<double>(k_[i]));
    }
    for (std::size_t j = 0; j < x.size(); ++j) x[j] += h / 6 * sum(k_[0][j], k_[1][j], k_[2][j], k_[3][j]);
  }

 private:
  std::vector<std::vector<double>> k_;
  std::vector<double> at_;
};

}  // namespace gaitlab::math
