// The demand twin: the same run with unlimited motors, which shows the shortfall of the real motors.
#pragma once
#include <string>
#include <vector>

#include "report/analysis/summary.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

inline constexpr double kDemandTimes = 20;  ///< factor between the twin's limits and the scenario's

/// Demand of a gait: joint statistics without motor limits.
struct Demand {
  std::string doubt = {};                ///< reason why the demand is unknown or doubtful; empty: neither
  bool known = false;                    ///< whether `joints` holds values
  std::vector<JudgedJoint> joints = {};  ///< of the twin, in the window of the run
};

/// Multiplies every limit in force of the scenario's actuator (fields declared as Fields::limit), stated or not, by
/// kDemandTimes. False: it has none, or one is 0.
bool raise_limits(Scenario& scenario);

/// Whether a robot on the ground jumps without limits (`free`) but not in its own run: its centre of mass rises higher by more
/// than half of its height at the start. False for a fixed base.
bool thrown_up(const Scenario& scenario, const Recording& free, const Recording& own);

/// Runs the twin, a scenario modified by raise_limits. The demand is unknown if the twin diverges, and doubtful if its robot
/// jumps (thrown_up) or if it reaches a limit itself. Deterministic.
Demand demand(const Scenario& twin, const Recording& record, const Summary& summary);

/// Fills in `missing` for checks that fail or warn because of a motor limit, and Verdict::demands.
void add_demand(Verdict& verdict, const Scenario& scenario, const Summary& summary, const Demand& demand);

/// The same from the verdict.json of an earlier such run, so that its folder gives the same output again. False, without
/// effect: the file belongs to another verdict (its word, its window or its limit checks differ), or does not exist.
bool take_demand(Verdict& verdict, const std::string& json);

}  // namespace gaitlab::report
