// Vectors, rotations and poses; world z up, SI units, angles in rad.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "core/math/functions.h"

namespace gaitlab {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;  ///< transforms body coordinates to world coordinates

/// View of the three numbers of v, for functions that take lists.
inline std::span<double> span_of(Vec3& v) { return {v.data(), 3}; }

/// Pose of a frame B in a frame A: p_A = R p_B + p.
struct Pose {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();

  friend Pose operator*(const Pose& a, const Pose& b) { return {a.R * b.R, a.R * b.p + a.p}; }
  friend Vec3 operator*(const Pose& a, const Vec3& p) { return a.R * p + a.p; }
  [[nodiscard]] Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// Right-hand turn by `angle` about the unit vector `axis`, as a quaternion.
inline Quat turn(const Vec3& axis, double angle) {
  const auto [s, c] = math::sincos(0.5 * angle);
  return {c, s * axis.x(), s * axis.y(), s * axis.z()};
}

/// Right-hand turn by the rotation vector `w` (axis times angle), as a quaternion.
inline Quat turn(const Vec3& w) {
  const double angle = w.norm();
  return angle > 0 ? turn(w / angle, angle) : Quat::Identity();
}

/// Rotation matrix Rz(yaw) Ry(pitch) Rx(roll). Its columns are the axes of the child in the parent frame.
inline Mat3 rpy(const Vec3& roll_pitch_yaw) {
  return (turn(Vec3::UnitZ(), roll_pitch_yaw.z()) * turn(Vec3::UnitY(), roll_pitch_yaw.y()) *
          turn(Vec3::UnitX(), roll_pitch_yaw.x()))
      .toRotationMatrix();
}

/// Inverse of rpy(), with pitch in [-pi/2, pi/2]. The result is exact to rounding also at a pitch of +-pi/2. Roll and yaw then
/// turn about the same axis, so that yaw is arbitrary and roll is the remaining rotation.
inline Vec3 to_rpy(const Mat3& R) {
  const double yaw = math::atan2(R(1, 0), R(0, 0));
  const auto [s, c] = math::sincos(yaw);
  return {math::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1)), math::atan2(-R(2, 0), c * R(0, 0) + s * R(1, 0)),
          yaw};
}

}  // namespace gaitlab
