#include "report/remedy/finer_remedy.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/files/hash.h"
#include "core/scenario/resolved.h"
#include "report/analysis/collisions.h"

namespace gaitlab::report {

InputError no_verdict(const RemedyTask& task) {
  return {SourceLocation{task.scenario.file},
          "a remedy needs a verdict, but this run is not judged: " + task.verdict.reason.text};
}

Remedy remedy_of_finer_run(const RemedyTask& task, std::atomic<bool>& stop) {
  const std::vector<std::string>& finer = task.verdict.retry;
  const auto and_finer = [&](std::vector<std::string> sets) {
    sets.insert(sets.begin(), finer.begin(), finer.end());
    return sets;
  };
  const Scenario scenario = task.with(finer);
  std::optional<Verdict> found;
  run_all({&scenario, 1}, task.batch, kVerdictReads, stop, [&](std::size_t, RolloutEnd&& end) {
    if (!end.refused.empty()) throw InputError(std::move(end.refused));
    found = verdict(scenario, end.recording, summarise(scenario, end.recording, 0), overlaps(scenario, end.recording));
  });
  Remedy made{settings_of(task.scenario), hash(resolved(task.scenario))};
  made.engine = made.own_engine = scenario.physics.engine->name;
  made.interrupted = true;
  if (found && found->word == Word::not_judged) throw no_verdict(task);
  if (found && !stop) {
    const std::string of_run = std::move(made.scenario);
    made = remedy({scenario, *found, [&](const std::vector<std::string>& sets) { return task.with(and_finer(sets)); }, task.map,
                   task.by, task.batch, task.progress},
                  stop);
    made.scenario = of_run;
  }
  for (RemedyAnswer& answer : made.answers) answer.sets = and_finer(std::move(answer.sets));
  if (made.pair) made.pair->sets = and_finer(std::move(made.pair->sets));
  made.finer = finer;
  return made;
}

}  // namespace gaitlab::report
