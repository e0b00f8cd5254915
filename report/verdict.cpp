#include "report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/scenario/wording.h"
#include "report/fall.h"
#include "report/load_checks.h"
#include "report/motors.h"
#include "report/number_texts.h"
#include "report/trust.h"
#include "report/warnings.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kCreated = 0.05;         // of what is drawn
constexpr double kDeepCollision = 0.002;  // m
constexpr double kBeyondRange = 0.01;     // rad

/// What every check reads.
struct Run {
  const Scenario& scenario;
  const Recording& record;
  const Summary& summary;
  const Overlaps& overlaps;

  [[nodiscard]] const std::string& joint(std::size_t j) const { return scenario.robot->joints[j].name; }
  [[nodiscard]] const Limits& limits() const { return scenario.limits; }
  /// Why what all steps did cannot be judged; empty: it can.
  [[nodiscard]] std::string no_steps() const {
    if (!driven()) return "nothing drives the joints";
    if (record.ticks.rows() > 1 && record.ticks.columns.size() == 1 + kTickColumns * record.joints.size()) return "";
    return "what all steps did was not recorded: the folder is of an older format, or the run ended at once";
  }
  [[nodiscard]] bool driven() const { return scenario.actuator.entry != nullptr && !record.joints.empty(); }
  /// s: rows of ticks up to so long after the start of the window are before it, as judge() has it.
  [[nodiscard]] double start() const {
    return summary.judged.from + std::max(1e-9, summary.judged.periods > 0 ? 1e-3 * summary.limit_cycle.period : 0.0);
  }
};

Check check(const char* id, const char* group, const char* unit) {
  return {id, group, CheckStatus::not_judged, kNone, kNone, unit, "", 0, kNone, kNone, ""};
}

Check not_judged(const char* id, const char* group, const char* unit, const char* why) {
  Check made = check(id, group, unit);
  made.text = why;
  return made;
}

CheckStatus graded(double value, double pass, double warn) {
  return value <= pass ? CheckStatus::pass : value <= warn ? CheckStatus::warn : CheckStatus::fail;
}

// ---- run

Check outcome(const Run& run) {
  Check made = check("outcome", "run", "s");
  made.value = run.record.simulated;
  made.limit = run.scenario.duration;
  made.status = run.record.outcome == "done" ? CheckStatus::pass : CheckStatus::fail;
  made.text = run.record.outcome == "done" ? "the run came to its end" : run.record.outcome;
  return made;
}

constexpr const char* kNoFall = "judged of a floating base above a plane, with or without boxes";

Check height(const Run& run) {
  const std::optional<Fall> found = fall(run.scenario, run.record);
  if (!found) return not_judged("fall", "run", "", kNoFall);
  Check made = check("fall", "run", "");
  made.value = found->share();
  made.limit = run.limits().height;
  made.from = made.to = found->lowest_time;
  made.status = made.value >= made.limit ? CheckStatus::pass : CheckStatus::fail;
  made.text = fmt::format("the centre of mass keeps at least {} of its height at the start", texts::percent(made.value));
  return made;
}

Check tilt(const Run& run) {
  const std::optional<Fall> found = fall(run.scenario, run.record);
  if (!found) return not_judged("tilt", "run", "rad", kNoFall);
  Check made = check("tilt", "run", "rad");
  made.value = found->tilt;
  made.limit = run.limits().tilt;
  made.from = made.to = found->tilt_time;
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;
  made.text = fmt::format("the base tilts by up to {:.3g} rad from its start", made.value);
  return made;
}

// ---- motor

struct Span {
  double from = 0, to = 0;
  [[nodiscard]] double length() const { return to - from; }
};

/// The longest stretch after `start` that a joint may have been at the limit without a break: rows of ticks that were so all
/// the while, and the parts of the rows before and after them. A row that was partly at the limit, in how many pieces nobody
/// knows, counts as one piece at its end and one at its start.
Span longest_span(const Trace& ticks, std::size_t joint, TickColumn limited, double start) {
  constexpr double kAllTheWhile = 0.999;
  const Series t(ticks, 0);
  const Series at(ticks, 1 + joint * kTickColumns + limited);
  Span longest;
  Span now;
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (t[k] <= start) continue;
    const double part = at[k] - at[k - 1];
    if (now.to != t[k - 1]) now = {t[k - 1], t[k - 1]};
    now.to = t[k - 1] + part;
    if (part > kAllTheWhile * (t[k] - t[k - 1])) now.to = t[k];
    if (now.length() > longest.length()) longest = now;
    if (now.to != t[k]) now = {t[k] - part, t[k]};
    if (now.length() > longest.length()) longest = now;
  }
  return longest;
}

/// Who reports no voltage and no limit cannot be said to keep one.
std::string unstated(const Run& run, MotorLimit limit, double share) {
  if (share > 0 || !rest_torques(run.scenario).empty()) return "";
  if (limit == MotorLimit::voltage) return "the actuator is not made of DC motors, and states no voltage";
  return limited(run.scenario) ? "" : "the actuator states no limit";
}

Check saturation(const Run& run, const char* id, MotorLimit limit, TickColumn column, double JudgedJoint::*share) {
  Check made = check(id, "motor", "");
  made.text = run.no_steps();
  if (!made.text.empty()) return made;
  const Judged& judged = run.summary.judged;
  const double most = run.limits().saturated_periods * run.scenario.control_period;
  double stretch = 0;
  made.value = 0;
  CheckStatus status = CheckStatus::pass;
  for (std::size_t j = 0; j < judged.joints.size(); ++j) {
    const double part = judged.joints[j].*share;
    if (!(part > 0)) continue;
    ++made.joints;
    const Span span = longest_span(run.record.ticks, j, column, run.start());
    const bool fails = part > run.limits().saturated_share || span.length() > most * (1 + 1e-6);
    const CheckStatus of_joint = fails ? CheckStatus::fail : CheckStatus::warn;
    if (std::pair(of_joint, part) <= std::pair(status, made.value)) continue;
    status = of_joint;
    made.value = part;
    made.joint = run.joint(j);
    made.from = span.from;
    made.to = span.to;
    stretch = span.length();
  }
  made.text = unstated(run, limit, made.value);
  if (!made.text.empty()) {
    made.value = kNone;
    return made;
  }
  made.status = status;
  made.limit = run.limits().saturated_share;
  const bool motors = !rest_torques(run.scenario).empty();
  const char* const name = !motors ? "actuator" : limit == MotorLimit::voltage ? "voltage" : "current";
  made.text =
      made.joints == 0
          ? fmt::format("no joint is at the limit of its {}", name)
          : fmt::format("{} of {} joints reach{} the limit of {} {}, {} longest: {} of the window, up to {:.3g} s on end",
                        made.joints, judged.joints.size(), made.joints == 1 ? "es" : "", made.joints == 1 ? "its" : "their",
                        name, made.joint, texts::percent(made.value), stretch);
  return made;
}

Check voltage(const Run& run) {
  return saturation(run, "voltage", MotorLimit::voltage, kVoltageLimited, &JudgedJoint::voltage_limited);
}
Check current(const Run& run) {
  return saturation(run, "current", MotorLimit::current, kCurrentLimited, &JudgedJoint::current_limited);
}

Check rest_torque(const Run& run) {
  const std::vector<double> rest = rest_torques(run.scenario);
  const std::vector<JudgedJoint>& joints = run.summary.judged.joints;
  Check made = check("rest_torque", "motor", "");
  made.text = run.no_steps();
  if (!made.text.empty()) return made;
  made.text = "the actuator is not made of DC motors";
  if (rest.size() != joints.size() || rest.empty()) return made;
  made.value = 0;
  made.limit = run.limits().margin;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!(rest[j] > 0)) continue;
    const double share = joints[j].torque_peak / rest[j];
    if (share > made.limit) ++made.joints;
    if (share <= kLarger * made.value) continue;
    made.value = share;
    made.joint = run.joint(j);
    made.from = made.to = joints[j].torque_peak_time;
  }
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;
  made.text = fmt::format("the largest torque is {} of what a motor has at rest", texts::percent(made.value));
  return made;
}

Check heat(const Run&) {
  return not_judged("heat", "motor", "A", "the module types state no continuous current and no thermal model of a motor");
}

Check gear(const Run&) { return not_judged("gear", "motor", "N m", "the module types state no ratings of a gear"); }

// ---- motion

Check tracking(const Run& run) {
  Check made = check("tracking", "motion", "rad");
  made.text = run.no_steps();
  if (!made.text.empty()) return made;
  const std::vector<JudgedJoint>& joints = run.summary.judged.joints;
  const std::size_t worst = Judged::farthest(joints);
  made.value = joints[worst].error_peak;
  made.limit = run.limits().tracking_error;
  made.status = graded(made.value, made.limit, 2 * made.limit);
  made.joint = run.joint(worst);
  made.joints =
      static_cast<std::size_t>(std::ranges::count_if(joints, [&](const JudgedJoint& j) { return j.error_peak > made.limit; }));
  made.from = made.to = joints[worst].error_peak_time;
  made.text = fmt::format("joint {} is up to {} rad from its set point", made.joint, texts::thousandths(made.value));
  return made;
}

Check stops(const Run& run) {
  Check made = check("stops", "motion", "rad");
  made.limit = kBeyondRange;
  made.value = 0;
  made.status = CheckStatus::pass;
  double share = 0;
  for (std::size_t j = 0; j < run.record.joints.size(); ++j) {
    const JointStatistics& f = run.record.joints[j];
    if (!(f.range_worst > 0)) continue;
    ++made.joints;
    if (f.range_worst > made.value) {
      made.value = f.range_worst;
      made.joint = run.joint(j);
    }
    share = std::max(share, f.range_share);
  }
  if (made.joints > 0) made.status = made.value > kBeyondRange || share > kBeyondOften ? CheckStatus::fail : CheckStatus::warn;
  made.text = made.joints == 0
                  ? "no joint leaves its range"
                  : fmt::format("{} leave{} the range of the hinge, {} farthest, for up to {} of the run",
                                counted(made.joints, "joint"), made.joints == 1 ? "s" : "", made.joint, texts::percent(share));
  return made;
}

// ---- structure, ground

/// Why bodies cannot be judged, or which are not; empty: all are.
std::string no_bodies(const Run& run) {
  const std::size_t all = run.scenario.robot->bodies.size();
  if (run.scenario.contact.solver()) return "the solver of contact.law bullet keeps bodies apart and above the ground";
  if (run.overlaps.shaped == 0) return "no body has a shape, or the run has no poses";
  return run.overlaps.shaped == all ? "" : fmt::format(" ({} of {} bodies have a shape)", run.overlaps.shaped, all);
}

Check collision(const Run& run) {
  Check made = check("collision", "structure", "m");
  const std::string missing = no_bodies(run);
  made.text = missing;
  if (run.overlaps.shaped == 0) return made;
  const std::optional<Collision>& found = run.overlaps.collision;
  made.limit = kCollides;
  made.value = found ? found->depth : 0;
  made.status = graded(made.value, kCollides, kDeepCollision);
  made.text = "no two bodies are in one another" + missing;
  if (!found) return made;
  made.from = found->time;
  made.text = fmt::format("{} of bodies pass{} through one another, deepest {} and {}", counted(found->pairs, "pair"),
                          found->pairs == 1 ? "es" : "", run.scenario.robot->bodies[found->deepest_first].name,
                          run.scenario.robot->bodies[found->deepest_second].name);
  return made;
}

template <DockQuantity kQuantity>
Check dock(const Run& run) {
  constexpr const char* kIds[] = {"dock_tension", "dock_shear", "dock_bending", "dock_torsion"};
  const bool force = kQuantity == DockQuantity::tension || kQuantity == DockQuantity::shear;
  Check made = check(kIds[static_cast<std::size_t>(kQuantity)], "structure", force ? "N" : "N m");
  judge_docks(run.scenario, run.record, run.summary, kQuantity, dock_limits(*run.scenario.robot, kQuantity), made);
  return made;
}
Check battery(const Run&) { return not_judged("battery", "structure", "A", "the module types state no battery"); }

Check in_ground(const Run& run) {
  Check made = check("in_ground", "ground", "m");
  const std::string missing = no_bodies(run);
  made.text = run.scenario.ground.kind == Ground::Kind::plane ? missing : "judged of a plane without boxes";
  if (run.overlaps.shaped == 0 || run.scenario.ground.kind != Ground::Kind::plane) return made;
  const std::optional<Sunk>& found = run.overlaps.sunk;
  made.limit = kSinks;
  made.value = found ? found->depth : 0;
  made.status = found ? CheckStatus::fail : CheckStatus::pass;
  made.text = "no body goes through the ground" + missing;
  if (!found) return made;
  made.from = found->time;
  made.text =
      fmt::format("body {} goes {:.3g} mm into the ground", run.scenario.robot->bodies[found->body].name, 1000 * found->depth);
  return made;
}

Check slip(const Run& run) {
  Check made = check("slip", "ground", "");
  judge_slip(run.scenario, run.record, run.summary, made);
  return made;
}

Check stability(const Run& run) {
  Check made = check("stability", "ground", "m");
  judge_stability(run.scenario, run.record, run.summary, made);
  return made;
}

// ---- trust

Check torque_error_check(const Run& run) {
  Check made = check("torque_error", "trust", "");
  const TorqueError error = torque_error(run.record);
  made.text = "the error of the torques was not estimated in this run";
  if (!error.estimated) return made;
  made.value = error.share;
  made.limit = torque_error_limit(run.scenario);
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;
  made.joint = run.joint(error.joint);
  made.text = fmt::format("the torque of joint {} is off by about {} of its peak", made.joint, texts::percent(made.value));
  return made;
}

Check ledger(const Run& run) {
  Check made = check("ledger", "trust", "");
  made.text = "nothing drives the joints";
  if (!run.driven()) return made;
  made.value = std::abs(run.record.ledger.residual()) / energy_scale(run.scenario, run.record);
  made.limit = kEnergyResidual;
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;  // not a number: a warning
  made.text = fmt::format("{} of the energy is unaccounted for", texts::percent(made.value));
  return made;
}

Check created(const Run& run) {
  Check made = check("created", "trust", "");
  made.text = "nothing drives the joints";
  if (!run.driven()) return made;
  made.value = texts::created(run.record) / energy_scale(run.scenario, run.record);
  made.limit = kCreated;
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;  // not a number: a warning
  made.text =
      fmt::format("gears that are driven backwards give {} of the energy too much (eq. 2){}", texts::percent(made.value),
                  made.status == CheckStatus::warn ? "; actuator.efficiency_model: directional does not" : "");
  return made;
}

constexpr Check (*kChecks[])(const Run&) = {outcome,
                                            height,
                                            tilt,
                                            voltage,
                                            current,
                                            rest_torque,
                                            heat,
                                            gear,
                                            tracking,
                                            stops,
                                            collision,
                                            dock<DockQuantity::tension>,
                                            dock<DockQuantity::shear>,
                                            dock<DockQuantity::bending>,
                                            dock<DockQuantity::torsion>,
                                            battery,
                                            in_ground,
                                            slip,
                                            stability,
                                            torque_error_check,
                                            ledger,
                                            created};

const char* name_of(CheckStatus status) {
  switch (status) {
    case CheckStatus::pass:
      return "pass";
    case CheckStatus::warn:
      return "warn";
    case CheckStatus::fail:
      return "fail";
    default:
      return "not judged";
  }
}

bool decides(const Check& check) { return check.group != "trust"; }

std::string word(const std::vector<Check>& checks) {
  const auto any = [&](auto test) { return std::ranges::any_of(checks, test); };
  const auto fails = [](const Check& c) { return c.status == CheckStatus::fail; };
  if (fails(checks.front())) return "failed";
  if (any([&](const Check& c) { return decides(c) && fails(c); })) return "infeasible";
  if (any([](const Check& c) { return c.group == "motor" && c.status != CheckStatus::not_judged; })) return "feasible";
  return "not judged";
}

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

}  // namespace

std::size_t Verdict::count(CheckStatus status) const {
  return static_cast<std::size_t>(std::ranges::count(checks, status, &Check::status));
}

Verdict verdict(const Scenario& scenario, const Recording& record, const Summary& summary, const Overlaps& overlaps) {
  const Run run{scenario, record, summary, overlaps};
  Verdict made;
  made.from = summary.judged.from;
  made.to = summary.judged.to;
  for (const auto& check : kChecks) made.checks.push_back(check(run));
  made.word = word(made.checks);
  return made;
}

std::string to_json(const Verdict& verdict) {
  Json json;
  json["format"] = 1;
  json["verdict"] = verdict.word;
  json["window"] = {{"from", verdict.from}, {"to", verdict.to}};
  Json counts;
  for (const CheckStatus status : {CheckStatus::pass, CheckStatus::warn, CheckStatus::fail, CheckStatus::not_judged})
    counts[name_of(status)] = verdict.count(status);
  json["counts"] = counts;
  for (const Check& c : verdict.checks) {
    json["checks"].push_back({{"id", c.id},
                              {"group", c.group},
                              {"status", name_of(c.status)},
                              {"value", json_number(c.value)},
                              {"limit", json_number(c.limit)},
                              {"unit", c.unit},
                              {"joint", c.joint.empty() ? Json() : Json(c.joint)},
                              {"joints", c.joints},
                              {"from", json_number(c.from)},
                              {"to", json_number(c.to)},
                              {"text", c.text}});
  }
  return json.dump(2) + "\n";
}

std::vector<std::string> to_lines(const Verdict& verdict) {
  constexpr std::size_t kWidth = 64;
  const auto names = [&](CheckStatus status) {
    std::vector<std::string> ids;
    for (const Check& c : verdict.checks) {
      if (c.status == status) ids.push_back(c.id);
    }
    return fmt::format("{}", fmt::join(ids, ", "));
  };
  std::string text = verdict.word;
  const auto first = std::ranges::find(verdict.checks, CheckStatus::fail, &Check::status);
  if (first != verdict.checks.end()) text += ": " + first->text;
  if (verdict.word == "feasible") text += " with these motors";
  std::vector<std::string> lines;
  const auto wrap = [&](const std::string& whole) {
    const std::string broken = wrapped(whole, 0, kWidth);
    for (std::size_t at = 0; at < broken.size();) {
      const std::size_t end = std::min(broken.find('\n', at), broken.size());
      lines.push_back(broken.substr(at, end - at));
      at = end + 1;
    }
  };
  wrap(text);
  if (verdict.count(CheckStatus::fail) > 1) wrap("fails: " + names(CheckStatus::fail));
  if (verdict.count(CheckStatus::warn) > 0) wrap("warns: " + names(CheckStatus::warn));
  if (verdict.count(CheckStatus::not_judged) > 0) wrap("not judged: " + names(CheckStatus::not_judged));
  return lines;
}

}  // namespace gaitlab::report
