// The DC motor behind its gear: pure functions with their slopes, elementwise over joints and lanes.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/functions.h"

namespace gaitlab {

/// i = (u - Ks n w) / R, |u| <= u_max, |i| <= i_max; T = eta Kt i n.  (eq. 1, 2; limits: the paper's text)
/// u V, w joint speed rad/s, i A, T N m on the joint. Inductance neglected, as in the paper.
///
/// As printed, eq. 2 takes eta from the torque both ways: a joint that drives its motor then gets away with eta T instead of T
/// / eta, and the gear creates energy. `turn` > 0 makes it directional: T = eta^s Kt i n, s = w sign(i) / turn within [-1, 1],
/// so that eta acts while driving, 1 / eta while back-driven, and the gear's loss (1 - eta^s) Kt i n w is never negative. The
/// steps of torque at w = 0 would make any explicit method chatter; `turn` spreads it, as v_lim does for friction.
struct DcMotor {
  double R, Kt, Ks, gear, efficiency, u_max, i_max;
  double turn = 0;  ///< rad/s on the joint; 0: eq. 2 as printed

  struct Effort {
    double torque;   ///< N m
    double slope;    ///< -dT/dw >= 0, N m s/rad: eta Kt Ks n^2 / R, 0 while the current is limited; more within `turn`
    double current;  ///< A
    double voltage;  ///< at the terminals: R i + Ks n w, V
    int saturation;  ///< 0 none, 1 voltage, 2 current
  };

  [[nodiscard]] Effort operator()(double command, double speed) const { return at(command, speed, i_max); }
  /// Whatever current that takes.
  [[nodiscard]] Effort unlimited(double command, double speed) const {
    return at(command, speed, std::numeric_limits<double>::infinity());
  }

 private:
  [[nodiscard]] Effort at(double command, double speed, double largest) const {
    const double u = std::clamp(command, -u_max, u_max);
    const double emf = Ks * gear * speed;
    const double wanted = (u - emf) / R;
    const double current = std::clamp(wanted, -largest, largest);
    const bool limited = current != wanted;
    const double steep = limited ? 0.0 : Kt * Ks * gear * gear / R;
    const Share share = gear_share(current, speed);
    return {share.eta * Kt * current * gear, share.eta * steep + share.slope * Kt * std::abs(current) * gear, current,
            limited ? R * current + emf : u,
            limited        ? 2
            : u != command ? 1
                           : 0};
  }

  struct Share {
    double eta;    ///< T / (Kt i n)
    double slope;  ///< -d eta / d(w sign(i)), s/rad
  };
  [[nodiscard]] Share gear_share(double current, double speed) const {
    if (!(turn > 0)) return {efficiency, 0};
    const double along = (current < 0 ? -speed : speed) / turn;
    const double loss = math::log(efficiency);  // <= 0
    const double eta = math::exp(loss * std::clamp(along, -1.0, 1.0));
    return {eta, std::abs(along) < 1 ? -eta * loss / turn : 0.0};
  }
};

}  // namespace gaitlab
