#include "report/verdict/verdict.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "report/analysis/plugin_names.h"
#include "report/analysis/row_statistics.h"
#include "report/analysis/states.h"
#include "report/verdict/checks.h"
#include "report/verdict/load_checks.h"

namespace gaitlab::report {

namespace {

/// What a check is judged over. A failure of the whole run cannot be undone by more time.
enum class Over { window, whole_run };

struct CheckKind {
  const char *id, *group, *unit, *title, *definition;
  void (*judge)(const CheckedRun& run, Check& made);
  Over span = Over::window;
};

template <DockQuantity kQuantity>
void dock(const CheckedRun& run, Check& made) {
  judge_docks(run.scenario, run.record, kQuantity, dock_limits(*run.scenario.robot, kQuantity), made);
  if (made.status == CheckStatus::not_judged || run.torque_errors.empty()) return;
  widen(run.scenario, std::ranges::max(run.torque_errors), made.limit, made);
}
void slip(const CheckedRun& run, Check& made) {
  judge_slip(run.scenario, run.record, run.summary, made);
  made.source = threshold("slip", run.limits().slip, Limits().slip);
}
void stability(const CheckedRun& run, Check& made) { judge_stability(run.scenario, run.record, run.summary, made); }

constexpr CheckKind kChecks[] = {
    {"outcome", "run", "s", "Run finished", "simulated time against the duration", checks::outcome},
    {"fall", "run", "", "Does not fall", "least height of the centre of mass over that at the start, at control ticks",
     checks::height, Over::whole_run},
    {"progress", "run", "m", "Goes somewhere",
     "travel of the centre of mass per period against a hundredth of the robot's extent, or heading against 0.01 rad",
     checks::progress},
    {"tilt", "run", "rad", "Stays upright", "largest turn of the base away from its start, at control ticks", checks::tilt},
    {"voltage", "motor", "", "Voltage suffices", "share of the window at the limit of the voltage, over all steps",
     checks::voltage},
    {"current", "motor", "", "Current suffices", "share of the window at the limit of the current, over all steps",
     checks::current},
    {"envelope", "motor", "", "Torque within reach",
     "largest torque over what the actuator has at that speed in that direction, over all steps", checks::envelope},
    {"speed", "motor", "rad/s", "Speed within reach",
     "largest speed against the speed at which the actuator has no torque left, or the rated one, over all "
     "steps",
     checks::speed},
    {"heat", "motor", "A", "Motors stay cool", "RMS current over the window against the continuous rating, over all steps",
     checks::heat},
    {"gear_peak", "motor", "N m", "Gears bear the peaks",
     "largest torque of the whole run against the rating of the gear, over all steps", checks::gear_peak, Over::whole_run},
    {"gear_continuous", "motor", "N m", "Gears last",
     "RMS torque over the window against the rating of the gear, over all steps", checks::gear_continuous},
    {"tracking", "motion", "rad", "Joints follow their set points",
     "largest set point minus angle in the window, over all steps", checks::tracking},
    {"stops", "motion", "rad", "Joints keep their ranges",
     "farthest beyond the range of the hinge, of the whole run, over all steps", checks::stops, Over::whole_run},
    {"collision", "structure", "m", "Bodies keep apart",
     "depth of two bodies in one another, but for bodies on one hinge, of the whole run, at control ticks", checks::collision,
     Over::whole_run},
    {"dock_tension", "structure", "N", "Docks are not pulled apart",
     "largest tension of a dock against its rating, of the whole run, at control ticks", dock<DockQuantity::tension>,
     Over::whole_run},
    {"dock_shear", "structure", "N", "Docks do not shear",
     "largest shear force of a dock against its rating, of the whole run, at control ticks", dock<DockQuantity::shear>,
     Over::whole_run},
    {"dock_bending", "structure", "N m", "Docks are not bent open",
     "largest bending moment of a dock against its rating, of the whole run, at control ticks", dock<DockQuantity::bending>,
     Over::whole_run},
    {"dock_torsion", "structure", "N m", "Docks are not twisted",
     "largest torsion moment of a dock against its rating, of the whole run, at control ticks", dock<DockQuantity::torsion>,
     Over::whole_run},
    {"battery", "structure", "A", "Batteries suffice", "current of each module against the rating of its battery",
     checks::battery},
    {"in_ground", "ground", "m", "Bodies stay above the ground",
     "depth of a body in a plane, of the whole run, at control ticks", checks::in_ground, Over::whole_run},
    {"slip", "ground", "", "Feet hold",
     "way that the loaded feet slide over the way of the centre of mass, both at control ticks", slip},
    {"stability", "ground", "m", "Stands on its feet",
     "least distance of the centre of mass to the edge of the support polygon, inside positive", stability},
    {"evidence", "trust", "s", "Long enough, borne and to be trusted",
     "judged time, the ground's share of the weight, and the errors of torques and energy", checks::evidence},
    {"torque_error", "trust", "", "Torques are accurate", "estimated error of a joint's torque over its peak",
     checks::torque_error},
    {"ledger", "trust", "", "Energy adds up",
     "residual of the energy over what was drawn (or stored, or lifts the robot by 1 mm, if that is more)", checks::ledger},
    {"created", "trust", "", "Gears create no energy", "energy that back-driven gears give (eq. 2) over the same",
     checks::created},
};

constexpr std::string_view kOverAllSteps = ", over all steps";
constexpr std::string_view kAtTicks = ", at control ticks";

void replace_end(std::string& text, std::string_view end, std::string_view by) {
  if (text.ends_with(end)) text.replace(text.size() - end.size(), end.size(), by);
}

/// The first check of that status, or nullptr.
const Check* first_of(const std::vector<Check>& checks, CheckStatus status) {
  const auto found = std::ranges::find(checks, status, &Check::status);
  return found == checks.end() ? nullptr : &*found;
}

/// The reason why nothing that fails makes the gait infeasible, or why it is not feasible though nothing fails; empty: none.
std::string not_judged(const CheckedRun& run, const std::vector<Check>& checks) {
  const Evidence& found = run.evidence;
  if (!found.not_trusted.empty()) return found.not_trusted;
  if (!found.too_short.empty()) {
    const Check* const failing = first_of(checks, CheckStatus::fail);
    return found.too_short + (failing == nullptr ? "" : "; so far: " + failing->text);
  }
  if (first_of(checks, CheckStatus::fail) != nullptr) return "";
  if (!found.not_borne.empty()) return found.not_borne;
  if (const Check* const close = first_of(checks, CheckStatus::too_close)) return close->text;
  const auto judged = [](const Check& c) { return c.status != CheckStatus::not_judged; };
  if (std::ranges::none_of(checks, [&](const Check& c) { return c.group == "motor" && judged(c); }))
    return run.driven() ? "no limit of the motors is known" : "nothing drives the joints";
  if (run.scenario.base != Base::floating || run.scenario.ground.kind == Ground::Kind::none || run.scenario.contact.solver())
    return "";
  for (const Check& check : checks) {
    if ((check.id == "fall" || check.id == "in_ground") && !judged(check)) return check.id + " was not judged: " + check.text;
  }
  return "";
}

bool undone_by_no_time(const Check& check) {
  return check.status == CheckStatus::fail && std::ranges::any_of(kChecks, [&](const CheckKind& kind) {
           return kind.span == Over::whole_run && check.id == kind.id;
         });
}

void decide(const CheckedRun& run, Verdict& made) {
  made.rests_on = run.evidence.rests_on;
  if (made.checks.front().status == CheckStatus::fail) {
    made.word = Word::failed;
  } else if (run.evidence.not_trusted.empty() && std::ranges::any_of(made.checks, undone_by_no_time)) {
    made.word = Word::infeasible;
  } else if (made.reason = not_judged(run, made.checks); !made.reason.empty()) {
    made.word = Word::not_judged;
  } else {
    made.word = first_of(made.checks, CheckStatus::fail) != nullptr ? Word::infeasible : Word::feasible;
  }
}

}  // namespace

std::size_t Verdict::count(CheckStatus status) const {
  return static_cast<std::size_t>(std::ranges::count(checks, status, &Check::status));
}

std::string Verdict::why() const {
  if (word == Word::not_judged) return reason;
  const Check* const first = first_of(checks, CheckStatus::fail);
  if (first == nullptr) return "";
  return first->text + (first->missing.empty() ? "" : "; missing: " + first->missing);
}

Verdict verdict(const Scenario& scenario, const Recording& record, const Summary& summary, const Overlaps& overlaps) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const CheckedRun run{scenario, record, summary, overlaps};
  Verdict made;
  std::vector<std::string> motors;  // sources of what checks were judged by
  std::vector<std::string> docks;
  made.from = summary.judged.from;
  made.to = summary.judged.to;
  made.of_rows = rows_sentence(record);
  for (const CheckKind& kind : kChecks) {
    Check check{kind.id, kind.group, kind.title, CheckStatus::not_judged, kNone, kNone, kind.unit, "",
                0,       kNone,      kNone,      kind.definition};
    if (!states_of_ticks(record)) replace_end(check.definition, kAtTicks, ", at trace rows");
    if (!made.of_rows.empty()) replace_end(check.definition, kOverAllSteps, ", over the rows of the trace");
    kind.judge(run, check);
    check.text = without_folders(std::move(check.text), scenario.plugins);
    const bool judged = check.status != CheckStatus::not_judged;
    if (judged && check.group == "motor") motors = {run.motor_source};
    if (judged && check.id.starts_with("dock_")) docks.push_back(check.source);
    made.checks.push_back(std::move(check));
  }
  made.chosen_motors = std::ranges::any_of(motors, chosen);
  made.chosen_docks = std::ranges::any_of(docks, chosen);
  made.figures = figures_sentence(motors, docks);
  decide(run, made);
  if (const std::vector<JudgedJoint>& whole = summary.judged.whole; Judged::limited(whole) > 0) {
    made.first_joint = run.joint(Judged::first(whole));
    made.first_time = whole[Judged::first(whole)].first_limit_time;
  }
  return made;
}

}  // namespace gaitlab::report
