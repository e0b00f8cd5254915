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

struct CheckKind {
  const char *id, *group, *unit, *title, *definition;
  void (*judge)(const CheckedRun& run, Check& made);
};

template <DockQuantity kQuantity>
void dock(const CheckedRun& run, Check& made) {
  judge_docks(run.scenario, run.record, run.summary, kQuantity, dock_limits(*run.scenario.robot, kQuantity), made);
}
void slip(const CheckedRun& run, Check& made) {
  judge_slip(run.scenario, run.record, run.summary, made);
  made.source = threshold("slip", run.limits().slip, Limits().slip);
}
void stability(const CheckedRun& run, Check& made) { judge_stability(run.scenario, run.record, run.summary, made); }

constexpr CheckKind kChecks[] = {
    {"outcome", "run", "s", "Run finished", "simulated time against the duration", checks::outcome},
    {"fall", "run", "", "Does not fall", "least height of the centre of mass over that at the start, at control ticks",
     checks::height},
    {"tilt", "run", "rad", "Stays upright", "largest turn of the base away from its start, at control ticks", checks::tilt},
    {"voltage", "motor", "", "Voltage suffices", "share of the window at the limit of the voltage, over all steps",
     checks::voltage},
    {"current", "motor", "", "Current suffices", "share of the window at the limit of the current, over all steps",
     checks::current},
    {"envelope", "motor", "", "Torque within reach",
     "largest torque over what the actuator has at that speed in that direction, over all steps", checks::envelope},
    {"speed", "motor", "rad/s", "Speed within reach",
     "largest speed against the speed at which the actuator has no torque left, or the rated one, over all steps",
     checks::speed},
    {"heat", "motor", "A", "Motors stay cool", "RMS current over the window against the continuous rating, over all steps",
     checks::heat},
    {"gear_peak", "motor", "N m", "Gears bear the peaks", "largest torque against the rating of the gear, over all steps",
     checks::gear_peak},
    {"gear_continuous", "motor", "N m", "Gears last",
     "RMS torque over the window against the rating of the gear, over all steps", checks::gear_continuous},
    {"tracking", "motion", "rad", "Joints follow their set points",
     "largest set point minus angle in the window, over all steps", checks::tracking},
    {"stops", "motion", "rad", "Joints keep their ranges",
     "farthest beyond the range of the hinge, of the whole run, over all steps", checks::stops},
    {"collision", "structure", "m", "Bodies keep apart",
     "depth of two bodies in one another, but for bodies on one hinge, of the whole run, at control ticks", checks::collision},
    {"dock_tension", "structure", "N", "Docks are not pulled apart", "largest tension of a dock against its rating",
     dock<DockQuantity::tension>},
    {"dock_shear", "structure", "N", "Docks do not shear", "largest shear force of a dock against its rating",
     dock<DockQuantity::shear>},
    {"dock_bending", "structure", "N m", "Docks are not bent open", "largest bending moment of a dock against its rating",
     dock<DockQuantity::bending>},
    {"dock_torsion", "structure", "N m", "Docks are not twisted", "largest torsion moment of a dock against its rating",
     dock<DockQuantity::torsion>},
    {"battery", "structure", "A", "Batteries suffice", "current of each module against the rating of its battery",
     checks::battery},
    {"in_ground", "ground", "m", "Bodies stay above the ground",
     "depth of a body in a plane, of the whole run, at control ticks", checks::in_ground},
    {"slip", "ground", "", "Feet hold",
     "way that the loaded feet slide over the way of the centre of mass, both at control ticks", slip},
    {"stability", "ground", "m", "Stands on its feet",
     "least distance of the centre of mass to the edge of the support polygon, inside positive", stability},
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

std::string word(const std::vector<Check>& checks) {
  const auto any = [&](auto test) { return std::ranges::any_of(checks, test); };
  const auto fails = [](const Check& c) { return c.status == CheckStatus::fail; };
  if (fails(checks.front())) return "failed";
  if (any([&](const Check& c) { return c.group != "trust" && fails(c); })) return "infeasible";
  if (any([](const Check& c) { return c.group == "motor" && c.status != CheckStatus::not_judged; })) return "feasible";
  return "not judged";
}

}  // namespace

std::size_t Verdict::count(CheckStatus status) const {
  return static_cast<std::size_t>(std::ranges::count(checks, status, &Check::status));
}

Verdict verdict(const Scenario& scenario, const Recording& record, const Summary& summary, const Overlaps& overlaps) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const CheckedRun run{scenario, record, summary, overlaps};
  Verdict made;
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
    made.chosen_motors = made.chosen_motors || (judged && check.group == "motor" && chosen(run.motor_source));
    made.chosen_docks = made.chosen_docks || (judged && check.id.starts_with("dock_") && chosen(check.source));
    made.checks.push_back(std::move(check));
  }
  made.word = word(made.checks);
  if (const std::vector<JudgedJoint>& whole = summary.judged.whole; Judged::limited(whole) > 0) {
    made.first_joint = run.joint(Judged::first(whole));
    made.first_time = whole[Judged::first(whole)].first_limit_time;
  }
  return made;
}

}  // namespace gaitlab::report
