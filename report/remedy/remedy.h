// Changes of single settings that make a gait feasible or, for a feasible gait, those that it bears.
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/simulation/batch.h"
#include "report/remedy/remedy_keys.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Verdict on the gait with some settings multiplied by factors.
struct RemedyRun {
  Word word = Word::failed;  ///< `failed` also if the scenario was refused
  double margin = 0;         ///< least margin; NaN if not known
  double speed = 0;          ///< m/s; NaN if not known
  std::string fails = {};    ///< the deciding check and its part: `voltage of m6/active`
  [[nodiscard]] bool feasible() const { return word == Word::feasible; }
};

/// Result for a setting in one direction.
struct RemedyAnswer {
  const RemedyKey* key = nullptr;
  bool up = false;          ///< true for larger values
  bool crosses = false;     ///< the verdict changes between a fifth and five times the value
  bool confirmed = false;   ///< by runs with the engine, step and duration of the scenario
  double factor = 1;        ///< of the answer: the nearest feasible value or, for a feasible gait, the farthest
  double until = 1;         ///< farthest factor tried up to which all runs are feasible (for a feasible gait: `factor`)
  RemedyRun run = {};       ///< with `factor`
  RemedyRun farthest = {};  ///< at the end of the range, or where the verdict changes
  std::vector<std::string> sets = {};  ///< settings of the answer, in the form of --set
};

/// A rated load, which does not act on the motion, and the rating that suffices.
struct RatingNeeded {
  std::string check, part;
  std::string setting;  ///< last part of the key, such as `i_continuous`
  double rating = 0, now = 0;
  std::string unit;
  std::size_t parts = 1;  ///< number of parts beyond their ratings
};

/// Verdicts over frequency and amplitude, by row (amplitude) and column (frequency).
struct RemedyMap {
  std::vector<double> factors;  ///< of both settings
  std::vector<RemedyRun> runs;
};

/// The fastest feasible gait of the map.
struct RemedyPair {
  double frequency = 1, amplitude = 1;  ///< factors
  bool confirmed = false;
  RemedyRun run = {};
  std::vector<std::string> sets = {};
};

struct Remedy {
  Word word = Word::not_judged;  ///< of the run
  std::string engine;            ///< engine of the search
  std::vector<RemedyAnswer> answers;
  std::vector<RatingNeeded> ratings;
  bool ratings_suffice = false;           ///< true if only ratings are exceeded
  std::vector<const RemedyKey*> lacking;  ///< settings that the scenario does not have
  std::optional<RemedyMap> map;
  std::optional<RemedyPair> pair;  ///< searched if no setting alone helps
  std::size_t runs = 0;
};

struct RemedyTask {
  const Scenario& scenario;
  const Verdict& verdict;  ///< of the run
  /// The scenario with further settings in the form of --set. Throws InputError.
  std::function<Scenario(const std::vector<std::string>& sets)> with;
  bool map = false;
  std::vector<std::string> by = {};  ///< names of the settings to try; empty for all
  BatchSettings batch;
  std::function<void(double)> progress = {};  ///< called with the share of the work that is done
};

/// Multiplies one setting at a time: eight factors from a fifth to five times, then bisection of the change of the verdict that
/// is nearest to 1 in each direction, to 2 % of the change, rounded to the safe side. Runs of the search use the engine
/// `articulated` without an estimate of their torque error; the answers are confirmed by the scenario's own engine, step and
/// estimate: feasible with the change, and not with nine tenths of it. If no setting alone helps, the fastest feasible pair of
/// frequency and amplitude on a grid of 13 x 13 is taken. Results do not depend on threads or lanes. Returns nothing if `stop`
/// was set. Throws InputError if the verdict is `not judged`.
std::optional<Remedy> remedy(const RemedyTask& task, std::atomic<bool>& stop);

}  // namespace gaitlab::report
