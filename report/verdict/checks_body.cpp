// Checks of the run, of motion, bodies and ground, and of whether the numbers are to be believed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"
#include "report/analysis/motors.h"
#include "report/analysis/row_statistics.h"
#include "report/verdict/checks.h"
#include "report/verdict/number_texts.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

std::string threshold(const char* key, double value, double preset) {
  return value == preset ? fmt::format("chosen (limits.{})", key) : fmt::format("limits.{} of the scenario", key);
}

namespace {

constexpr const char* kNoEnergies = "the folder holds rows only, and no energies of all steps";
constexpr const char* kNoFall = "judged of a floating base above a plane, with or without boxes";

void judge(Check& made, const char* key, double Limits::*member, const CheckedRun& run) {
  made.limit = run.limits().*member;
  made.source = threshold(key, made.limit, Limits().*member);
}

/// Why bodies cannot be judged, or which are not; empty: all are.
std::string no_bodies(const CheckedRun& run) {
  const std::size_t all = run.scenario.robot->bodies.size();
  if (run.scenario.contact.solver()) return "the solver of contact.law bullet keeps bodies apart and above the ground";
  if (run.overlaps.shaped == 0) return "no body has a shape, or the run has no poses";
  return run.overlaps.shaped == all ? "" : fmt::format(" ({} of {} bodies have a shape)", run.overlaps.shaped, all);
}

}  // namespace

namespace checks {

void outcome(const CheckedRun& run, Check& made) {
  made.value = run.record.simulated;
  made.limit = run.scenario.duration;
  made.status = run.record.outcome.done() ? CheckStatus::pass : CheckStatus::fail;
  made.text = run.record.outcome.done() ? "the run came to its end" : run.record.outcome.text();
}

void height(const CheckedRun& run, Check& made) {
  made.text = kNoFall;
  if (!run.fall) return;
  judge(made, "height", &Limits::height, run);
  made.value = run.fall->share();
  made.from = made.to = run.fall->lowest_time;
  made.status = made.value >= made.limit ? CheckStatus::pass : CheckStatus::fail;
  made.text = made.status == CheckStatus::pass
                  ? fmt::format("the centre of mass keeps at least {} of its height at the start", texts::percent(made.value))
                  : fmt::format("the centre of mass comes down to {} of its height at the start", texts::percent(made.value));
}

void tilt(const CheckedRun& run, Check& made) {
  made.text = kNoFall;
  if (!run.fall) return;
  judge(made, "tilt", &Limits::tilt, run);
  made.value = run.fall->tilt;
  made.from = made.to = run.fall->tilt_time;
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;
  made.text = fmt::format("the base tilts by up to {:.3g} rad from its start", made.value);
}

void tracking(const CheckedRun& run, Check& made) {
  made.text = run.unknown(kErrorPeak);
  if (!made.text.empty()) return;
  const std::vector<JudgedJoint>& joints = run.summary.judged.joints;
  const std::size_t worst = Judged::farthest(joints);
  judge(made, "tracking_error", &Limits::tracking_error, run);
  made.value = joints[worst].error_peak;
  made.status = graded(made.value, made.limit, 2 * made.limit);
  made.joint = run.joint(worst);
  made.joints =
      static_cast<std::size_t>(std::ranges::count_if(joints, [&](const JudgedJoint& j) { return j.error_peak > made.limit; }));
  made.from = made.to = joints[worst].error_peak_time;
  made.text = fmt::format("joint {} is up to {} rad from its set point", made.joint, texts::thousandths(made.value));
}

void stops(const CheckedRun& run, Check& made) {
  const std::vector<BeyondRange> joints = beyond_range(*run.scenario.robot, run.record);
  made.text = "neither statistics of all steps were recorded nor the angle of every joint";
  if (joints.empty() && !run.scenario.robot->joints.empty()) return;
  judge(made, "beyond_range", &Limits::beyond_range, run);
  made.value = 0;
  made.status = CheckStatus::pass;
  made.text = "no joint leaves its range";
  std::size_t farthest = 0;
  std::size_t longest = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    made.joints += joints[j].worst > 0 ? 1 : 0;
    if (joints[j].worst > joints[farthest].worst) farthest = j;
    if (joints[j].share > joints[longest].share) longest = j;
  }
  if (made.joints == 0) return;
  const bool far = joints[farthest].worst > made.limit;
  const double most = run.limits().beyond_range_share;
  const bool for_long = joints[longest].share > most;
  // The joint that decides: by its angle, or by its time where no angle does.
  const std::size_t worst = for_long && !far ? longest : farthest;
  made.value = joints[worst].worst;
  made.joint = run.joint(worst);
  made.status = far || for_long ? CheckStatus::fail : CheckStatus::warn;
  made.text = fmt::format("{} leave{} the range of the hinge, {} ", counted(made.joints, "joint"), made.joints == 1 ? "s" : "",
                          made.joint);
  made.text += worst == longest && for_long && !far
                   ? fmt::format("for {} of the run, more than {}, by up to {:.3g} rad", texts::percent(joints[worst].share),
                                 texts::percent(most), made.value)
                   : fmt::format("farthest: by {:.3g} rad, for {} of the run", made.value, texts::percent(joints[worst].share));
}

void collision(const CheckedRun& run, Check& made) {
  const std::string missing = no_bodies(run);
  made.text = missing;
  if (run.overlaps.shaped == 0) return;
  const std::optional<Collision>& found = run.overlaps.collision;
  judge(made, "collision", &Limits::collision, run);
  made.value = found ? found->depth : 0;
  made.status = graded(made.value, run.limits().touch, made.limit);
  made.text = "no two bodies are in one another (those on one hinge are not compared)" + missing;
  if (!found) return;
  made.from = found->time;
  made.text = fmt::format("{} of bodies pass{} through one another, deepest {} and {}", counted(found->pairs, "pair"),
                          found->pairs == 1 ? "es" : "", run.scenario.robot->bodies[found->deepest_first].name,
                          run.scenario.robot->bodies[found->deepest_second].name);
}

void battery(const CheckedRun&, Check& made) { made.text = "the module types state no battery"; }

void in_ground(const CheckedRun& run, Check& made) {
  const std::string missing = no_bodies(run);
  made.text = run.scenario.ground.kind == Ground::Kind::plane ? missing : "judged of a plane without boxes";
  if (run.overlaps.shaped == 0 || run.scenario.ground.kind != Ground::Kind::plane) return;
  const std::optional<Sunk>& found = run.overlaps.sunk;
  judge(made, "sink", &Limits::sink, run);
  made.value = found ? found->depth : 0;
  made.status = found ? CheckStatus::fail : CheckStatus::pass;
  made.text = "no body goes through the ground" + missing;
  if (!found) return;
  made.from = found->time;
  made.text =
      fmt::format("body {} goes {:.3g} mm into the ground", run.scenario.robot->bodies[found->body].name, 1000 * found->depth);
}

void torque_error(const CheckedRun& run, Check& made) {
  const TorqueError error = report::torque_error(run.record);
  made.text = "the error of the torques was not estimated in this run";
  if (!error.estimated) return;
  made.value = error.share;
  made.limit = torque_error_limit(run.scenario);
  made.source = "1 %, or physics.accuracy";
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;
  made.joint = run.joint(error.joint);
  made.text =
      fmt::format("the torque of joint {} is off by about {} of its peak", made.joint, texts::rough_percent(made.value));
}

void ledger(const CheckedRun& run, Check& made) {
  made.text = "nothing drives the joints";
  if (!run.driven()) return;
  made.text = kNoEnergies;
  if (run.record.joints.empty()) return;
  judge(made, "energy_residual", &Limits::energy_residual, run);
  made.value = std::abs(run.record.ledger.residual()) / energy_scale(run.scenario, run.record);
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;  // not a number: a warning
  made.text = fmt::format("{} of the energy is unaccounted for", texts::percent(made.value));
}

void created(const CheckedRun& run, Check& made) {
  made.text = "nothing drives the joints";
  if (!run.driven()) return;
  made.text = kNoEnergies;
  if (run.record.joints.empty()) return;
  judge(made, "energy_created", &Limits::energy_created, run);
  made.value = texts::created(run.record) / energy_scale(run.scenario, run.record);
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;  // not a number: a warning
  const std::string remedy = made.status == CheckStatus::warn ? no_created_energy(run.scenario) : "";
  made.text = fmt::format("gears that are driven backwards give {} of the energy too much (eq. 2){}{}",
                          texts::percent(made.value), remedy.empty() ? "" : "; ", remedy);
}

}  // namespace checks

}  // namespace gaitlab::report
