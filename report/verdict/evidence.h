// Evidence for the word `feasible`: a run that is long enough, borne by the ground, and to be trusted.
#pragma once
#include <string>

#include "core/scenario/scenario.h"
#include "report/analysis/gait_period.h"
#include "report/analysis/summary.h"

namespace gaitlab::report {

/// Largest shares with which the numbers of a run are trusted, beside limits.torque_error: residual of the energy over what was
/// drawn; time in which the shortest steps do not reach the accuracy.
inline constexpr double kTrustedResidual = 0.05, kTrustedCoarse = 0.1;
/// Least share of the weight that the ground carries on average, of a robot that stands on it.
inline constexpr double kBorne = 0.5;
/// Largest error of a limit cycle of which one period is enough; else kPeriodsNeeded (gait_period.h).
inline constexpr double kSettled = 0.01;
inline constexpr double kLeastTime = 2;  ///< s, where the set points do not repeat

/// What is missing.
struct Lack {
  std::string text = {};    ///< with what to set where `remedy` is empty; empty: nothing is missing
  std::string key = {};     ///< setting that a message points at
  std::string remedy = {};  ///< of what no other message tells at its place
  [[nodiscard]] bool empty() const { return text.empty(); }
  [[nodiscard]] std::string sentence() const { return text + (remedy.empty() ? "" : "; " + remedy); }
};

struct Evidence {
  Lack too_short;             ///< a gait needs a whole period of its limit cycle, or three periods of its set points, or 2 s
  Lack not_borne;             ///< the ground carries less than half of the weight
  Lack not_trusted;           ///< the numbers are wrong by more than the shares above, a motor makes energy, or nothing moves
  bool falls_freely = false;  ///< nothing could bear the robot, however long and accurate the run
  bool repeats = false;       ///< the set points do
  std::string rests_on;       ///< `3 periods of 4 s`, `these 18 s; the set points do not repeat`
  [[nodiscard]] bool complete() const { return too_short.empty() && not_borne.empty() && not_trusted.empty(); }
  /// What is to be mended first.
  [[nodiscard]] const Lack& first() const {
    return falls_freely ? not_borne : !not_trusted.empty() ? not_trusted : !too_short.empty() ? too_short : not_borne;
  }
};

/// Throws PluginError.
Evidence evidence(const Scenario& scenario, const Recording& record, const Summary& summary);

}  // namespace gaitlab::report
