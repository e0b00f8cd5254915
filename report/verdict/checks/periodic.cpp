// The check `periodic`: the motion repeats as its set points do.
#include "core/recording/limit_cycle.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::periodic() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    const MotionCycle& cycle = run.summary.limit_cycle;
    made.text = "the set points do not repeat";
    if (!cycle.found && !run.evidence.repeats) return;
    made.text = "the run does not show the gait";
    if (!cycle.found && !run.evidence.not_shown.empty()) return;
    made.value = cycle.error;
    made.limit = kMostCycleError;
    made.source = "chosen";
    made.status = cycle.found ? CheckStatus::pass : CheckStatus::warn;
    made.text = cycle.found ? fmt::format("the motion repeats every {:.4g} s", cycle.period)
                            : "the set points repeat, but the motion does not settle to a period";
  };
  return {{"periodic", CheckGroup::trust, "", "Repeats",
           "error of the limit cycle: difference of angles and set points from their values one period later", "",
           texts::percent(kMostCycleError) + " and more, if the set points repeat", CheckSpan::window, "duration",
           "a longer duration", judge}};
}

}  // namespace gaitlab::report
