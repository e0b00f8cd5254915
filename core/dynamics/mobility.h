// Inverse inertia of a robot at its links and joints, by the articulated-body algorithm.
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/model/kinematics.h"

namespace gaitlab {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Accelerations of a robot at rest per unit of load, without gravity. M is the mass matrix of mass_matrix.h plus the
/// armatures.
struct Mobility {
  /// J M^-1 J^T per link, J the Jacobian of the link frame: (acceleration of its origin, angular acceleration) per (force,
  /// moment about the origin), world axes, SI. Zero for a link that cannot move.
  std::vector<Matrix6> links;
  /// Diagonal of M^-1 per joint: rad/s^2 per N m.
  std::vector<double> joints;

  /// Mean of the diagonal of J M^-1 J^T for the world point `x` of a link, 1/kg.
  [[nodiscard]] double at(std::size_t link, const Vec3& x, const Kinematics& kinematics) const;
};

/// The mobility in the pose of `kinematics`. With the articulated inertia I of a link (Featherstone, Rigid Body Dynamics
/// Algorithms, 2008, 7.3), the axis S of its joint, U = I S, D = S^T U + armature, and the transform X of motions from the
/// parent p to the link,
///     links[0] = I^-1 of the base, in the entries in which it can move
///     links[i] = S S^T / D + L X links[p] X^T L^T,   L = 1 - S U^T / D
///     joints[j] = 1 / D + U^T X links[p] X^T U / D^2,
/// a recursion from the base outwards as in Rodriguez, Jain, Kreutz-Delgado, Int. J. Robotics Research 10 (1991) 371. The cost
/// is O(links). `armature` contains the reflected rotor inertia of each joint, kg m^2. Every joint must carry some inertia.
Mobility mobility(const Robot& robot, Base base, const Kinematics& kinematics, std::span<const double> armature);

}  // namespace gaitlab
