// The check `evidence`: the run is long enough, borne by the ground, and accurate.
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::evidence() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    const Evidence& found = run.evidence;
    made.value = run.summary.judged.to - run.summary.judged.from;
    made.source = "chosen";
    const std::vector<const Lack*> lacks = found.lacks();
    if (lacks.empty()) {
      made.status = CheckStatus::pass;
      made.text = "judged over " + found.rests_on;
      return;
    }
    made.text = lacks.front()->text;
    for (std::size_t k = 1; k < lacks.size(); ++k) made.text += "; and " + lacks[k]->text;
    made.remedy = lacks.front()->remedy;
    made.place = run.scenario.nearest_place(lacks.front()->key);
  };
  return {{"evidence", CheckGroup::trust, "s", "Long enough, borne by the ground and accurate",
           "judged time, the ground's share of the weight, and the errors of torques and energy", "", "", CheckSpan::window,
           "duration", "the check's text names the missing evidence", judge}};
}

}  // namespace gaitlab::report
