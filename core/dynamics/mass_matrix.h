// The generalised inertia of a robot, by the composite-rigid-body algorithm.
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/dynamics/inverse_dynamics.h"
#include "core/model/kinematics.h"

namespace gaitlab {

/// Entries of (velocity of the base frame's origin x y z, angular velocity x y z; world axes) in which the base can move: all,
/// none, or x, z and the turn about y. They precede the joints in every generalised vector.
std::span<const std::size_t> base_entries(Base base);

/// M(q) with M v' + c = f, v = (base entries, joint speeds), kg, kg m, kg m^2; symmetric, positive definite if every joint
/// carries some inertia. Featherstone, Rigid Body Dynamics Algorithms (2008), 6.2, in world axes about the origin of the base
/// frame, where composite inertias are added unchanged. Cost O(links * depth); update does not allocate.
class MassMatrix {
 public:
  MassMatrix(const Robot& robot, Base base);
  void update(const Kinematics& kinematics);
  [[nodiscard]] const Eigen::MatrixXd& matrix() const { return matrix_; }

 private:
  /// Inertia of a link with all links beyond it, about the origin of the base frame, world axes.
  struct Composite {
    double mass = 0;
    Vec3 first = Vec3::Zero();   ///< mass times COM, kg m
    Mat3 second = Mat3::Zero();  ///< inertia, kg m^2
  };
  /// Momentum of a composite that moves with angular velocity w and velocity v at the origin of the base frame.
  static Wrench momentum(const Composite& c, const Vec3& w, const Vec3& v);
  void put(Eigen::Index column, const Wrench& momentum);

  const Robot& robot_;
  std::span<const std::size_t> base_;
  std::vector<Composite> composites_;
  Eigen::MatrixXd matrix_;
};

/// Generalised force of an inverse dynamics, (base entries of the base wrench, joint torques): the f of a motion or, at zero
/// accelerations, the bias c: centrifugal and Coriolis terms, weight and external wrenches.
Eigen::VectorXd generalised_force(const InverseDynamics& dynamics, Base base);

}  // namespace gaitlab
