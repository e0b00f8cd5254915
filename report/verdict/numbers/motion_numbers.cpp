// Summary numbers of energies, posture, repetition and stability.
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "report/analysis/fall.h"
#include "report/analysis/posture.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/numbers/numbers.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;
using R = const RunData&;

Json fallen(R run) {
  const std::optional<Fall> found = run.summary.fall ? *run.summary.fall : fall(run.scenario, run.record);
  return found ? Json(found->time.has_value()) : Json();
}

Json held(R run, double Posture::*figure) { return or_null(run.summary.posture.*figure); }

}  // namespace

std::vector<SummaryNumber> motion_numbers() {
  return {
      {.key = "energy.electrical",
       .unit = "J",
       .definition = "Energy that the whole robot draws from the supply. This and all other numbers of the group are entries "
                     "of the ledger ([equations](equations.md), 8) at the last row of the trace.",
       .value = [](R r) { return r.record.ledger.electrical; },
       .line = {100, "energy", texts::drawn}},
      {.key = "energy.copper",
       .unit = "J",
       .definition = "Heat in the windings.",
       .value = [](R r) { return r.record.ledger.copper; },
       .line = {102, "", texts::ledger}},
      {.key = "energy.gear",
       .unit = "J",
       .definition = "Loss in the gears, minus `created`.",
       .value = [](R r) { return r.record.ledger.gear; }},
      {.key = "energy.created",
       .unit = "J",
       .definition = "Sum of `per_joint.J.energy.created`.",
       .value = [](R r) { return texts::created(r.record); },
       .line = {106, "", texts::created_energy}},
      {.key = "energy.stored",
       .unit = "J",
       .definition = "Kinetic and potential energy, including springs of hinges without a motor, minus the "
                     "value at the start.",
       .value = [](R r) { return r.record.ledger.stored; }},
      {.key = "energy.contact",
       .unit = "J",
       .definition = "Work done on the ground along its normal.",
       .value = [](R r) { return r.record.ledger.contact; }},
      {.key = "energy.friction",
       .unit = "J",
       .definition = "Work done on the ground along its surface.",
       .value = [](R r) { return r.record.ledger.friction; }},
      {.key = "energy.stops",
       .unit = "J",
       .definition = "Work done on the hinge stops.",
       .value = [](R r) { return r.record.ledger.stops; }},
      {.key = "energy.hinges",
       .unit = "J",
       .definition = "Energy lost in dampers and friction of hinges without a motor.",
       .value = [](R r) { return r.record.ledger.hinges; }},
      {.key = "energy.dry",
       .unit = "J",
       .definition = "Energy lost in dry and viscous friction of driven joints.",
       .value = [](R r) { return r.record.ledger.dry; }},
      {.key = "energy.residual",
       .unit = "J",
       .definition = "Energy missing from the ledger: the error of the integration.",
       .value = [](R r) { return r.record.ledger.residual(); }},
      {.key = "energy.residual_share",
       .definition = "Magnitude of `residual` over the energy drawn (or stored, or needed to lift the robot by "
                     "1 mm, if that is more).",
       .value = [](R r) { return or_null(residual_share(r.scenario, r.record)); }},
      {.key = "energy.created_share",
       .definition = "`created` over the same energy as in `residual_share`.",
       .value = [](R r) { return or_null(created_share(r.scenario, r.record)); }},
      {.key = "fell",
       .definition = "True if the centre of mass came below `limits.height` times the lower of two heights above the ground: "
                     "at the start, and in the pose of the set points (the check `fall` of the verdict); null if the base does "
                     "not float or there is no ground.",
       .value = [](R r) { return fallen(r); }},
      {.key = "airborne_share",
       .definition = "Share of the control ticks in the judged window at which the ground carries less than 5 % "
                     "of the weight; null without gravity, for a base that does not float, or for a robot "
                     "without contact elements.",
       .value = [](R r) { return held(r, &Posture::airborne_share); }},
      {.key = "height.min",
       .unit = "m",
       .definition = "Least height of the centre of mass at the control ticks in the judged window.",
       .value = [](R r) { return held(r, &Posture::height_min); }},
      {.key = "height.max",
       .unit = "m",
       .definition = "Largest height of the centre of mass at these control ticks.",
       .value = [](R r) { return held(r, &Posture::height_max); }},
      {.key = "tilt.max",
       .unit = "rad",
       .definition = "Largest angle between the base's z axis and the vertical at these control ticks (the check "
                     "`upright` of the verdict uses the turn since the start).",
       .value = [](R r) { return held(r, &Posture::tilt_max); }},
      {.key = "limit_cycle.found",
       .definition = "True if the motion has become periodic: see below.",
       .value = [](R r) { return r.summary.limit_cycle.found; },
       .line = {70, "limit cycle", texts::limit_cycle},
       .compare = {.place = 200, .if_different = true},
       .swap = {70, "", " limit cycle", -1, texts::limit_cycle_cell}},
      {.key = "limit_cycle.from",
       .unit = "s",
       .definition = "Start of the periodic motion; 0 without a limit cycle.",
       .value = [](R r) { return r.summary.limit_cycle.from; }},
      {.key = "limit_cycle.period",
       .unit = "s",
       .definition = "Period of the motion, or of the best candidate; 0 without a candidate.",
       .value = [](R r) { return r.summary.limit_cycle.period; },
       .compare = {210}},
      {.key = "limit_cycle.error",
       .definition = "Repetition error of this period; 1 without a candidate.",
       .value = [](R r) { return r.summary.limit_cycle.error; }},
      {.key = "stability.max",
       .definition = "Largest h lambda at the control ticks ([equations](equations.md)).",
       .value = [](R r) { return r.summary.stability_max; },
       .line = {130, "stability", texts::stability},
       .compare = {240}},
      {.key = "stability.share_above_1",
       .definition = "Share of the control ticks at which h lambda exceeds 1.",
       .value = [](R r) { return r.summary.stability_share; }},
      {.key = "stability.source",
       .definition = "Source of the largest lambda.",
       .words = true,
       .value = [](R r) { return r.summary.stability_source; }},
      {.key = "trace_hash",
       .definition = "Hash of the names and the bytes of all columns, after the number of its format.",
       .words = true,
       .value = [](R r) { return r.record.trace_hash(); },
       .compare = {250}},
  };
}

}  // namespace gaitlab::report
