#include "report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/scenario/wording.h"
#include "report/collisions.h"
#include "report/motors.h"
#include "report/number_texts.h"
#include "report/trust.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kGoodEnergy = 0.01;      // of what is drawn: residual
constexpr double kCreated = 0.05;         // of what is drawn
constexpr double kDeepCollision = 0.002;  // m
constexpr double kBeyondRange = 0.01;     // rad, and share of the time

/// What every check reads.
struct Run {
  const Scenario& scenario;
  const Recording& record;
  const Summary& summary;

  [[nodiscard]] const std::string& joint(std::size_t j) const { return scenario.robot->joints[j].name; }
  [[nodiscard]] const Limits& limits() const { return scenario.limits; }
  /// Why its motors cannot be judged; empty: they can.
  [[nodiscard]] std::string no_motors() const {
    if (scenario.actuator.entry == nullptr || record.joints.empty()) return "nothing drives the joints";
    if (record.ticks.rows() > 1 && record.ticks.columns.size() == 1 + kTickColumns * record.joints.size()) return "";
    return record.control_ticks > 0 ? "the run folder is of an older format, without what all steps did"
                                    : "the run has no step";
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

Check fall(const Run& run) {
  Check made = check("fall", "run", "");
  const Ground::Kind ground = run.scenario.ground.kind;
  const Series height = run.record.series("com.z");
  if (run.scenario.base != Base::floating || height.empty() || !run.record.has_states(*run.scenario.robot) ||
      (ground != Ground::Kind::plane && ground != Ground::Kind::boxes)) {
    made.text = "a fall is judged of a floating base above a plane";
    return made;
  }
  const auto pose = [&](std::size_t row) { return run.record.state(*run.scenario.robot, row).orientation; };
  const Vec3 up = pose(0).inverse() * Vec3::UnitZ();
  double lowest = height[0];
  double tilt = 1;  // cosine
  std::size_t at = 0;
  for (std::size_t row = 0; row < height.size(); ++row) {
    tilt = std::min(tilt, (pose(row) * up).z());
    if (height[row] < lowest) {
      lowest = height[row];
      at = row;
    }
  }
  made.value = height[0] > 0 ? lowest / height[0] : 1;
  made.limit = run.limits().height;
  made.from = made.to = std::min(static_cast<double>(at) * run.scenario.trace.period, run.record.simulated);
  const double angle = std::acos(std::clamp(tilt, -1.0, 1.0));
  made.status = made.value < made.limit ? CheckStatus::fail : angle > run.limits().tilt ? CheckStatus::warn : CheckStatus::pass;
  made.text = fmt::format("the centre of mass keeps {} of its height, the base tilts by up to {:.3g} rad",
                          texts::percent(made.value), angle);
  return made;
}

// ---- motor

struct Span {
  double from = 0, to = 0;
  [[nodiscard]] double length() const { return to - from; }
};

/// The longest stretch of ticks after `start` that a joint was all the while at the limit.
Span longest_span(const Trace& ticks, std::size_t joint, TickColumn limited, double start) {
  constexpr double kAllTheWhile = 0.999;
  const Series t(ticks, 0);
  const Series at(ticks, 1 + joint * kTickColumns + limited);
  Span longest;
  Span now;
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (t[k - 1] < start) continue;
    const bool on = at[k] - at[k - 1] > kAllTheWhile * (t[k] - t[k - 1]);
    if (!on) {
      now = {};
      continue;
    }
    if (now.length() == 0) now.from = t[k - 1];
    now.to = t[k];
    if (now.length() > longest.length()) longest = now;
  }
  return longest;
}

Check saturation(const Run& run, const char* id, MotorLimit limit, TickColumn column, double JudgedJoint::*share) {
  Check made = check(id, "motor", "");
  made.text = run.no_motors();
  if (!made.text.empty()) return made;
  const Judged& judged = run.summary.judged;
  const double longest = run.limits().saturated_periods * run.scenario.control_period;
  made.limit = run.limits().saturated_share;
  made.status = CheckStatus::pass;
  made.value = 0;
  for (std::size_t j = 0; j < judged.joints.size(); ++j) {
    const double part = judged.joints[j].*share;
    if (!(part > 0)) continue;
    ++made.joints;
    const Span span = longest_span(run.record.ticks, j, column, judged.from);
    const CheckStatus status = part > made.limit || span.length() > longest * kLarger ? CheckStatus::fail : CheckStatus::warn;
    if (std::pair(status, part) <= std::pair(made.status, made.value)) continue;
    made.status = status;
    made.value = part;
    made.joint = run.joint(j);
    made.from = span.length() > 0 ? span.from : kNone;
    made.to = span.length() > 0 ? span.to : kNone;
  }
  const char* const name = limit == MotorLimit::voltage ? "voltage" : "current";
  made.text = made.joints == 0 ? fmt::format("no joint is at the limit of its {}", name)
                               : fmt::format("{} of {} joints are at the limit of their {}, {} longest: {} of the window",
                                             made.joints, judged.joints.size(), name, made.joint, texts::percent(made.value));
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
  made.text = run.no_motors();
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
  made.status = made.value > made.limit ? CheckStatus::warn : CheckStatus::pass;
  made.text = fmt::format("the largest torque is {} of what a motor has at rest", texts::percent(made.value));
  return made;
}

Check heat(const Run&) {
  return not_judged("heat", "motor", "A", "no module type states a continuous current or a thermal model of its motor");
}

Check gear(const Run&) { return not_judged("gear", "motor", "N m", "no module type states what its gear stands"); }

// ---- motion

Check tracking(const Run& run) {
  Check made = check("tracking", "motion", "rad");
  made.text = run.no_motors();
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
  made.text = fmt::format("joint {} is up to {:.3f} rad from its set point", made.joint, made.value);
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
  if (made.joints > 0) made.status = made.value > kBeyondRange || share > kBeyondRange ? CheckStatus::fail : CheckStatus::warn;
  made.text = made.joints == 0 ? "no joint leaves its range"
                               : fmt::format("{} joint{} beyond their range, for up to {} of the run", made.joints,
                                             made.joints == 1 ? "" : "s", texts::percent(share));
  return made;
}

// ---- structure, ground

Check collision(const Run& run) {
  Check made = check("collision", "structure", "m");
  if (run.scenario.contact.solver()) {
    made.text = "contact.law bullet keeps bodies apart";
    return made;
  }
  if (!run.record.has_states(*run.scenario.robot)) {
    made.text = "the run has no poses";
    return made;
  }
  const std::optional<Collision> found = collisions(run.scenario, run.record);
  made.limit = kCollides;
  made.value = found ? found->depth : 0;
  made.status = graded(made.value, kCollides, kDeepCollision);
  made.text = "no two bodies are in one another";
  if (!found) return made;
  made.from = found->time;
  made.text = fmt::format("{} of bodies pass through one another, deepest {} and {}", counted(found->pairs, "pair"),
                          run.scenario.robot->bodies[found->deepest_first].name,
                          run.scenario.robot->bodies[found->deepest_second].name);
  return made;
}

Check docks(const Run&) { return not_judged("dock", "structure", "N", "no module type states what its docks hold"); }
Check battery(const Run&) { return not_judged("battery", "structure", "A", "no module type states its battery"); }

Check in_ground(const Run& run) {
  Check made = check("in_ground", "ground", "m");
  if (run.scenario.ground.kind != Ground::Kind::plane || !run.record.has_states(*run.scenario.robot)) {
    made.text = "judged of runs on a plane";
    return made;
  }
  const std::optional<Sunk> found = sunk(run.scenario, run.record);
  made.limit = kSinks;
  made.value = found ? found->depth : 0;
  made.status = found ? CheckStatus::fail : CheckStatus::pass;
  made.text = "no body goes through the ground";
  if (!found) return made;
  made.from = found->time;
  made.text =
      fmt::format("body {} goes {:.3g} mm into the ground", run.scenario.robot->bodies[found->body].name, 1000 * found->depth);
  return made;
}

// ---- trust

Check torque_error_check(const Run& run) {
  Check made = check("torque_error", "trust", "");
  const TorqueError error = torque_error(run.record);
  made.text = "this engine and integrator do not estimate the error of the torques";
  if (!error.estimated) return made;
  made.value = error.share;
  made.limit = std::max(kGoodEnergy, run.scenario.physics.adapts() ? run.scenario.physics.accuracy : 0);
  made.status = made.value > made.limit ? CheckStatus::warn : CheckStatus::pass;
  made.joint = run.joint(error.joint);
  made.text = fmt::format("the torque of joint {} is off by about {} of its peak", made.joint, texts::percent(made.value));
  return made;
}

Check ledger(const Run& run) {
  Check made = check("ledger", "trust", "");
  made.text = run.no_motors();
  if (!made.text.empty()) return made;
  made.value = std::abs(run.record.ledger.residual()) / energy_scale(run.scenario, run.record);
  made.limit = kGoodEnergy;
  made.status = made.value > made.limit ? CheckStatus::warn : CheckStatus::pass;
  made.text = fmt::format("{} of the energy is unaccounted for", texts::percent(made.value));
  return made;
}

Check created(const Run& run) {
  Check made = check("created", "trust", "");
  made.text = run.no_motors();
  if (!made.text.empty()) return made;
  made.value = texts::created(run.record) / energy_scale(run.scenario, run.record);
  made.limit = kCreated;
  made.status = made.value > made.limit ? CheckStatus::warn : CheckStatus::pass;
  made.text = fmt::format(
      "gears that are driven backwards give {} of the drawn energy too much (eq. 2); "
      "actuator.efficiency_model: directional does not",
      texts::percent(made.value));
  return made;
}

constexpr Check (*kChecks[])(const Run&) = {outcome,  fall,   voltage,   current, rest_torque, heat,      gear,
                                            tracking, stops,  collision, docks,   battery,     in_ground, torque_error_check,
                                            ledger,   created};

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

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

}  // namespace

std::size_t Verdict::count(CheckStatus status) const {
  return static_cast<std::size_t>(std::ranges::count(checks, status, &Check::status));
}

Verdict verdict(const Scenario& scenario, const Recording& record, const Summary& summary) {
  const Run run{scenario, record, summary};
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
                              {"value", number(c.value)},
                              {"limit", number(c.limit)},
                              {"unit", c.unit},
                              {"joint", c.joint.empty() ? Json() : Json(c.joint)},
                              {"joints", c.joints},
                              {"from", number(c.from)},
                              {"to", number(c.to)},
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
