// The accuracy of a run: torque error, steps, predictability, and the settings that improve them.
#pragma once
#include <string>
#include <vector>

#include "core/simulation/simulation.h"

namespace gaitlab::report {

inline constexpr double kAccurate = 0.01;  ///< share of a torque's peak
inline constexpr double kLifted = 1e-3;    ///< m, height to which least_energy() lifts the robot

/// Estimated error of the motor torques of the worst joint: RMS error / largest torque of the joint, both from the instants of
/// the estimate (core/simulation/step_error.h). The largest torque of a joint counts as at least 2 % of the largest of all
/// joints.
struct TorqueError {
  bool estimated = false;
  double share = 0;
  std::size_t joint = 0;
};
TorqueError torque_error(const Recording& record);
/// Torque error of each joint, as a share of its largest torque; empty if it was not estimated.
std::vector<double> torque_errors(const Recording& record);

/// Sensitivity of the torques to a relative change of gravity. `chaotic`: a change of 1e-9 alters a torque by more than
/// predictability_limit. `ill` (ill-conditioned): a change of 1e-6 does so, computed in proportion from 1e-9. `predictable`:
/// neither change does so. `unknown`: not tested, or gravity has no effect on the torques.
enum class Predictability { unknown, predictable, ill, chaotic };
Predictability predictability(const Scenario& scenario, const Recording& record);
/// Difference between the run and the rollout with changed gravity that decided predictability().
const Parting& parting(const Scenario& scenario, const Recording& record);
/// Text `from t = 0.66 s on (joint m0/active) the motion is not predictable: gravity times 1 + 1e-9 changes the torques by 49 %
/// of their peak`.
std::string predictability_text(const Scenario& scenario, const Recording& record);
/// Text `1 + 1e-9` of a change of gravity, a power of ten.
std::string disturbed(double change);

/// Largest torque error without a warning: the accuracy that the scenario requests, or 1 % with a fixed step.
double torque_error_limit(const Scenario& scenario);
/// Largest change of the torques for which a motion is predictable: torque_error_limit, but at least 1 %.
double predictability_limit(const Scenario& scenario);

/// Setting that reduces the torque error from `share` to torque_error_limit, but at most 1 %, in the form of --set:
/// `physics.accuracy=0.003`. Empty if no setting does.
std::string finer_setting(const Scenario& scenario, double share);
/// The same as advice: `physics.accuracy: 0.003`.
std::string torque_remedy(const Scenario& scenario, double share);

/// Text `step auto (at most 0.005 s), accuracy 1 %`, or `step 2.5e-05 s`.
std::string step_text(const Physics& physics);

/// Text of the summary line `steps`: step, number of solves, torque error.
std::string steps_text(const Scenario& scenario, const Recording& record);

/// Names of the numbers of a run that are not finite: `energy.copper`, `torque_rms of m0/active`.
std::vector<std::string> not_finite(const Scenario& scenario, const Recording& record);

/// Energy that lifts the robot by 1 mm, J, greater than 0. Smaller energies are negligible.
double least_energy(const Scenario& scenario);

/// Energy to which the residual of the ledger is compared, J: the largest of energy drawn, energy stored, and least_energy.
double energy_scale(const Scenario& scenario, const Recording& record);
/// Magnitude of the residual of the ledger / energy_scale.
double residual_share(const Scenario& scenario, const Recording& record);
/// Energy that the gears create / energy_scale.
double created_share(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
