// Checks of the accuracy of a run: of its steps, torques and energies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"
#include "core/simulation/step_advice.h"
#include "report/analysis/motors.h"
#include "report/verdict/checks.h"
#include "report/verdict/number_texts.h"
#include "report/verdict/spread.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

constexpr double kTooLong = 0.01;  // share of the control ticks with too long a step above which the check warns
constexpr const char* kUndriven = "nothing drives the joints";
constexpr const char* kNoEnergies = "the folder contains only rows, and no energies of all steps";

/// Reason why energies are not judged. Empty if they are.
std::string no_energies(const CheckedRun& run) {
  return !run.driven() ? kUndriven : run.record.joints.empty() ? kNoEnergies : "";
}

/// Status `pass` up to `limit`, `warn` above and for NaN.
void warn_above(double limit, Check& made) { made.status = made.value <= limit ? CheckStatus::pass : CheckStatus::warn; }

const char* finer(const Scenario& s) {
  return s.physics.adapts() ? "take a smaller physics.accuracy" : "take a smaller physics.step";
}

}  // namespace

namespace checks {

void torque_error(const CheckedRun& run, Check& made) {
  const TorqueError error = report::torque_error(run.record);
  made.text = "the error of the torques was not estimated in this run";
  if (!error.estimated) return;
  made.value = error.share;
  made.limit = run.limits().most_torque_error();
  made.source = threshold("torque_error", run.limits().torque_error, Limits().torque_error);
  warn_above(std::min(torque_error_limit(run.scenario), made.limit), made);
  made.part = Part::joint;
  made.worst = run.joint(error.joint);
  made.text = fmt::format("the torque of joint {} is off by about {} of its peak, estimated from other steps{}", made.worst,
                          texts::rough_percent(made.value),
                          run.scenario.physics.adapts() ? "" : " in windows; `gaitlab converge` compares whole runs");
  if (made.status == CheckStatus::pass) return;
  const bool chaotic =
      predictability(run.scenario, run.record) == Predictability::chaotic;  // in a chaotic motion a shorter step does not help
  if (!chaotic) made.remedy = "take " + torque_remedy(run.scenario, error.share);
  const Parting& event = run.record.tally.event;
  if (event.time < 0) return;
  made.first = event.time;
  made.first_part = run.joint(event.joint);
}

void predictable(const CheckedRun& run, Check& made) {
  made.text = predictability_text(run.scenario, run.record);
  const Predictability found = predictability(run.scenario, run.record);
  if (found == Predictability::unknown) return;
  const Parting& apart = parting(run.scenario, run.record);
  made.value = apart.share;
  made.limit = predictability_limit(run.scenario);
  made.source = "physics.accuracy";
  warn_above(made.limit, made);
  if (made.status == CheckStatus::pass) return;
  made.part = Part::joint;
  made.worst = made.first_part = run.joint(apart.joint);
  made.from = made.to = made.first = apart.time;
  if (run.record.spread.rows() > 0) made.text += "; " + spread_text(run.record.spread);
  made.remedy = "judge several runs with other seeds or starts; no smaller step helps";
}

void ledger(const CheckedRun& run, Check& made) {
  made.text = no_energies(run);
  if (!made.text.empty()) return;
  made.limit = run.limits().energy_residual;
  made.source = threshold("energy_residual", made.limit, Limits().energy_residual);
  const double missing = std::abs(run.record.ledger.residual());
  made.value = residual_share(run.scenario, run.record);
  warn_above(made.limit, made);
  made.text = fmt::format("{} of the energy is unaccounted for", texts::percent(made.value));
  if (made.status == CheckStatus::pass) return;
  made.text += fmt::format(": {:.3g} J, of {:.3g} J drawn", missing, std::abs(run.record.ledger.electrical));
  made.remedy = finer(run.scenario);
}

void created(const CheckedRun& run, Check& made) {
  made.text = no_energies(run);
  if (!made.text.empty()) return;
  made.limit = run.limits().energy_created;
  made.source = threshold("energy_created", made.limit, Limits().energy_created);
  made.value = created_share(run.scenario, run.record);
  warn_above(made.limit, made);
  const std::string remedy = made.status == CheckStatus::warn ? no_created_energy(run.scenario) : "";
  made.text = fmt::format("gears that are driven backwards create {} of the energy (eq. 2){}{}", texts::percent(made.value),
                          remedy.empty() ? "" : "; ", remedy);
}

void supply(const CheckedRun& run, Check& made) {
  made.text = no_energies(run);
  if (!made.text.empty()) return;
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
      "the motors gave {:.3g} J back to their supply instead of drawing any, so that the cost of transport is "
      "negative: the robot went down, or a motor makes energy",
      std::max(-made.value, -drawn));
  made.remedy = "check Kt, Ks and the efficiency of the motors";
}

void step(const CheckedRun& run, Check& made) {
  const Recording& r = run.record;
  made.text = "no damping rate (lambda) was recorded";
  if (r.control_ticks == 0) return;
  made.value = run.summary.stability_share;
  made.limit = kTooLong;
  made.source = "chosen";
  warn_above(made.limit, made);
  made.text = fmt::format("the step is too long in {} of the control ticks", texts::percent(made.value));
  if (made.status == CheckStatus::pass) return;
  const auto contacts = contact_elements(*run.scenario.robot, run.scenario.contact.on);
  made.from = made.to = r.worst_time;
  made.text = fmt::format("in {} of the control ticks", texts::percent(made.value));
  made.remedy = step_advice(run.scenario, contacts, r.worst, fmt::format("at t = {:.2f} s", r.worst_time));
}

void coarse(const CheckedRun& run, Check& made) {
  made.text = "the integrator does not choose its steps by an accuracy";
  if (!run.scenario.physics.adapts() || !(run.record.simulated > 0)) return;
  made.value = run.record.tally.coarse / run.record.simulated;
  made.limit = kTrustedCoarse;
  made.source = "chosen";
  warn_above(made.limit, made);
  made.text = fmt::format("in {} of the time the shortest steps of the integrator did not reach the accuracy {}",
                          texts::rough_percent(made.value), texts::rough_percent(run.scenario.physics.accuracy));
  if (made.status == CheckStatus::pass) return;
  made.text += ": the result depends on the steps, and smaller steps may not change this";
  made.remedy = "look for joints without damping, or drives without bounds";
}

void law(const CheckedRun& run, Check& made) {
  made.text = kUndriven;
  if (!run.driven()) return;
  made.value = run.record.tally.off;
  made.limit = 0;
  warn_above(0, made);
  made.text = "every joint-step ends on the law of its motor and stop";
  if (made.status == CheckStatus::pass) return;
  made.text =
      fmt::format("{:.0f} joint-steps ended off the law of their motor or stop: the torques there are wrong", made.value);
  made.remedy = "the torque of the actuator must fall with the joint's speed";
}

}  // namespace checks

}  // namespace gaitlab::report
