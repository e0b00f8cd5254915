// Estimate of the time that a run takes, printed before it starts. Measured by the clock: for the terminal only, never for a
// result.
#pragma once
#include <string>

#include "core/simulation/simulation.h"

namespace gaitlab::app {

struct RunTime {
  double seconds = 0;        ///< estimate for the whole run from its first steps; 0: not known
  double rate = 0;           ///< steps/s
  std::string failure = {};  ///< failure of a run during these steps
};

/// Duration of a long run, of which the estimate is printed.
inline constexpr double kLongRun = 10;  // s

/// Measures the simulation's first steps, in about 0.2 s of processor time. Throws what step() throws.
RunTime measure(Simulation& simulation, double duration);

/// The same with a separate simulation of at most a hundred control periods: also for a run whose rows do not fit into memory.
RunTime measure(const Scenario& scenario);

/// `takes about 14 s on this machine (28000 steps/s)`
std::string to_string(const RunTime& time);

}  // namespace gaitlab::app
