// Energy ledger of one lane: the energies of every step, summed from the start.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab {

/// Energies in J, from t = 0. Every step adds power times h at the states at which the integrator evaluated the forces. The
/// residual is therefore the integration error, which is of the order of the step.
///     electrical = copper + gear + stored + contact + friction + stops + hinges + residual
struct Ledger {
  double electrical = 0;  ///< energy drawn: voltage * current, or torque * speed of a torque actuator
  double copper = 0;      ///< heat in the windings, R i^2
  double gear = 0;        ///< loss in the gear: electrical - copper - shaft; negative if eq. 2 creates energy (back-driven)
  double contact = 0;     ///< work done on the ground along its normal, which is damped or stored in contact springs
  double friction = 0;    ///< work done on the ground tangentially to its surface
  double stops = 0;       ///< work done on the hinge stops
  double stored = 0;      ///< kinetic and potential energy, including springs of passive hinges, minus the initial value
  double hinges = 0;      ///< loss in dampers and friction of passive hinges
  double dry = 0;         ///< loss in dry and viscous friction of driven joints

  [[nodiscard]] double residual() const {
    return electrical - copper - gear - stored - contact - friction - stops - hinges - dry;
  }

  static constexpr std::size_t kSums = 8;  ///< number of sums in the state of a simulation, in the order of `of`
  [[nodiscard]] static Ledger of(In sums, double stored) {
    return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], stored, sums[6], sums[7]};
  }
};

}  // namespace gaitlab
