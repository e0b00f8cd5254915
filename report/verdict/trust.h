// The accuracy of a run: the error of its torques, its steps, and the settings that improve them.
#pragma once
#include <string>
#include <vector>

#include "core/simulation/simulation.h"

namespace gaitlab::report {

/// Estimated error of the motor torques (core/simulation/step_error.h): RMS over the joint's largest torque, both at the
/// moments of the estimate, for the worst joint. A joint's peak counts as at least 2 % of the largest of all.
struct TorqueError {
  bool estimated = false;
  double share = 0;
  std::size_t joint = 0;
};
TorqueError torque_error(const Recording& record);
/// The same for each joint; empty: not estimated.
std::vector<double> torque_errors(const Recording& record);

/// Sensitivity of the torques to gravity, by changes beyond predictability_limit: predictable: none under a relative change of
/// 1e-6; `ill`-conditioned: under 1e-6 (computed in proportion from 1e-9); `chaotic`: under 1e-9. unknown: not tested, or
/// gravity changes no torque.
enum class Predictability { unknown, predictable, ill, chaotic };
Predictability predictability(const Scenario& scenario, const Recording& record);
/// Difference between the run and the rollout under that gravity.
const Parting& parting(const Scenario& scenario, const Recording& record);
/// `from t = 0.66 s on the motion is not predictable: gravity times 1 + 1e-9 changes the torque of joint m0/active by 49 %`.
std::string predictability_text(const Scenario& scenario, const Recording& record);

/// Largest share of torque_error without a warning: the accuracy that the scenario requests, 1 % by default.
double torque_error_limit(const Scenario& scenario);
/// Largest change of the torques of a predictable motion: the same, but at least 1 %.
double predictability_limit(const Scenario& scenario);

/// The setting that brings the torque error from `share` to that, or to 1 %: `physics.accuracy: 0.003`.
std::string torque_remedy(const Scenario& scenario, double share);

/// `step auto (at most 0.005 s), accuracy 1 %`, or `step 2.5e-05 s`.
std::string step_text(const Physics& physics);

/// Line of the summary on the steps: their kind, the solves, the torque error.
std::string steps_text(const Scenario& scenario, const Recording& record);

/// Names of the numbers of a run, over all its steps, that are not finite: `energy.copper`, `torque_rms of m0/active`.
std::vector<std::string> not_finite(const Scenario& scenario, const Recording& record);

/// Energy for lifting the robot by 1 mm, J, above 0; smaller energies do not count.
double least_energy(const Scenario& scenario);

/// Scale for missing energies, J: the largest of energy drawn, energy stored, and the least.
double energy_scale(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
