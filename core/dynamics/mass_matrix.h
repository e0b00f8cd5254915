// Generalised inertia of a robot, by the composite-rigid-body algorithm.
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/dynamics/inverse_dynamics.h"
#include "core/model/kinematics.h"

namespace gaitlab {

/// Indices of the base entries in which the base can move: all six, none, or x, z and the rotation about y. The six entries are
/// the velocity x y z of the origin of the base frame and the angular velocity x y z, world axes. They precede the joints in
/// every generalised vector.
std::span<const std::size_t> base_entries(Base base);

/// Mass matrix M(q) in M v' + c = f, with v = (base entries, joint speeds); units kg, kg m, kg m^2. The matrix is symmetric,
/// and positive definite if every joint carries some inertia. The algorithm is from Featherstone, Rigid Body Dynamics
/// Algorithms (2008), 6.2, in world axes about the origin of the base frame, in which composite inertias are added unchanged.
/// The cost is O(links * depth). update() does not allocate.
class MassMatrix {
 public:
  MassMatrix(const Robot& robot, Base base);
  void update(const Kinematics& kinematics);
  [[nodiscard]] const Eigen::MatrixXd& matrix() const { return matrix_; }

 private:
  /// Inertia of a link and all links beyond it, about the origin of the base frame, world axes.
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

/// Generalised force from the results of an inverse dynamics: base entries of the base wrench, then joint torques. The force
/// for the accelerations of a motion is f. The force for zero accelerations is the bias c: centrifugal and Coriolis terms,
/// weight and external wrenches.
Eigen::VectorXd generalised_force(const InverseDynamics& dynamics, Base base);

}  // namespace gaitlab
