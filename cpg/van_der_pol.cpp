#include "cpg/van_der_pol.h"

namespace gaitlab::cpg {
namespace {

class VanDerPolOscillator final : public Oscillator {
 public:
  explicit VanDerPolOscillator(double mu) : mu_(mu) {}
  [[nodiscard]] std::size_t states() const override { return 2; }
  [[nodiscard]] const char* state_name(std::size_t index) const override { return index == 0 ? "x" : "y"; }
  void start(Out x) const override {
    x[0] = 2;
    x[1] = 0;
  }
  void derivative(In x, Out rate) const override {
    rate[0] = x[1];
    rate[1] = mu_ * (1 - x[0] * x[0]) * x[1] - x[0];
  }
  [[nodiscard]] double output(In x) const override { return x[0]; }
  [[nodiscard]] Point point(In x) const override { return {x[0], x[1]}; }
  [[nodiscard]] double step() const override { return 2e-3; }  // gives the period for mu = 1 to 1e-10

 private:
  double mu_;
};

}  // namespace

const char* const VanDerPol::kManual =
    R"(Van der Pol oscillators: from a sine (mu near 0) to relaxation, slow creep and quick jumps (mu large).

    x_i' = p_i y_i                                      p_i = T / (2 pi) max(0, 2 pi f_i + sum_j w_ij sin(phi_j - phi_i + L_ij))
    y_i' = p_i (mu (1 - x_i^2) y_i - x_i)
    r_i' = a_r (R_i - r_i)
    theta_i = X_i + r_i x_i / A

T, A: period and peak of x on the limit cycle for p = 1 (mu = 1: 6.6632869, 2.0086), found by integration when the CPG is made.
phi_i: phase, the time since x rose through 0 as a share of the period, 2 pi in all, read from the angle of (x, y) by a table of
the limit cycle. So the common keys are realised exactly for every mu; a lag is a time, L / (2 pi) of the period. The coupling
(chosen) changes the pace and not the orbit; it can stop an oscillator, but not reverse it. Start: on the limit cycle at the
phases of the lags (if they contradict one another around a cycle: at phase 0, with a note), r = 0.
Accurate for f h T max(1, mu) <= 0.3, where h is cpg.step. Above this, RK4 first deviates and then diverges.
Reference: B. van der Pol, On relaxation-oscillations, Philosophical Magazine 2 (1926) 978-992.

    cpg: {type: van_der_pol, frequency: 0.25, amplitude: 0.6, phase_lag: 1.2, model: {mu: 1}})";

void VanDerPolModel::fields(Fields& f) {
  f.number("mu", mu, {"", 0.05, 5, "Nonlinearity; 0 gives a sine."});
  CycleNetwork::Model::fields(f);
}

VanDerPol::VanDerPol(const RobotInfo& robot, const Settings& settings)
    : CycleNetwork(robot, settings, settings.model, std::make_unique<VanDerPolOscillator>(settings.model.mu)) {}

}  // namespace gaitlab::cpg
