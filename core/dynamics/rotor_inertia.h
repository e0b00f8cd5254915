// Reflected rotor inertias, for a dynamics algorithm without them.
#pragma once
#include <Eigen/Cholesky>

#include "core/dynamics/mass_matrix.h"
#include "core/plugin/fields.h"

namespace gaitlab {

/// Rotors behind gears add n^2 J to the diagonal of the mass matrix (their gyroscopic moments and the motion of their axes are
/// neglected, as usual for n >> 1): (M + J) a = f. From a_0 = M^-1 f, by any algorithm,
///     a = a_0 - (M + J)^-1 J a_0
/// by a Cholesky factor of M + J, which is positive definite even if joints carry no inertia. Each update costs O((6 +
/// joints)^3); only the constructor allocates.
class RotorInertia {
 public:
  /// `inertia`: n^2 J per joint, kg m^2.
  RotorInertia(const Robot& robot, Base base, In inertia);
  void update(const Kinematics& kinematics);
  /// a_0 in, a out.
  void add_to(Acceleration& acceleration);
  /// y = (M + J)^-1 f; 6 base entries (0 where the base cannot move), then the joints.
  void inverse_mass(In f, Out y);

 private:
  std::span<const std::size_t> base_;
  MassMatrix mass_;
  std::vector<double> inertia_;
  Eigen::MatrixXd sum_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd vector_;
};

}  // namespace gaitlab
