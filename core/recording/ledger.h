// The energy ledger of one lane: the energies of every step, summed from the start.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab {

/// Energies in J, from t = 0. Every step adds power times h at the states at which the integrator evaluated its forces, so that
/// the residual is the error of the integration: of the order of the step.
///     electrical = copper + gear + stored + contact + friction + stops + hinges + residual
struct Ledger {
  double electrical = 0;  ///< drawn: voltage * current; a torque actuator's torque * speed
  double copper = 0;      ///< R i^2
  double gear = 0;        ///< electrical - copper - shaft; negative: created (eq. 2, back-driven)
  double contact = 0;     ///< work done on the ground along its normal: damped, or stored in the contacts' springs
  double friction = 0;    ///< work done on the ground along its surface
  double stops = 0;       ///< work done on the hinge stops
  double stored = 0;      ///< kinetic and potential energy, springs of passive hinges included, minus the initial value
  double hinges = 0;      ///< lost in dampers and friction of passive hinges

  [[nodiscard]] double residual() const { return electrical - copper - gear - stored - contact - friction - stops - hinges; }

  static constexpr std::size_t kSums = 7;  ///< entries that are sums, in the order of `of`: part of the simulation's state
  [[nodiscard]] static Ledger of(In sums, double stored) {
    return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], stored, sums[6]};
  }
};

}  // namespace gaitlab
