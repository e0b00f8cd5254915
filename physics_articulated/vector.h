// Vectors of 3 and 3 x 3 matrices for a scalar type T (double or lanes). Eigen is not used, because it adds in another order if
// it can use packets, and a rollout must have the same bits alone and beside seven others.
#pragma once
#include "core/math/lanes.h"

namespace gaitlab::articulated {

template <class T>
struct Vec {
  T x = 0.0, y = 0.0, z = 0.0;

  friend Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec operator-(const Vec& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec operator*(const T& s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
  Vec& operator+=(const Vec& b) { return *this = *this + b; }
  Vec& operator-=(const Vec& b) { return *this = *this - b; }
};

template <class T>
T dot(const Vec<T>& a, const Vec<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Vec<T> cross(const Vec<T>& a, const Vec<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
using math::select;
template <class T>
Vec<T> select(const math::Mask<T>& mask, const Vec<T>& yes, const Vec<T>& no) {
  return {math::select(mask, yes.x, no.x), math::select(mask, yes.y, no.y), math::select(mask, yes.z, no.z)};
}

/// Returns from + share * (to - from) in the lanes `which`, exactly `to` if the share is 1, and `from` in the other lanes.
template <class V, class T>
V between(const math::Mask<T>& which, const T& share, const V& from, const V& to) {
  return select(which, select(share == T(1.0), to, from + share * (to - from)), from);
}

/// Matrix by columns: the axes of a frame.
template <class T>
struct Mat {
  Vec<T> x, y, z;

  friend Vec<T> operator*(const Mat& R, const Vec<T>& v) {
    return {R.x.x * v.x + R.y.x * v.y + R.z.x * v.z, R.x.y * v.x + R.y.y * v.y + R.z.y * v.z,
            R.x.z * v.x + R.y.z * v.y + R.z.z * v.z};
  }
  friend Mat operator*(const Mat& R, const Mat& b) { return {R * b.x, R * b.y, R * b.z}; }
};

/// Symmetric matrix.
template <class T>
struct Sym {
  T xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;

  friend Vec<T> operator*(const Sym& s, const Vec<T>& v) {
    return {s.xx * v.x + s.xy * v.y + s.xz * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z, s.xz * v.x + s.yz * v.y + s.zz * v.z};
  }
  Sym& operator+=(const Sym& b) { return *this = {xx + b.xx, yy + b.yy, zz + b.zz, xy + b.xy, xz + b.xz, yz + b.yz}; }
  /// Adds s a a^T.
  void add_square(const T& s, const Vec<T>& a) {
    const Vec<T> b = s * a;
    *this += Sym{b.x * a.x, b.y * a.y, b.z * a.z, b.x * a.y, b.x * a.z, b.y * a.z};
  }
};

/// Returns R s R^T.
template <class T>
Sym<T> turned(const Mat<T>& R, const Sym<T>& s) {
  const Vec<T> x = R * Vec<T>{s.xx, s.xy, s.xz};
  const Vec<T> y = R * Vec<T>{s.xy, s.yy, s.yz};
  const Vec<T> z = R * Vec<T>{s.xz, s.yz, s.zz};
  return {x.x * R.x.x + y.x * R.y.x + z.x * R.z.x, x.y * R.x.y + y.y * R.y.y + z.y * R.z.y,
          x.z * R.x.z + y.z * R.y.z + z.z * R.z.z, x.x * R.x.y + y.x * R.y.y + z.x * R.z.y,
          x.x * R.x.z + y.x * R.y.z + z.x * R.z.z, x.y * R.x.z + y.y * R.y.z + z.y * R.z.z};
}

/// Rotation matrix of a quaternion of any length but 0.
template <class T>
Mat<T> rotation(T w, T x, T y, T z) {
  const T s = 2.0 / (w * w + x * x + y * y + z * z);
  const T xx = s * x * x, yy = s * y * y, zz = s * z * z;
  const T xy = s * x * y, xz = s * x * z, yz = s * y * z;
  const T wx = s * w * x, wy = s * w * y, wz = s * w * z;
  return {{1.0 - (yy + zz), xy + wz, xz - wy}, {xy - wz, 1.0 - (xx + zz), yz + wx}, {xz + wy, yz - wx, 1.0 - (xx + yy)}};
}

}  // namespace gaitlab::articulated
