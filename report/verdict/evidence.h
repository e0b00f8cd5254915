// Evidence for the word `feasible`: a run that is long enough, carried by the ground, and accurate.
#pragma once
#include <string>

#include "core/scenario/scenario.h"
#include "report/analysis/gait_period.h"
#include "report/analysis/summary.h"

namespace gaitlab::report {

/// Largest shares for a trusted run, beside limits.torque_error: residual of the energy over the energy drawn; time in which
/// the shortest steps do not reach the accuracy.
inline constexpr double kTrustedResidual = 0.05, kTrustedCoarse = 0.1;
/// Least share of the weight that the ground must carry on average, for a robot that stands on it.
inline constexpr double kBorne = 0.5;
/// Largest error of a limit cycle for which one period is enough; else kPeriodsNeeded (gait_period.h).
inline constexpr double kSettled = 0.01;
inline constexpr double kLeastTime = 2;  ///< s, if the set points do not repeat

/// Missing evidence.
struct Lack {
  std::string text = {};    ///< empty: nothing is missing. Names the setting to change if `remedy` is empty
  std::string key = {};     ///< setting to which a message refers
  std::string remedy = {};  ///< for evidence without another message at its place
  [[nodiscard]] bool empty() const { return text.empty(); }
  [[nodiscard]] std::string sentence() const { return text + (remedy.empty() ? "" : "; " + remedy); }
};

struct Evidence {
  Lack too_short;    ///< a gait needs a whole period of its limit cycle, or three periods of its set points, or 2 s
  Lack not_borne;    ///< the ground carries less than half of the weight
  Lack not_trusted;  ///< the numbers have a larger error than the shares above, a motor creates energy, or nothing moves
  bool falls_freely = false;  ///< nothing could carry the robot in a run of any length and accuracy
  bool repeats = false;       ///< the set points repeat
  std::string rests_on;       ///< `3 periods of 4 s`, `these 18 s; the set points do not repeat`
  [[nodiscard]] bool complete() const { return too_short.empty() && not_borne.empty() && not_trusted.empty(); }
  /// The most important missing evidence.
  [[nodiscard]] const Lack& first() const {
    return falls_freely ? not_borne : !not_trusted.empty() ? not_trusted : !too_short.empty() ? too_short : not_borne;
  }
};

/// Collects the evidence. Throws PluginError.
Evidence evidence(const Scenario& scenario, const Recording& record, const Summary& summary);

}  // namespace gaitlab::report
