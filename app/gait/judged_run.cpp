#include "app/gait/judged_run.h"

#include "app/shell/commands.h"
#include "core/errors.h"

namespace gaitlab::app {

JudgedRun judged_run(const std::string& name, Catalog& catalog, const std::vector<std::string>& joints,
                     const SummaryOptions& shown) {
  JudgedRun run = read_judged(name, catalog);
  run.all.reset();
  draw_joints(run.read.scenario, joints);
  run.keep_second_runs(!shown.demand);
  if (shown.demand) take_demand(run.read.scenario, run.recording(), run.summary, run.verdict);
  run.keep_remedy();
  return run;
}

void warn(const JudgedRun& run) {
  const Recording& recording = run.recording();
  for (const std::string& missing : run.read.stored.missing) say(run.name, "note", missing);
  if (!recording.outcome.done()) say(run.name, "note", "this run ended early: " + recording.outcome.text());
  warn_of_run(run.read.scenario, recording, run.verdict);
}

}  // namespace gaitlab::app
