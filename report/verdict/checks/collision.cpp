// The check `collision`: bodies keep apart.
#include "core/settings/wording.h"
#include "report/analysis/own_overlap.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::collision() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    const std::optional<Collision>& found = run.overlaps.collision;
    made.text = run.unknown_bodies();
    if (!found && !made.text.empty()) return;
    take_limit(made, "collision", &Limits::collision, run);
    made.value = found ? found->depth : 0;
    made.status = graded(made.value, run.limits().meeting(), made.limit);
    made.text = "no two bodies overlap more than by design";
    if (!found) return;
    made.from = made.to = found->deepest_time;
    made.first = found->time;
    made.first_part = run.scenario.robot->bodies[found->first].name;
    made.parts = found->pairs;
    made.part = Part::body;
    made.worst = run.scenario.robot->bodies[found->deepest_first].name;
    const Body &one = run.scenario.robot->bodies[found->deepest_first],
               &other = run.scenario.robot->bodies[found->deepest_second];
    made.remedy = "take smaller amplitudes or offsets: with contact.law: penalty, bodies can pass through one another";
    made.remedy += "; or list the pair in robot.may_overlap, if its shapes are rough";
    made.text = fmt::format("{} of bodies pass{} through one another, deepest {} and {}, by {}", counted(found->pairs, "pair"),
                            found->pairs == 1 ? "es" : "", one.name, other.name, texts::length(found->depth));
  };
  return {{"collision", CheckGroup::structure, "m", "Bodies keep apart",
           fmt::format("deepest overlap of two bodies at control ticks, without pairs in may_overlap; two bodies of one module "
                       "may overlap by {:.3g} times as much as with all hinges at 0",
                       kTurned),
           "above limits.collision", "above limits.touch", CheckSpan::whole_run, "robot",
           "smaller amplitudes or offsets, or may_overlap for bodies whose shapes are rougher than the real ones", judge, false,
           false, false, Lost::extreme}};
}

}  // namespace gaitlab::report
