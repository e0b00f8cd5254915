// The integrator of a CPG's states between control ticks.
#pragma once
#include <vector>

#include "core/plugin/cpg.h"

namespace gaitlab {

/// Classical Runge-Kutta of order 4 with a fixed sub-step; stable as far as h |lambda| < 2.8. Allocates at construction alone.
class CpgIntegrator {
 public:
  explicit CpgIntegrator(std::size_t states) : k_(4, std::vector<double>(states)), stage_(states) {}

  /// Takes `state` from t over `steps` sub-steps of h, s. measured(t): the inputs at t.
  template <class MeasuredAt>
  void advance(const Cpg& cpg, Out state, double t, std::int64_t steps, double h, const MeasuredAt& measured) {
    for (std::int64_t i = 0; i < steps && !state.empty(); ++i) {
      const auto slope = [&](double reach, In k, Out out) {
        const Measured m = measured(t + (static_cast<double>(i) + reach) * h);
        for (std::size_t j = 0; j < stage_.size(); ++j) stage_[j] = state[j] + (k.empty() ? 0 : reach * h * k[j]);
        cpg.derivative(m, stage_, out);
      };
      slope(0, {}, k_[0]);
      slope(0.5, k_[0], k_[1]);
      slope(0.5, k_[1], k_[2]);
      slope(1, k_[2], k_[3]);
      for (std::size_t j = 0; j < stage_.size(); ++j) state[j] += h / 6 * (k_[0][j] + 2 * (k_[1][j] + k_[2][j]) + k_[3][j]);
    }
  }

 private:
  std::vector<std::vector<double>> k_;
  std::vector<double> stage_;
};

}  // namespace gaitlab
