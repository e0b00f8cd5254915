// Six-vectors in world axes about the origin of the base frame, so that inertias and forces are added unchanged.
#pragma once
#include "physics_articulated/vector.h"

namespace gaitlab::articulated {

/// Angular velocity w, and velocity v of the body at the origin; or the corresponding accelerations.
template <class T>
struct SpatialMotion {
  Vec<T> w, v;

  friend SpatialMotion operator+(const SpatialMotion& a, const SpatialMotion& b) { return {a.w + b.w, a.v + b.v}; }
  friend SpatialMotion operator*(const T& s, const SpatialMotion& a) { return {s * a.w, s * a.v}; }
  [[nodiscard]] Vec<T> at(const Vec<T>& x) const { return v + cross(w, x); }
};

/// Moment n about the origin, and force f.
template <class T>
struct Force {
  Vec<T> n, f;

  Force& operator+=(const Force& b) {
    n += b.n;
    f += b.f;
    return *this;
  }
  Force& operator-=(const Force& b) {
    n -= b.n;
    f -= b.f;
    return *this;
  }
};

template <class T>
T dot(const SpatialMotion<T>& m, const Force<T>& f) {
  return dot(m.w, f.n) + dot(m.v, f.f);
}
/// Time derivative of a motion m that moves with the velocity V.
template <class T>
SpatialMotion<T> cross(const SpatialMotion<T>& V, const SpatialMotion<T>& m) {
  return {cross(V.w, m.w), cross(V.w, m.v) + cross(V.v, m.w)};
}
template <class T>
Force<T> force_at(const Vec<T>& x, const Vec<T>& f) {
  return {cross(x, f), f};
}

/// Symmetric 6 x 6 inertia: n = A w + B v, f = B^T w + C v.
template <class T>
struct Inertia {
  Sym<T> A;
  Mat<T> B;
  Sym<T> C;

  friend Force<T> operator*(const Inertia& I, const SpatialMotion<T>& m) {
    return {I.A * m.w + I.B * m.v, Vec<T>{dot(I.B.x, m.w), dot(I.B.y, m.w), dot(I.B.z, m.w)} + I.C * m.v};
  }
  Inertia& operator+=(const Inertia& b) {
    A += b.A;
    B.x += b.B.x;
    B.y += b.B.y;
    B.z += b.B.z;
    C += b.C;
    return *this;
  }
  /// Adds s U U^T.
  void add_square(const T& s, const Force<T>& U) {
    A.add_square(s, U.n);
    const Vec<T> n = s * U.n;
    B.x += U.f.x * n;
    B.y += U.f.y * n;
    B.z += U.f.z * n;
    C.add_square(s, U.f);
  }
};

/// Inertia about the origin of a body with COM c, first moment h = m c and the inertia `about_com` about its COM.
template <class T>
Sym<T> about(const Vec<T>& c, const Vec<T>& h, Sym<T> about_com) {
  const T hc = dot(h, c);
  about_com += {hc - h.x * c.x, hc - h.y * c.y, hc - h.z * c.z, -h.x * c.y, -h.x * c.z, -h.y * c.z};
  return about_com;
}
template <class T>
Inertia<T> rigid(const T& mass, const Vec<T>& h, const Sym<T>& about_origin) {
  const T zero = 0.0;
  return {about_origin, {{zero, h.z, -h.y}, {-h.z, zero, h.x}, {h.y, -h.x, zero}}, {mass, mass, mass, zero, zero, zero}};
}

/// Inertia that has the effect of a force -G v(x) at the point x, where v(x) is the velocity of the point.
template <class T>
Inertia<T> resistance(const Vec<T>& x, const Sym<T>& G) {
  const Mat<T> W{cross(x, Vec<T>{G.xx, G.xy, G.xz}), cross(x, Vec<T>{G.xy, G.yy, G.yz}), cross(x, Vec<T>{G.xz, G.yz, G.zz})};
  const Vec<T> a = x.y * W.z - x.z * W.y;
  const Vec<T> b = x.z * W.x - x.x * W.z;
  const Vec<T> c = x.x * W.y - x.y * W.x;
  return {{a.x, b.y, c.z, b.x, c.x, c.y}, W, G};
}

}  // namespace gaitlab::articulated
