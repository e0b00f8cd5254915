// Elliptic integral and elliptic functions by the arithmetic-geometric mean (Abramowitz and Stegun, 16.4 and 17.6).
#pragma once
#include <array>
#include <cmath>
#include <numbers>

namespace gaitlab::oracle {

/// Jacobi's elliptic functions sn, cn, dn of argument u and modulus k in [0, 1).
struct Jacobi {
  double sn, cn, dn;
};

/// Sequences a_i and c_i of the arithmetic-geometric mean of 1 and sqrt(1 - k^2). For every k below 1 - 1e-15, eight steps
/// converge to rounding errors.
struct Mean {
  static constexpr std::size_t kSteps = 8;
  std::array<double, kSteps + 1> a{}, c{};

  explicit Mean(double k) {
    double b = std::sqrt((1 - k) * (1 + k));
    a[0] = 1;
    c[0] = k;
    for (std::size_t i = 1; i <= kSteps; ++i) {
      a[i] = (a[i - 1] + b) / 2;
      c[i] = (a[i - 1] - b) / 2;
      b = std::sqrt(a[i - 1] * b);
    }
  }
};

/// Complete elliptic integral of the first kind, modulus k.
inline double elliptic_k(double k) { return std::numbers::pi / (2 * Mean(k).a.back()); }

inline Jacobi jacobi(double u, double k) {
  const Mean mean(k);
  double phi = std::ldexp(mean.a.back() * u, static_cast<int>(Mean::kSteps));
  for (std::size_t i = Mean::kSteps; i > 0; --i) {
    phi = (phi + std::asin(mean.c[i] / mean.a[i] * std::sin(phi))) / 2;
  }
  const double s = std::sin(phi);
  return {s, std::cos(phi), std::sqrt(1 - k * k * s * s)};
}

}  // namespace gaitlab::oracle
