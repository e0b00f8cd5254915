// The demand twin: the same run by motors that lack nothing, which tells how much the real ones lack.
#pragma once
#include <string>
#include <vector>

#include "report/analysis/summary.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

inline constexpr double kDemandTimes = 20;  ///< the twin's limits over those of the scenario

/// What a gait takes where no limit holds its motors back.
struct Demand {
  std::string doubt = {};                ///< why it is not known, or what makes it doubtful; empty: nothing does
  bool known = false;                    ///< whether `joints` says anything
  std::vector<JudgedJoint> joints = {};  ///< of the twin, in the window of the run itself
};

/// Multiplies every limit of the scenario's actuator (fields declared as Fields::limit) that holds, stated or not, by
/// kDemandTimes. False: it has none, or
/// one is 0.
bool raise_limits(Scenario& scenario);

/// Whether a robot on the ground is thrown up without limits (`free`) that was not in its own run: its centre of mass rises by
/// half of its height at the start more. False of a fixed base.
bool thrown_up(const Scenario& scenario, const Recording& free, const Recording& own);

/// Runs the twin, which raise_limits made of the scenario of `record`. A twin that diverges is not known; one whose robot is
/// thrown up (its centre of mass rises by half of its height at the start more than in the run itself) is doubtful, and so is
/// one that itself reaches a limit. Same bytes for the same run.
Demand demand(const Scenario& twin, const Recording& record, const Summary& summary);

/// Fills in `missing` of what fails or warns for a limit of the motors, and Verdict::demands.
void add_demand(Verdict& verdict, const Scenario& scenario, const Summary& summary, const Demand& demand);

/// The same from the verdict.json that such a run wrote, so that its folder says again what it said. False: that file is not of
/// this verdict (its word, its window and the checks of the limits are others), or no such file; nothing is taken.
bool take_demand(Verdict& verdict, const std::string& json);

}  // namespace gaitlab::report
