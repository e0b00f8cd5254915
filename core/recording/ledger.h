// The energy ledger of one lane: what every step applied, summed from the start.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab {

/// J, from t = 0. Every step adds power times h at the states where the integrator evaluated its forces, so that what is left
/// over is the integration's own error: of the order of the step.
///     electrical = copper + gear + stored + contact + friction + stops + hinges + residual
struct Ledger {
  double electrical = 0;  ///< drawn: voltage * current; a torque actuator's torque * speed
  double copper = 0;      ///< R i^2
  double gear = 0;        ///< what is left of electrical - copper - shaft; negative: created (eq. 2, back-driven)
  double contact = 0;     ///< work done on the ground along its normal: damped, and what the contacts' springs hold
  double friction = 0;    ///< work done on the ground along it
  double stops = 0;       ///< work done on the hinge stops
  double stored = 0;      ///< kinetic and potential energy, springs of passive hinges included, less that at the start
  double hinges = 0;      ///< lost in dampers and friction of passive hinges

  [[nodiscard]] double residual() const { return electrical - copper - gear - stored - contact - friction - stops - hinges; }

  static constexpr std::size_t kSums = 7;  ///< the entries that are sums, as `of` takes them: state of the simulation
  [[nodiscard]] static Ledger of(In sums, double stored) {
    return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], stored, sums[6]};
  }
};

}  // namespace gaitlab
