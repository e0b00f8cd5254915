// Reflected rotor inertias, added to the results of a dynamics algorithm that lacks them.
#pragma once
#include <Eigen/Cholesky>

#include "core/dynamics/mass_matrix.h"
#include "core/plugin/actuator.h"

namespace gaitlab {

/// True if the rotor of a motor has an inertia. `actuator` may be null.
bool has_rotors(const Actuator* actuator);

/// Reflected inertias of the motors of joints with play, kg m^2, from the actuator of several lanes. `actuator` may be null.
std::vector<double> rotors_beside(const Robot& robot, const Actuator* actuator, std::size_t lane, std::size_t lanes);

/// Rotors behind gears add n^2 J to the diagonal of the mass matrix: (M + J) a = f. Their gyroscopic moments and the motion of
/// their axes are neglected, as usual for n >> 1. Accelerations a_0 = M^-1 f, computed by any algorithm, are corrected to
///     a = a_0 - (M + J)^-1 J a_0
/// by a Cholesky factor of M + J, which is positive definite even if joints carry no inertia. Each update costs O((6 +
/// joints)^3). Only the constructor allocates.
class RotorInertia {
 public:
  /// `inertia` is n^2 J per joint, kg m^2. It is left out where a gear has play: such a rotor turns beside the robot.
  RotorInertia(const Robot& robot, Base base, In inertia);
  void update(const Kinematics& kinematics);
  /// Replaces a_0 by a.
  void add_to(Acceleration& acceleration);
  /// Computes y = (M + J)^-1 f. Both vectors have 6 entries of the base, then the joints. The base entries of y are 0 if the
  /// base cannot move.
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
