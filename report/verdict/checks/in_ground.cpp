// The check `in_ground`: bodies stay above the ground.
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::in_ground() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    const std::optional<Sunk>& found = run.overlaps.sunk;
    const bool grounded = run.scenario.ground.exists();
    made.text = grounded ? run.unknown_bodies() : "judged only above a ground";
    if (!found && !made.text.empty()) return;
    take_limit(made, "sink", &Limits::sink, run);
    made.value = found ? found->depth : 0;
    made.status = found ? CheckStatus::fail : CheckStatus::pass;
    made.text = "no body goes through the ground";
    if (!found) return;
    made.from = made.to = found->deepest_time;
    made.first_part = run.scenario.robot->bodies[found->first].name;
    made.parts = found->bodies;
    made.text = fmt::format("body {} goes {} into the ground", run.scenario.robot->bodies[found->body].name,
                            texts::length(found->depth));
    made.first = found->time;
    made.part = Part::body;
    made.worst = run.scenario.robot->bodies[found->body].name;
    made.remedy = run.scenario.contact.on == ContactSet::all
                      ? "take a larger contact.stiffness, if it is too small for this load"
                      : "set contact.on: all, so that every part of the robot can touch the ground";
  };
  return {{"in_ground", CheckGroup::ground, "m", "Bodies stay above the ground",
           "largest depth of a body in the ground, at control ticks", "above limits.sink", "", CheckSpan::whole_run,
           "contact.on", "contact.on: all, or a larger contact.stiffness", judge, false, false, false, Lost::extreme}};
}

}  // namespace gaitlab::report
