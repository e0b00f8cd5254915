// The check `airborne`: the ground carries the robot all the time.
#include "report/analysis/posture.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::airborne() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    made.value = run.summary.posture.airborne_share;
    made.text = "judged only for a floating base that gravity holds on a ground, if the ground's forces are recorded";
    if (std::isnan(made.value)) return;
    made.limit = 0;
    made.from = run.summary.judged.from;
    made.to = run.summary.judged.to;
    made.status = made.value > 0 ? CheckStatus::warn : CheckStatus::pass;
    made.text = fmt::format("the ground carries less than {} of the weight for {} of the judged time",
                            texts::percent(kAirborne), texts::percent(made.value));
  };
  return {{"airborne", CheckGroup::ground, "", "Stays on the ground",
           fmt::format("share of the window in which the ground carries less than {} of the weight", texts::percent(kAirborne)),
           "", "any", CheckSpan::window, "cpg", "a slower gait", judge}};
}

}  // namespace gaitlab::report
