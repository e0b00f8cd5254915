#include "cpg/kuramoto_amplitude.h"

#include "core/math/functions.h"

namespace gaitlab::cpg {

const char* const KuramotoAmplitude::kManual =
    R"(Phase oscillators coupled in proportion to the amplitude of the followed joint; amplitude and offset of second order.

    phi_i' = 2 pi f_i + sum_j w_ij r_j sin(phi_j - phi_i + L_ij)
    r_i''  = a_r (a_r / 4 (R_i - r_i) - r_i')
    x_i''  = a_x (a_x / 4 (X_i - x_i) - x_i')
    theta_i = x_i + r_i sin(phi_i)

Critically damped: from rest r(t) = R (1 - (1 + a t / 2) exp(-a t / 2)), without overshoot. A joint of amplitude 0 pulls no
other. Start: on the limit cycle (if the lags contradict one another around a cycle: phi = 0 and a note), r = r' = 0, x = X.
The common keys are realised exactly; a lag settles with the rate w R. Stable for a h < 5.6 (h: cpg.step).
Reference: A. Crespi, A. J. Ijspeert, Online optimization of swimming and crawling in an amphibious snake robot, IEEE
Transactions on Robotics 24 (2008) 75-87; there theta = x + r cos(phi), a quarter period earlier.

    cpg: {type: kuramoto_amplitude, frequency: 0.25, amplitude: 0.6, phase_lag: 1.2, model: {amplitude_rate: 20}})";

void KuramotoAmplitudeModel::fields(Fields& f) {
  f.number("coupling", coupling, {"1/(rad s)", 0, 1000, "Weight w of the couplings made by a rule."});
  f.number("amplitude_rate", amplitude_rate, {"1/s", 0, 300, "a_r: rate at which r approaches the amplitude."});
  f.number("offset_rate", offset_rate, {"1/s", 0, 300, "a_x: rate at which x approaches the offset."});
}

KuramotoAmplitude::KuramotoAmplitude(const RobotInfo& robot, const Settings& settings)
    : OscillatorCpg(robot, settings, kBlocks) {}

void KuramotoAmplitude::start(Out state) const {
  for (std::size_t i = 0; i < joints_; ++i) {
    state[i] = network_.phases[i];
    state[joints_ + i] = state[2 * joints_ + i] = state[4 * joints_ + i] = 0;
    state[3 * joints_ + i] = s_.offset[i];
  }
}

void KuramotoAmplitude::derivative(const Measured&, In state, Out rate) const {
  const In phi = state.subspan(0, joints_);
  const In r = state.subspan(joints_, joints_);
  const In dr = state.subspan(2 * joints_, joints_);
  const In x = state.subspan(3 * joints_, joints_);
  const In dx = state.subspan(4 * joints_, joints_);
  const double ar = s_.model.amplitude_rate;
  const double ax = s_.model.offset_rate;
  for (std::size_t i = 0; i < joints_; ++i) {
    rate[i] = 2 * std::numbers::pi * s_.frequency[i];
    rate[joints_ + i] = dr[i];
    rate[2 * joints_ + i] = ar * (ar / 4 * (s_.amplitude[i] - r[i]) - dr[i]);
    rate[3 * joints_ + i] = dx[i];
    rate[4 * joints_ + i] = ax * (ax / 4 * (s_.offset[i] - x[i]) - dx[i]);
  }
  for (const Coupling& c : network_.couplings) {
    const auto from = static_cast<std::size_t>(c.from);
    const auto to = static_cast<std::size_t>(c.to);
    rate[to] += c.weight * r[from] * math::sin(phi[from] - phi[to] + c.phase_lag);
  }
}

SetPointTimes KuramotoAmplitude::times() const {
  constexpr double kSecondOrder = 5.8339;  // z with (1 + z) exp(-z) = 0.02
  const double a = s_.model.amplitude_rate;
  return {0, a > 0 ? 2 * kSecondOrder / a : 0};
}

void KuramotoAmplitude::output(double, In state, Out setpoint) const {
  for (std::size_t i = 0; i < joints_; ++i) {
    setpoint[i] = state[3 * joints_ + i] + state[joints_ + i] * math::sin(state[i]);
  }
}

}  // namespace gaitlab::cpg
