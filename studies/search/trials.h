// Trials: further runs of points of a study, with other settings.
#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "studies/journal/results.h"
#include "studies/run/executor.h"

namespace gaitlab::studies {

/// Runs of a point with further settings.
struct Trial {
  const PointResult& point;
  TrialKind kind;
  std::string name;                                                 ///< the engine, joint or world; empty for the other kinds
  std::function<std::vector<std::string>(std::uint64_t run)> sets;  ///< settings for one of the point's runs
  bool first_replicates = false;                                    ///< true: only the first replicate in each scenario
  std::vector<Row> rows = {};                                       ///< rows of the runs, in the order of their numbers
};

/// Called with the number of ended runs and the number of all runs. Calls do not overlap.
using TrialsTold = std::function<void(std::size_t done, std::size_t of)>;

/// Makes the runs of all trials, with an estimate of the torque error or, if `estimate` is false, only for points that are
/// drawn for one. Returns false if `stop` was set.
bool run_trials(const Plan& plan, std::vector<Trial>& trials, bool estimate, const Executor& executor, const TrialsTold& told,
                std::atomic<bool>& stop);

/// Result of a trial, combined over its runs as the study defines.
PointResult result_of(const Journal& journal, const Trial& trial);

/// Row of the table `verification` for a trial, without a reason.
Verification without_reason(const Plan& plan, const Journal& journal, const Trial& trial);

/// True if the verdict on a run rejects its point regardless of the guards: `infeasible`, or `not judged` for lack of evidence.
bool speaks_against(Word verdict, double evidence);
inline constexpr const char* kEvidence = "margin.evidence";  ///< negative if evidence is missing
/// A quantity of a run by name; NaN if the journal lacks it.
double quantity(const Plan& plan, const Row& row, const std::string& name);
double evidence(const Plan& plan, const Row& row);

/// Text such as `in rubble: ` for a row, or "" if the study has only one scenario.
std::string in_scenario(const Row& row);

}  // namespace gaitlab::studies
