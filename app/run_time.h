// Estimate of the time that a run takes, printed before it starts. It is measured by the clock and therefore only printed: no
// result depends on it.
#pragma once
#include <string>

#include "core/simulation/simulation.h"

namespace gaitlab::app {

struct RunTime {
  double seconds = 0;        ///< estimated duration of the whole run, extrapolated from its first steps; 0 if not known
  double rate = 0;           ///< steps/s
  std::string failure = {};  ///< error message if the run fails during these first steps
};

/// Least estimated duration for which the estimate is printed.
inline constexpr double kLongRun = 10;  // s

/// Measures the time of the first steps of the simulation, in about 0.2 s of processor time. Throws the exceptions of
/// Simulation::step.
RunTime measure(Simulation& simulation, double duration);

/// Estimate from a separate simulation of at most a hundred control periods. It also works for a run whose rows do not fit into
/// memory.
RunTime measure(const Scenario& scenario);

/// Text `takes about 14 s on this machine (28000 steps/s)`.
std::string to_string(const RunTime& time);

}  // namespace gaitlab::app
