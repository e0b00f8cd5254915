// Analytical solutions for drives: a motor that accelerates an inertia, a hinge stop, the PID of the paper, phase locking.
#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace gaitlab::oracle {

/// Motor of eq. 1 and 2 at constant voltage u that accelerates an inertia J from rest. At the current limit the speed w is
/// proportional to time. Above the speed at which (u - Ks n w) / R = i_max, w approaches u / (Ks n) exponentially.
struct MotorSpinUp {
  double R, Kt, Ks, n, eta, i_max, u, J;

  [[nodiscard]] double limited_until_speed() const { return std::fmax(0, (u - R * i_max) / (Ks * n)); }
  [[nodiscard]] double limited_until() const { return limited_until_speed() * J / (eta * Kt * i_max * n); }
  [[nodiscard]] double slope() const { return eta * Kt * Ks * n * n / R; }
  [[nodiscard]] double speed(double t) const {
    if (t <= limited_until()) return eta * Kt * i_max * n / J * t;
    const double last = u / (Ks * n);
    return last + (limited_until_speed() - last) * std::exp(-(t - limited_until()) * slope() / J);
  }
};

/// Bounce of a free inertia J that meets a hinge stop at speed v: J x'' = -ks x - cs x' until this torque changes its sign.
struct StopBounce {
  double J, ks, cs;

  [[nodiscard]] double decay() const { return cs / (2 * J); }
  [[nodiscard]] double frequency() const { return std::sqrt(ks / J - decay() * decay()); }
  /// Duration of the contact, s. At its end ks x + cs x' = 0, hence tan(w t) = -cs w / (ks - cs decay).
  [[nodiscard]] double lasts() const {
    return (std::numbers::pi - std::atan(cs * frequency() / (ks - cs * decay()))) / frequency();
  }
  /// Depth x and speed x' at time t after the start of the contact, 0 <= t <= lasts().
  [[nodiscard]] std::array<double, 2> at(double t, double v) const {
    const double w = frequency();
    const double size = v * std::exp(-decay() * t);
    return {size * std::sin(w * t) / w, size * (std::cos(w * t) - decay() / w * std::sin(w * t))};
  }
};

/// PID of eq. 3-6 for one joint, in recursive form.
class TextbookPid {
 public:
  TextbookPid(double kp, double ki, double kd, double n, double ts) : kp_(kp), ki_(ki), kd_(kd), n_(n), ts_(ts) {}

  double operator()(double e) {
    if (ticks_++ > 0) {
      i_ = i_ + ki_ * ts_ * e_;
      d_ = (kd_ * d_ + kd_ * n_ * (e - e_)) / (kd_ + n_ * ts_);
    }
    e_ = e;
    return kp_ * e + i_ + d_;
  }

 private:
  double kp_, ki_, kd_, n_, ts_, i_ = 0, d_ = 0, e_ = 0;
  int ticks_ = 0;
};

/// PID of eq. 3-6 for one joint, solved for the command at tick k:
/// u_k = Kp e_k + Ki Ts sum_(i<k) e_i + Kd N / (Kd + N Ts) sum_(1<=i<=k) r^(k-i) (e_i - e_(i-1)), r = Kd / (Kd + N Ts).
/// The first sum omits ticks at which the magnitude of the command exceeds `limit` and the command has the sign of the error.
class PidSums {
 public:
  PidSums(double kp, double ki, double kd, double n, double ts, double limit)
      : kp_(kp), ki_(ki), kd_(kd), n_(n), ts_(ts), limit_(limit) {}

  double operator()(double e) {
    const double r = kd_ / (kd_ + n_ * ts_);
    double integral = 0;
    double derivative = 0;
    for (std::size_t i = 0; i < e_.size(); ++i) {
      if (!held(i)) integral += e_[i];
      derivative += std::pow(r, static_cast<double>(e_.size() - 1 - i)) * ((i + 1 < e_.size() ? e_[i + 1] : e) - e_[i]);
    }
    e_.push_back(e);
    u_.push_back(kp_ * e + ki_ * ts_ * integral + n_ * r * derivative);
    return u_.back();
  }
  /// True if the integral omits tick i.
  [[nodiscard]] bool held(std::size_t i) const {
    return std::fabs(u_[i]) > limit_ && std::signbit(u_[i]) == std::signbit(e_[i]);
  }

 private:
  double kp_, ki_, kd_, n_, ts_, limit_;
  std::vector<double> e_, u_;
};

/// Oscillator coupled with weight w to an oscillator whose frequency is higher by `detuning` < w, rad/s. The lag x in addition
/// to the lag of the coupling obeys x' = detuning - w sin(x). (Adler, Proceedings of the IRE 34, 1946.)
struct PhasePair {
  double w, detuning;

  [[nodiscard]] double locked() const { return std::asin(detuning / w); }
  [[nodiscard]] double decay() const { return std::sqrt(w * w - detuning * detuning); }
  /// Lag x(t) with x(0) = 0. With y = tan(x / 2) and y1 = tan(locked / 2), (y - y1) / (y - 1 / y1) decays as exp(-decay t).
  [[nodiscard]] double lag(double t) const {
    const double y = std::tan(locked() / 2);
    const double e = std::exp(-decay() * t);
    return 2 * std::atan(y * (1 - e) / (1 - y * y * e));
  }
};

}  // namespace gaitlab::oracle
