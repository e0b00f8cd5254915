// The check `outcome`: the run is complete.
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::outcome() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    made.value = run.record.simulated;
    made.limit = run.scenario.duration;
    made.status = run.record.outcome.done() ? CheckStatus::pass : CheckStatus::fail;
    made.text = run.record.outcome.done() ? "the run came to its end" : run.record.outcome.text();
  };
  return {{"outcome", CheckGroup::run, "s", "Run finished", "simulated time, compared with the duration", "the run ended early",
           "", CheckSpan::whole_run, "duration", "the message of the run names the remedy", judge, true}};
}

}  // namespace gaitlab::report
