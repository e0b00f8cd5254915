// The accuracy of a run: the error of its torques, its steps, and the settings that improve them.
#pragma once
#include <string>
#include <vector>

#include "core/simulation/simulation.h"

namespace gaitlab::report {

/// Estimate (core/simulation/step_error.h) of how far the motor torques are off, RMS over the joint's largest, both at the
/// moments of the estimate, of the worst joint. A joint's peak counts as at least 2 % of the largest of all.
struct TorqueError {
  bool estimated = false;
  double share = 0;
  std::size_t joint = 0;
};
TorqueError torque_error(const Recording& record);
/// The same of each joint; empty where it was not estimated.
std::vector<double> torque_errors(const Recording& record);

/// What a gravity that differs by a share of itself does to the torques of a run, beyond torque_error_limit: nothing by 1e-6;
/// something by 1e-6 (in proportion to 1e-9), `ill`-conditioned; something by 1e-9, `chaotic`. unknown: it was not tried.
enum class Predictability { unknown, predictable, ill, chaotic };
Predictability predictability(const Scenario& scenario, const Recording& record);
/// How far the run parted from the rollout under that gravity.
const Parting& parting(const Scenario& scenario, const Recording& record);
/// `from t = 0.66 s on the motion is not predictable: gravity times 1 + 1e-9 changes the torque of joint m0/active by 49 %`.
std::string predictability_text(const Scenario& scenario, const Recording& record);

/// Share that torque_error may have: 1 %, or the accuracy that the scenario asks for, if that is more.
double torque_error_limit(const Scenario& scenario);

/// The setting that brings the torque error from `share` to 1 %: `physics.accuracy: 0.003`.
std::string torque_remedy(const Scenario& scenario, double share);

/// `step auto (at most 0.005 s), accuracy 1 %`, or `step 2.5e-05 s`.
std::string step_text(const Physics& physics);

/// What the summary says of the steps: their kind, the solves, the torque error.
std::string steps_text(const Scenario& scenario, const Recording& record);

/// Names of the numbers of a run, over all its steps, that are not finite: `energy.copper`, `torque_rms of m0/active`.
std::vector<std::string> not_finite(const Scenario& scenario, const Recording& record);

/// J, above 0: of lifting the robot by 1 mm; less is nothing.
double least_energy(const Scenario& scenario);

/// J: what a missing energy is measured by: drawn, or stored, or the least, whichever is more.
double energy_scale(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
