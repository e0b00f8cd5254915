// Pendulum theta'' = -w^2 sin(theta), released from rest.
#pragma once
#include "tests/oracles/elliptic.h"

namespace gaitlab::oracle {

class Pendulum {
 public:
  /// Pendulum with angular frequency w of small swings, rad/s, and an amplitude between 0 and pi, rad.
  Pendulum(double w, double amplitude) : w_(w), k_(std::sin(amplitude / 2)) {}

  [[nodiscard]] double period() const { return 4 * elliptic_k(k_) / w_; }

  /// Angle theta = 2 asin(k cn/dn (w t)), rad.
  [[nodiscard]] double angle(double t) const {
    const Jacobi j = jacobi(w_ * t, k_);
    return 2 * std::asin(k_ * j.cn / j.dn);
  }

  /// Speed theta' = -2 w k sqrt(1 - k^2) sn/dn (w t), rad/s.
  [[nodiscard]] double speed(double t) const {
    const Jacobi j = jacobi(w_ * t, k_);
    return -2 * w_ * k_ * std::sqrt(1 - k_ * k_) * j.sn / j.dn;
  }

 private:
  double w_, k_;
};

}  // namespace gaitlab::oracle
