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

/// Each text is empty where nothing is missing, else a sentence with its remedy.
struct Evidence {
  std::string too_short;    ///< a gait needs a whole period of its limit cycle, or three periods of its set points, or 2 s
  std::string not_borne;    ///< the ground carries less than half of the weight
  std::string not_trusted;  ///< the numbers are wrong by more than the shares above, a motor makes energy, or nothing moves
  std::string remedy;       ///< of set points that never change
  bool repeats = false;     ///< the set points do
  std::string rests_on;     ///< `3 periods of 4 s`, `these 18 s; the set points do not repeat`
  [[nodiscard]] bool complete() const { return too_short.empty() && not_borne.empty() && not_trusted.empty(); }
};

/// Throws PluginError.
Evidence evidence(const Scenario& scenario, const Recording& record, const Summary& summary);

}  // namespace gaitlab::report
