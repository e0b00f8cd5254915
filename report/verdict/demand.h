// The demand twin: a second run of the scenario with 20 times the motor limits, which shows the shortfall of the real motors.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report/analysis/summary.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

inline constexpr double kDemandTimes = 20;  ///< factor between the motor limits of the twin and those of the scenario

/// Demand of a gait: joint statistics of the twin, in which the motors are practically unlimited.
struct Demand {
  std::string doubt = {};                ///< reason why the demand is unknown or doubtful; empty otherwise
  bool known = false;                    ///< true if `joints` is filled in
  std::vector<JudgedJoint> joints = {};  ///< statistics of each joint of the twin, in the judged window of the real run
  std::optional<SupplyDemand> supply = {};
};

/// Demand of the scenario's supply in a run; nothing if there is none, or if a number is not finite.
std::optional<SupplyDemand> supply_demand(const Scenario& scenario, const Recording& record, const Judged& judged);

/// Sentence on the demand of a supply.
std::string text_of(const SupplyDemand& demand);

/// Multiplies every limit of the scenario's actuator (every field declared as Fields::limit) by kDemandTimes, and replaces the
/// supply by one without resistance that bounds no command. Limits that the scenario does not state are multiplied too. Returns
/// false if the actuator has no limit, or a limit of 0.
bool raise_limits(Scenario& scenario);

/// True if the robot jumps in the run `free` without motor limits, but not in its `own` run: the centre of mass rises higher
/// than in `own` by more than half of the robot's standing height. False for a fixed base.
bool thrown_up(const Scenario& scenario, const Recording& free, const Recording& own);

/// Runs the twin, a scenario that raise_limits has changed. The demand is unknown if the twin diverges. It is doubtful if the
/// twin's robot jumps (thrown_up), or if the twin reaches one of its motor limits. Deterministic. `progress` is called as by
/// Simulation::run.
Demand demand(const Scenario& twin, const Recording& record, const Summary& summary,
              const std::function<void(double)>& progress = {});

/// Fills in Check::missing of the checks that fail or warn because of a motor limit, and Verdict::demands.
void add_demand(Verdict& verdict, const Scenario& scenario, const Summary& summary, const Demand& demand);

/// Fills in the demand as add_demand does, but from the verdict.json of an earlier run with the option, so that a report on the
/// folder prints it again. Returns false and changes nothing if the file does not exist or belongs to another verdict (its
/// word, window or limit checks differ).
bool take_demand(Verdict& verdict, const std::string& json);

}  // namespace gaitlab::report
