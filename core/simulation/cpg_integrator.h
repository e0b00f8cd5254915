// Integrator of the states of a CPG between control ticks.
#pragma once
#include <cstdint>

#include "core/math/runge_kutta.h"
#include "core/plugin/cpg.h"

namespace gaitlab {

/// Classical Runge-Kutta method of order 4 with a fixed sub-step h. It is stable for h |lambda| <= 2.8, where lambda is an
/// eigenvalue of the Jacobian of the CPG. Allocates only at construction.
class CpgIntegrator {
 public:
  explicit CpgIntegrator(std::size_t states) : method_(states) {}

  /// Advances `state` from time t by `steps` sub-steps of h (t and h in s). measured(t) returns the inputs at time t.
  template <class MeasuredAt>
  void advance(const Cpg& cpg, Out state, double t, std::int64_t steps, double h, const MeasuredAt& measured) {
    for (std::int64_t i = 0; i < steps && !state.empty(); ++i) {
      const auto slope = [&](double reach, In at, Out out) {
        const Measured m = measured(t + (static_cast<double>(i) + reach) * h);
        cpg.derivative(m, at, out);
      };
      method_.step(state, h, slope, math::RungeKutta::paired);
    }
  }

 private:
  math::RungeKutta method_;
};

}  // namespace gaitlab
