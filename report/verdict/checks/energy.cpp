// The checks `ledger`, `created` and `supply`: the energies of a run add up, and none comes from nowhere.
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

constexpr const char* kNoEnergies = "the folder contains only rows of the trace, but the energies need all steps";

/// Reason why energies are not judged. Empty if they are.
std::string no_energies(const CheckedRun& run) {
  return !run.driven() ? kUndriven : run.record.joints.empty() ? kNoEnergies : "";
}

const char* finer(const Scenario& s) {
  return s.physics.adapts() ? "take a smaller physics.accuracy" : "take a smaller physics.step";
}

void judge_ledger(const CheckedRun& run, Check& made) {
  if (left_open(made, no_energies(run))) return;
  take_limit(made, "energy_residual", &Limits::energy_residual, run);
  const double missing = std::abs(run.record.ledger.residual());
  made.value = residual_share(run.scenario, run.record);
  made.text = fmt::format("{} of the energy is unaccounted for", texts::percent(made.value));
  if (passes(made, made.limit)) return;
  made.text += fmt::format(": {:.3g} J, of {:.3g} J drawn", missing, std::abs(run.record.ledger.electrical));
  made.remedy = finer(run.scenario);
}

void judge_created(const CheckedRun& run, Check& made) {
  if (left_open(made, no_energies(run))) return;
  take_limit(made, "energy_created", &Limits::energy_created, run);
  made.value = created_share(run.scenario, run.record);
  const std::string remedy = passes(made, made.limit) ? "" : no_created_energy(run.scenario);
  made.text = fmt::format("gears that are driven backwards create {} of the energy (eq. 2){}{}", texts::percent(made.value),
                          remedy.empty() ? "" : "; ", remedy);
}

void judge_supply(const CheckedRun& run, Check& made) {
  if (left_open(made, no_energies(run))) return;
  double drawn = 0;  // J, energy drawn as in the cost of transport
  for (const JointStatistics& joint : run.record.joints) drawn += joint.electrical;
  const bool costs = run.scenario.robot->mass * run.scenario.physics.gravity.norm() * travelled(run.record).distance > 0;
  made.value = run.record.ledger.electrical;
  made.limit = 0;
  const bool gave = made.value < -least_energy(run.scenario) || (costs && drawn < 0);
  made.status = gave ? CheckStatus::warn : CheckStatus::pass;
  made.text = fmt::format("the motors draw {:.3g} J", made.value);
  if (!gave) return;
  made.text = fmt::format(
      "the motors gave {:.3g} J back to their supply instead of drawing any, so that the cost of transport is negative: the "
      "robot went down, or a motor makes energy",
      std::max(-made.value, -drawn));
  made.remedy = "check Kt, Ks and the efficiency of the motors";
}

}  // namespace

std::vector<CheckKind> checks::energy() {
  return {
      {"ledger", CheckGroup::trust, "", "Energy adds up",
       fmt::format("energy that is unaccounted for, relative to the energy drawn (or stored, or needed to lift the robot by "
                   "{}, if that is more)",
                   texts::length(kLifted)),
       "", fmt::format("above limits.energy_residual; above {} the verdict is not judged", texts::percent(kTrustedResidual)),
       CheckSpan::whole_run, "physics.step", kShorter, judge_ledger},
      {"created", CheckGroup::trust, "", "Gears create no energy",
       "energy that back-driven gears create (eq. 2), relative to the same energy as in check `ledger`", "",
       "above "
       "limits.energy_created",
       CheckSpan::whole_run, "actuator", "actuator.efficiency_model: directional", judge_created},
      {"supply", CheckGroup::trust, "J", "Motors draw energy", "energy drawn from the supply", "", "below 0",
       CheckSpan::whole_run, "actuator", "Kt, Ks and the efficiency of the motors", judge_supply, true}};
}

}  // namespace gaitlab::report
