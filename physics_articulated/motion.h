// Integration of positions from velocities for a scalar type T. The state has the entries of StateLayout, SI.
#pragma once
#include <span>

#include "core/math/functions.h"
#include "core/simulation/state_layout.h"
#include "physics_articulated/vector.h"

namespace gaitlab::articulated {

/// Sets the orientation of `out` to the quaternion (w, v) times the orientation of x. `out` may be x.
template <class T>
void turn(std::span<const T> x, const T& w, const Vec<T>& v, std::span<T> out) {
  constexpr std::size_t o = StateLayout::kOrientation;
  const T& qw = x[o];  // `out` may be x: no entry is read after it is overwritten
  const Vec<T> q{x[o + 1], x[o + 2], x[o + 3]};
  const Vec<T> turned = w * q + qw * v + cross(v, q);
  out[o] = w * qw - dot(v, q);
  out[o + 1] = turned.x;
  out[o + 2] = turned.y;
  out[o + 3] = turned.z;
}

template <class T>
void normalise(std::span<T> x) {
  const auto q = x.subspan(StateLayout::kOrientation, 4);
  const T length = math::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (T& value : q) value = value / length;
}

/// q (+) h v: positions and angles are added, the orientation turns by the rotation vector h omega.
template <class T>
void drift(std::span<T> x, std::size_t joints, double h) {
  for (std::size_t i = 0; i < 3; ++i) x[i] = x[i] + h * x[StateLayout::kVelocity + i];
  for (std::size_t j = StateLayout::kAngles; j < StateLayout::kAngles + joints; ++j) x[j] = x[j] + h * x[j + joints];
  const std::size_t rotors = StateLayout::kAngles + 2 * joints;
  const std::size_t plays = (x.size() - rotors) / 2;
  for (std::size_t k = rotors; k < rotors + plays; ++k) x[k] = x[k] + h * x[k + plays];
  constexpr std::size_t w = StateLayout::kAngularVelocity;
  const Vec<T> omega{x[w], x[w + 1], x[w + 2]};
  const T rate = math::sqrt(dot(omega, omega));
  const auto [s, c] = math::sincos(0.5 * h * rate);
  turn<T>(x, c, (s / math::select(rate > T(0.0), rate, T(1.0))) * omega, x);
  normalise(x);
}

}  // namespace gaitlab::articulated
