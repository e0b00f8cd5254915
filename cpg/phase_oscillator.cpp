#include "cpg/phase_oscillator.h"

#include <algorithm>
#include <array>

#include "core/math/functions.h"

namespace gaitlab::cpg {

namespace {

std::size_t at(std::int64_t joint) { return static_cast<std::size_t>(joint); }

}  // namespace

const char* const PhaseOscillator::kManual = R"(A network of phase oscillators with any coupling graph.

    phi_i' = 2 pi f_i + sum_j w_ij sin(phi_j - phi_i + L_ij)      (amplitude_weighted: w_ij r_j)
    r_i'   = a_r (R_i - r_i)
    x_i'   = a_x (X_i - x_i)
    theta_i = x_i + r_i sin(phi_i)

A coupling {from: j, to: i, weight: w, phase_lag: L} pulls phi_i towards phi_j + L (psi_ij = -L in the paper's symbols).
Start: on the limit cycle (sums of lags along the couplings; if they contradict one another around a cycle, phi = 0 and a
note), r = 0, x = X. Source: Chariot, Filippi, Verlinden 2012, eq. 7-10 and 16-19.

A wave along a chain of joints: {type: phase_oscillator, frequency: 0.25, amplitude: 0.6, phase_lag: 1.2}. Joints have values by
name, by pattern or by a group of the scenario, and couplings may be listed:

    cpg:
      type: phase_oscillator
      frequency: 0.5
      amplitude: {hips: 0.4, "*/passive": 0.25, m1/passive: 0.3}
      couplings:
        - {from: m0/active, to: m1/active, weight: 5, phase_lag: 3.1416}
        - {from: m0/active, to: m0/passive, weight: 5, phase_lag: -1.5708}
        - {from: m1/active, to: m1/passive, weight: 5, phase_lag: -1.5708}
    groups: {hips: "m[0-5]/active"})";

void PhaseOscillatorModel::fields(Fields& f) {
  f.number("coupling", coupling, {"1/s", 0, 1000, "Weight w of the couplings made by a rule."});
  f.number("amplitude_rate", amplitude_rate, {"1/s", 0, 1000, "a_r: rate at which r approaches the amplitude."});
  f.number("offset_rate", offset_rate, {"1/s", 0, 1000, "a_x: rate at which x approaches the offset."});
  f.flag("amplitude_weighted", amplitude_weighted,
         "Weight each coupling with the amplitude r_j of the joint that is followed.");
}

PhaseOscillator::PhaseOscillator(const RobotInfo& robot, const Settings& settings) : OscillatorCpg(robot, settings, kBlocks) {}

void PhaseOscillator::start(Out state) const {
  for (std::size_t i = 0; i < joints_; ++i) {
    state[i] = network_.phases[i];
    state[joints_ + i] = 0;
    state[2 * joints_ + i] = s_.offset[i];
  }
}

void PhaseOscillator::derivative(const Measured&, In state, Out rate) const {
  const In phi = state.subspan(0, joints_);
  const In r = state.subspan(joints_, joints_);
  const In x = state.subspan(2 * joints_, joints_);
  for (std::size_t i = 0; i < joints_; ++i) {
    rate[i] = 2 * std::numbers::pi * s_.frequency[i];
    rate[joints_ + i] = s_.model.amplitude_rate * (s_.amplitude[i] - r[i]);
    rate[2 * joints_ + i] = s_.model.offset_rate * (s_.offset[i] - x[i]);
  }
  std::array<double, 16> some;
  for (std::span<const Coupling> rest = network_.couplings; !rest.empty();) {
    const std::span<const Coupling> now = rest.first(std::min(rest.size(), some.size()));
    rest = rest.subspan(now.size());
    const std::span<double> sine = std::span(some).first(now.size());
    for (std::size_t k = 0; k < now.size(); ++k) sine[k] = phi[at(now[k].from)] - phi[at(now[k].to)] + now[k].phase_lag;
    math::sines(sine);
    for (std::size_t k = 0; k < now.size(); ++k) {
      const double weight = s_.model.amplitude_weighted ? now[k].weight * r[at(now[k].from)] : now[k].weight;
      rate[at(now[k].to)] += weight * sine[k];
    }
  }
}

void PhaseOscillator::output(double, In state, Out setpoint) const {
  std::ranges::copy(state.first(joints_), setpoint.begin());
  math::sines(setpoint.first(joints_));
  for (std::size_t i = 0; i < joints_; ++i) setpoint[i] = state[2 * joints_ + i] + state[joints_ + i] * setpoint[i];
}

}  // namespace gaitlab::cpg
