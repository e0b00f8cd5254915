// The DC motor behind its gear: pure functions with their slopes, elementwise over joints and lanes.
#pragma once
#include <algorithm>
#include <cmath>

namespace gaitlab {

/// i = (u - Ks n w) / R, |u| <= u_max, |i| <= i_max; T = eta Kt i n.  (eq. 1, 2; limits: the paper's text)
/// u V, w joint speed rad/s, i A, T N m on the joint. Inductance neglected, as in the paper.
struct DcMotor {
  double R, Kt, Ks, gear, efficiency, u_max, i_max;

  struct Effort {
    double torque;   ///< N m
    double slope;    ///< -dT/dw = eta Kt Ks n^2 / R, 0 while the current is limited; N m s/rad
    double current;  ///< A
    double voltage;  ///< at the terminals: R i + Ks n w, V
    int saturation;  ///< 0 none, 1 voltage, 2 current
  };

  [[nodiscard]] Effort operator()(double command, double speed) const {
    const double u = std::clamp(command, -u_max, u_max);
    const double emf = Ks * gear * speed;
    const double wanted = (u - emf) / R;
    const double current = std::clamp(wanted, -i_max, i_max);
    const bool limited = current != wanted;
    return {efficiency * Kt * current * gear, limited ? 0.0 : efficiency * Kt * Ks * gear * gear / R, current,
            limited ? R * current + emf : u,
            limited        ? 2
            : u != command ? 1
                           : 0};
  }
};

}  // namespace gaitlab
