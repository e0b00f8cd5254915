// Contact law, hinge stop and motors of gaitlab in the parameters of MuJoCo's constraints and actuators.
#pragma once
#include <string>
#include <vector>

#include "core/model/kinematics.h"
#include "core/scenario/scenario.h"
#include "interchange/robot_xml.h"

namespace gaitlab::interchange {

/// MuJoCo's estimate of the inertia at its constraints, 1 / A_0, computed once with all angles at 0: `body_invweight0` and
/// `dof_invweight0`. A_0 of a body is the mean of the diagonal of J M^-1 J^T at its centre of mass (translation), and A_0 of a
/// hinge the diagonal of M^-1. M contains the rotors.
struct InverseWeights {
  std::vector<double> bodies = {};  ///< 1/kg, per body; 0 for a body that cannot move
  std::vector<double> joints = {};  ///< 1/(kg m^2), per joint
};
InverseWeights inverse_weights(const Scenario& scenario, const std::vector<MotorLimits>& limits);

/// The contact law, linearised at the penetration p0 at which the robot stands: the force and the slopes there.
///
/// MuJoCo's constraint is f = (a_ref - a) / R with R = A_0 (1 - d) / d, and with the direct format of solref, a_ref = -(damping
/// v + stiffness r) / d (MuJoCo's documentation, Computation: constraint model, and Modeling: solver parameters). Therefore
///     f = (stiffness p + damping p') / ((1 - d) A_0) - m' a,   m' = d / ((1 - d) A_0).
/// With stiffness = (1 - d) A_0 Kn and damping = (1 - d) A_0 C, f is exactly the law's Kn p + C p', plus the inertia of a mass
/// m' at the contact while the contact lasts. A semi-implicit step of the law also has such a mass, m' = h C. d must not give a
/// smaller mass, because the step would otherwise be explicit. Friction has R / impratio, the same damping and no stiffness: it
/// is viscous with the slope impratio C up to f Fn, which is that of the law, f Fn / v_lim, if impratio is the ratio of the two
/// slopes at p0.
struct ContactLine {
  double depth = 0;      ///< p0, m
  double stiffness = 0;  ///< N/m, dFn/dp at p0
  double damping = 0;    ///< N s/m, C at p0
  double onset = 0;      ///< m, penetration at which the line begins; 0 for k = 1
  double impratio = 1;
};
ContactLine contact_line(const Scenario& scenario);

/// `solref` and the constant impedance of `solimp` for a spring and a damper on a constraint of the mobility A_0. The step is
/// that of MuJoCo, s.
struct DirectReference {
  double stiffness, damping;  ///< positive; written with a minus sign
  double impedance;           ///< d
};
DirectReference direct_reference(double stiffness, double damping, double mobility, double step);

/// Actuator of MuJoCo: torque = gain ctrl - stiffness q - damping w, within +-limit.
struct GainAndBias {
  double gain = 0;       ///< N m per unit of the control
  double stiffness = 0;  ///< N m/rad
  double damping = 0;    ///< N m s/rad
};
/// Drives of the joints, with the law of the motors linearised about rest, T = c u - B w. If the controller has
/// PositionGains, controls are set points, rad: u = Kp (ctrl - q) - Kd w. Otherwise controls are the motors' commands.
struct Drives {
  std::vector<GainAndBias> joints;  ///< empty without an actuator
  bool by_set_points = false;
  bool duty = false;        ///< true if the controller commands shares of the supply
  bool integral = false;    ///< true if a joint has Ki
  bool derivative = false;  ///< true if a joint has Kd
  std::string command_unit;
};
Drives drives(const Scenario& scenario);

}  // namespace gaitlab::interchange
