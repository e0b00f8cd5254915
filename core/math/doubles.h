// Scalar type of N doubles in one register, for code that is written once for one rollout and for N (core/math/lanes.h). Only
// files that are compiled for a processor with such registers may include this header. These files add sqrt, any and the
// functions of core/math/functions.h (physics_articulated/kernel_avx2.cpp).
#pragma once
#include "core/math/lanes.h"

namespace gaitlab::math {

/// Vector types of the compiler for N doubles and for the masks that result from comparing them.
template <std::size_t N>
struct Register;

template <std::size_t N>
struct Bools {
  typename Register<N>::Bools v{};
};

template <std::size_t N>
struct Doubles {
  using Vector = typename Register<N>::Vector;
  Vector v{};

  Doubles() = default;
  Doubles(double all) : v(all - Vector{}) {}  // NOLINT(google-explicit-constructor): a constant is the same in all lanes
  explicit Doubles(Vector values) : v(values) {}
  // Copying is not trivial, so that a struct of Doubles is copied register by register, not by a call or `rep movs`.
  Doubles(const Doubles& other) : v(other.v) {}  // NOLINT(modernize-use-equals-default)
  Doubles& operator=(const Doubles& other) {     // NOLINT(modernize-use-equals-default)
    v = other.v;
    return *this;
  }

  friend Doubles operator+(const Doubles& a, const Doubles& b) { return Doubles(a.v + b.v); }
  friend Doubles operator-(const Doubles& a, const Doubles& b) { return Doubles(a.v - b.v); }
  friend Doubles operator*(const Doubles& a, const Doubles& b) { return Doubles(a.v * b.v); }
  friend Doubles operator/(const Doubles& a, const Doubles& b) { return Doubles(a.v / b.v); }
  friend Doubles operator-(const Doubles& a) { return Doubles(-a.v); }
  friend Bools<N> operator<(const Doubles& a, const Doubles& b) { return {a.v < b.v}; }
  friend Bools<N> operator>(const Doubles& a, const Doubles& b) { return {a.v > b.v}; }
  friend Bools<N> operator<=(const Doubles& a, const Doubles& b) { return {a.v <= b.v}; }
  friend Bools<N> operator>=(const Doubles& a, const Doubles& b) { return {a.v >= b.v}; }
  friend Bools<N> operator==(const Doubles& a, const Doubles& b) { return {a.v == b.v}; }
};

template <std::size_t N>
Doubles<N> select(const Bools<N>& mask, const Doubles<N>& yes, const Doubles<N>& no) {
  return Doubles<N>(mask.v ? yes.v : no.v);
}
template <std::size_t N>
Bools<N> mask_and(const Bools<N>& a, const Bools<N>& b) {
  return {a.v & b.v};
}
template <std::size_t N>
Bools<N> mask_or(const Bools<N>& a, const Bools<N>& b) {
  return {a.v | b.v};
}
template <std::size_t N>
Bools<N> fresh(const Bools<N>& yes, const Bools<N>& already) {
  return {yes.v & ~already.v};
}
template <std::size_t N>
Doubles<N> abs(const Doubles<N>& x) {
  return Doubles<N>(x.v <= 0 ? 0 - x.v : x.v);  // +0 also for -0
}

}  // namespace gaitlab::math
