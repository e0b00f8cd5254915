// Conversions between vectors of Eigen and vectors of the recursion; not for code that runs in lanes.
#pragma once
#include "core/model/frames.h"
#include "physics_articulated/vector.h"

namespace gaitlab::articulated {

inline Vec<double> vec(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Mat<double> mat(const Mat3& m) { return {vec(m.col(0)), vec(m.col(1)), vec(m.col(2))}; }
inline Sym<double> sym(const Mat3& m) { return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)}; }
inline Vec3 vec3(const Vec<double>& v) { return {v.x, v.y, v.z}; }

}  // namespace gaitlab::articulated
