// Changes of single settings that make a gait feasible or, for a feasible gait, keep it feasible.
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/simulation/batch.h"
#include "report/remedy/remedy_ratings.h"
#include "report/remedy/remedy_run.h"

namespace gaitlab::report {

/// Result for a setting in one direction.
struct RemedyAnswer {
  const RemedyKey* key = nullptr;
  bool up = false;         ///< true for larger values
  bool stopped = false;    ///< the search was stopped before it had tried this direction to its end
  bool crosses = false;    ///< the verdict changes between a fifth and five times the value
  bool confirmed = false;  ///< true if runs with the scenario's engine, step and estimate confirm it
  double factor = 1;       ///< factor of the answer: the nearest feasible value or, for a feasible gait, the farthest
  /// Farthest tried factor such that all tried runs up to it have the verdict of the answer.
  double until = 1;
  RemedyRun run = {};          ///< run with `factor` and the scenario's own engine
  RemedyRun beyond = {};       ///< for a feasible gait, a run beyond the reserve, within 2 % of the change
  bool less_suffices = false;  ///< true if nine tenths of the change also make the gait feasible, so that `factor` is too large
  std::string refused = {};    ///< message of the reader about the first value beyond `until`; empty if it was simulated
  double refused_at = 1;       ///< factor of that value
  std::vector<std::string> sets = {};  ///< settings of the answer, in the form of --set
};

/// Verdicts over frequency and amplitude, by row (amplitude) and column (frequency).
struct RemedyMap {
  std::vector<double> factors;  ///< factors of both settings
  std::vector<RemedyRun> runs;
};

/// The fastest feasible gait of the map, confirmed by a run with the scenario's own engine.
struct RemedyPair {
  double frequency = 1, amplitude = 1;  ///< factors
  RemedyRun run = {};
  std::vector<std::string> sets = {};
};

/// A setting that was not tried, with the reason.
struct RemedyLack {
  const RemedyKey* key = nullptr;
  std::string reason;
};

struct Remedy {
  RemedySettings settings;       ///< settings of the run
  std::string scenario;          ///< hash of the resolved scenario
  Word word = Word::not_judged;  ///< word of the run, or of the finer run
  /// Settings of the finer run, from which the search starts if the run itself is `not judged` only for its accuracy. They are
  /// also the first settings of each answer.
  std::vector<std::string> finer = {};
  std::string engine = {}, own_engine = {};  ///< engines of the search and of the scenario
  std::vector<RemedyAnswer> answers = {};
  std::vector<RatingNeeded> ratings = {};
  bool ratings_suffice = false;  ///< true if only ratings are exceeded
  std::vector<RemedyLack> lacking = {};
  std::optional<RemedyMap> map = {};
  std::optional<RemedyPair> pair = {};  ///< searched if no setting alone helps
  std::size_t runs = 0;
  bool interrupted = false;  ///< true if `stop` was set: only the complete parts of the search are here
};

struct RemedyTask {
  const Scenario& scenario;
  const Verdict& verdict;  ///< verdict on the run
  /// The scenario with further settings in the form of --set. Throws InputError.
  std::function<Scenario(const std::vector<std::string>& sets)> with;
  bool map = false;
  std::vector<std::string> by = {};  ///< names of the settings to try; empty for all
  BatchSettings batch;
  std::function<void(double)> progress = {};  ///< called with the share of the work that is done, from several threads
};

/// Multiplies one setting at a time by eight factors from a fifth to five. It then narrows, in each direction, the interval
/// nearest to 1 that contains a change of the verdict, until its width is 2 % of the change, and rounds the result to the safe
/// side. Runs of the search use the engine `articulated` without an estimate of their torque error, unless that engine has
/// another verdict on the run itself. The answers are confirmed with the scenario's own engine, step and estimate: the gait is
/// feasible with the change, and not with nine tenths of it. If no setting alone helps, the fastest feasible pair of frequency
/// and amplitude on a grid of 13 x 13 is taken. Results do not depend on threads or lanes. If `stop` is set, the search ends
/// with the answers so far (Remedy::interrupted). Throws InputError if the verdict is `not judged` and not only for the
/// accuracy of the run, and PluginError.
Remedy remedy(const RemedyTask& task, std::atomic<bool>& stop);

}  // namespace gaitlab::report
