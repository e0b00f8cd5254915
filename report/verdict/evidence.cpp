#include "report/verdict/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/plugin/robot_info.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/change_section.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"
#include "report/analysis/cpg_alone.h"
#include "report/analysis/motion.h"
#include "report/analysis/motors.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/plausible/plausibility.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

constexpr double kRelative = 1e-9;  // tolerance for rounding
constexpr double kEstimate = 1e-3;  // share of a period, tolerance of an estimated period

/// True if a set point changes after `start`, s, by more than kMoves of its range.
bool moves(const std::vector<Series>& set_points, const Series& time, double start) {
  for (const Series& one : set_points) {
    double low = one[0];
    double high = low;
    double later_low = one.back();
    double later_high = later_low;
    for (std::size_t k = 0; k < one.size(); ++k) {
      low = std::min(low, one[k]);
      high = std::max(high, one[k]);
      if (time[k] < start) continue;
      later_low = std::min(later_low, one[k]);
      later_high = std::max(later_high, one[k]);
    }
    if (later_high - later_low > kMoves * (high - low)) return true;
  }
  return false;
}

std::string after(double start) { return start > 0 ? fmt::format(" after {:.3g} s", start) : ""; }

/// Judges the length of the judged window in periods.
void judge_length(const Recording& r, const Summary& summary, Evidence& made) {
  const MotionCycle& cycle = summary.limit_cycle;
  const double period = summary.gait.period;
  const double start = summary.gait.start;
  made.repeats = period > 0;
  if (cycle.found && cycle.error <= kSettled && summary.judged.periods > 0) {
    made.rests_on = fmt::format("{} of {:.4g} s", counted(summary.judged.periods, "period"), cycle.period);
    return;
  }
  if (!(period > 0)) {
    made.rests_on = fmt::format("the {:.3g} s of the run; the set points do not repeat", r.simulated);
    if (r.simulated < kLeastTime * (1 - kRelative)) {
      made.not_shown = {fmt::format("the run of {:.3g} s is shorter than the required {:g} s; take a longer duration",
                                    r.simulated, kLeastTime),
                        "duration", "", fmt::format("duration={:g}", kLeastTime)};
    }
    return;
  }
  const double left = r.simulated - start;
  const double held = left / period;
  made.rests_on = fmt::format("{:.3g} periods of {:.4g} s{}; the motion does not settle",
                              (summary.judged.to - summary.judged.from) / period, period, after(start));
  if (held >= kPeriodsNeeded * (1 - kEstimate)) return;
  const std::string needed = fmt::format("{:.4g}", start + kPeriodsNeeded * period);
  made.not_shown = {fmt::format("{:.3g} s{} contain only {:.2g} of the {:g} periods of {:.4g} s that a gait needs; take "
                                "duration: {}",
                                left, after(start), held, kPeriodsNeeded, period, needed),
                    "duration", "", "duration=" + needed};
}

/// Judges the motion that the set points show.
void judge_gait(const Scenario& s, const Recording& r, const Summary& summary, Evidence& made) {
  const std::vector<Series> asked = set_points(s, r);
  const bool driven = s.actuator.entry != nullptr && driven_joints(*s.robot) > 0;
  const double full = std::max(summary.gait.full_size, summary.gait.start);
  const double period = summary.gait.period;
  if (!made.not_shown.empty()) return;
  if (std::string growing = growth(s, r, summary.judged, summary.gait); !growing.empty()) {
    const double needed = summary.gait.full_size + kPeriodsNeeded * period;
    const bool later = summary.gait.full_size > r.simulated && std::isfinite(needed);
    made.not_shown = {std::move(growing), "cpg", "", later ? fmt::format("duration={:.4g}", needed) : ""};
  } else if (driven && !asked.empty() && !moves(asked, motion(r).t, full)) {
    const std::string cause =
        s.cpg.entry == nullptr ? "there is no cpg" : fmt::format("cpg {} moves no joint", s.cpg.entry->name);
    const bool warns = s.cpg.entry != nullptr && !moves(asked, motion(r).t, 0);  // no warning for a ramp that ends in a pose
    made.not_shown = {fmt::format("no set point changes{}: {}", after(full), cause), "cpg",
                      warns ? "check its frequency, amplitudes, frames or equations" : ""};
  }
}

/// Judges the support of the robot by the ground. Names of numbers that are not known are added to `unknown`.
void judge_support(const Scenario& s, const Summary& summary, Evidence& made, std::vector<std::string>& unknown) {
  if (s.base != Base::floating) return;
  if (!(s.physics.gravity.norm() > 0)) {
    made.not_borne = {"there is no gravity, so that no ground bears the robot", "physics.gravity",
                      "take physics.gravity, or base: fixed"};
  } else if (!s.ground.exists()) {
    made.not_borne = {"the robot falls freely: there is no ground", "ground.type", "take base: fixed, or a ground"};
  } else if (s.contact.model().element_forces && contact_elements(*s.robot, s.contact.on).empty()) {
    made.not_borne = {"the robot falls freely: no part of it touches the ground", "contact.on",
                      "take base: fixed, or contact.on: all"};
  }
  made.falls_freely = !made.not_borne.empty();
  if (made.falls_freely) return;
  const double share = summary.posture.borne_share;
  if (std::isnan(share))
    unknown.emplace_back("the ground's share of the weight");  // recordings do not contain the impulses of the solver
  if (share >= kBorne || std::isnan(share)) return;
  made.not_borne = {fmt::format("the ground carries {} of the weight on average, less than {}: the robot is not on it",
                                texts::percent(share), texts::percent(kBorne)),
                    "contact"};
}

/// Limits that the scenario changes, as `limits: torque_error 1 in the scenario, 0.05 by default`; empty if it changes none.
std::string changed_limits(const Limits& limits) {
  const SettingsNumbers given = SettingsNumbers::of(limits);
  const SettingsNumbers preset = SettingsNumbers::of(Limits());
  std::vector<std::string> changed;
  for (std::size_t k = 0; k < given.all().size(); ++k) {
    const SettingsNumbers::Found& one = given.all()[k];
    const double by_default = preset.all()[k].value.common;
    if (one.value.common == by_default) continue;
    changed.push_back(
        fmt::format("{} {} in the scenario, {:.4g} by default", one.key, with_unit(one.value.common, one.unit), by_default));
  }
  return changed.empty() ? "" : fmt::format("limits: {}", fmt::join(changed, "; "));
}

/// Sentence on the first driven joint whose motor creates energy.
std::string first_that_makes_energy(const Scenario& s) {
  if (s.actuator.entry == nullptr || s.robot->joints.empty()) return "";
  const std::unique_ptr<Actuator> actuator = make_motors(s);
  const DcMotor* const motors = actuator->dc_motors();
  std::string text;
  for (std::size_t j = 0; motors != nullptr && text.empty() && j < s.robot->joints.size(); ++j) {
    if (s.robot->joints[j].driven()) text = makes_energy(motors[j], s.robot->joints[j].name);
  }
  return text;
}

void judge_trust(const Scenario& s, const Recording& r, Evidence& made, std::vector<std::string>& unknown) {
  const TorqueError error = torque_error(r);
  const double residual = r.joints.empty() ? 0 : residual_share(s, r);
  const double coarse = s.physics.adapts() && r.simulated > 0 ? r.tally.coarse / r.simulated : 0;
  const bool driven = s.actuator.entry != nullptr && driven_joints(*s.robot) > 0;
  const bool chaotic = predictability(s, r) == Predictability::chaotic;
  const double most_error = s.limits.most_torque_error();
  if (made.not_trusted = {first_that_makes_energy(s), "actuator.Kt"}; !made.not_trusted.empty()) return;
  const char* const steps = s.physics.adapts() ? "physics.accuracy" : "physics.step";
  if (chaotic && r.spread.rows() == 0) {
    made.not_trusted = {predictability_text(s, r) + "; `gaitlab run` computes the spread of its numbers", "physics"};
  } else if (error.estimated && !std::isfinite(error.share)) {
    made.not_trusted = {fmt::format("the error of the torque of joint {} is not a number", s.robot->joints[error.joint].name),
                        steps};
  } else if (!chaotic && error.estimated && error.share > most_error) {  // in a chaotic motion the spread is decisive
    made.not_trusted = {fmt::format("the torque of joint {} is off by about {} of its peak, more than {}; take {}",
                                    s.robot->joints[error.joint].name, texts::rough_percent(error.share),
                                    texts::percent(most_error), torque_remedy(s, error.share)),
                        steps, "", finer_setting(s, error.share)};
    made.inexact = error.share <= kMostError && residual <= kTrustedResidual && coarse <= kTrustedCoarse;
  } else if (driven && !(residual <= kTrustedResidual)) {  // true also for NaN
    made.not_trusted = {fmt::format("{} of the energy is unaccounted for, more than {}; take a smaller {}",
                                    texts::percent(residual), texts::percent(kTrustedResidual), steps),
                        steps};
  } else if (coarse > kTrustedCoarse) {
    made.not_trusted = {fmt::format("in {} of the time the shortest steps do not reach the accuracy {}; look for joints "
                                    "without damping, or drives without bounds",
                                    texts::rough_percent(coarse), texts::rough_percent(s.physics.accuracy)),
                        steps};
  }
  if (!driven || error.estimated) return;
  if (s.physics.estimated_by_others) {
    unknown.emplace_back("the error of the torques, which the study estimates only at other points");
  } else if (s.physics.estimate == Estimate::off) {
    if (made.not_trusted.empty()) {
      made.not_trusted = {"the error of the torques is not estimated; take physics.estimate: full", "physics.estimate", "",
                          "physics.estimate=full"};
    }
  } else {
    unknown.emplace_back("the error of the torques");
  }
}

}  // namespace

std::string makes_energy(const DcMotor& m, const std::string& joint) {
  if (!(m.efficiency * m.Kt > (1 + kRelative) * m.Ks)) return "";
  return fmt::format("the motor of joint {} makes energy: efficiency x Kt {:.4g} N m/A exceeds Ks {:.4g} V s/rad; take Kt = Ks",
                     joint, m.efficiency * m.Kt, m.Ks);
}

Evidence evidence(const Scenario& s, const Recording& r, const Summary& summary) {
  Evidence made;
  std::vector<std::string> unknown;
  judge_length(r, summary, made);
  judge_gait(s, r, summary, made);
  judge_support(s, summary, made, unknown);
  judge_trust(s, r, made, unknown);
  if (!unknown.empty()) made.rests_on += fmt::format("; not known: {}", fmt::join(unknown, " and "));
  const Doubts stated = doubts(s);
  made.not_possible = {stated.refused, "robot"};
  made.conditions = changed_limits(s.limits);
  if (!stated.accepted.empty()) made.conditions += (made.conditions.empty() ? "" : "; ") + stated.accepted;
  return made;
}

}  // namespace gaitlab::report
