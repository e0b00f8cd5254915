// The check `predictable`: a tiny change of gravity does not change the torques.
#include "core/simulation/step_error.h"
#include "report/verdict/checks/checked_run.h"
#include "report/verdict/spread.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::predictable() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    made.text = predictability_text(run.scenario, run.record);
    if (predictability(run.scenario, run.record) == Predictability::unknown) return;
    const Parting& apart = parting(run.scenario, run.record);
    made.value = apart.share;
    made.limit = predictability_limit(run.scenario);
    made.source = "physics.accuracy";
    if (passes(made, made.limit)) return;
    name_joint(made, run, apart.joint);
    made.first_part = made.worst;
    made.from = made.to = made.first = apart.time;
    if (run.record.spread.rows() > 0) made.text += "; " + spread_text(run.record.spread);
    made.remedy = "judge several runs with other seeds or starts; a smaller step does not help";
  };
  return {{"predictable", CheckGroup::trust, "", "Motion is predictable",
           fmt::format("change of a joint's torque (RMS, relative to its peak) under gravity times {}, or times {} if that "
                       "already changes the torques",
                       disturbed(StepError::kIll), disturbed(StepError::kChaotic)),
           "",
           "above " + texts::percent(kAccurate) +
               ", or physics.accuracy; a check that some of four rollouts fail is then too close to its limit",
           CheckSpan::whole_run, "physics.gravity", "several runs with other seeds or starts; a smaller step does not help",
           judge}};
}

}  // namespace gaitlab::report
