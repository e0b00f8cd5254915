// How long a run takes, told before it starts. By the clock: for the terminal alone, never for a result.
#pragma once
#include <string>

#include "core/simulation/simulation.h"

namespace gaitlab::app {

struct RunTime {
  double seconds = 0;        ///< of the whole run, as its first steps go; 0: not known
  double rate = 0;           ///< steps/s
  std::string failure = {};  ///< of a run that fails within them: how
};

/// From here on a run is long: worth a word before it starts.
inline constexpr double kLongRun = 10;  // s

/// Has the simulation take its first steps, in about 0.2 s of processor time. Throws what step() throws.
RunTime measure(Simulation& simulation, double duration);

/// The same on a copy of at most a hundred control periods: of a run whose rows do not fit into the memory, too.
RunTime measure(const Scenario& scenario);

/// `takes about 14 s on this machine (28000 steps/s)`
std::string to_string(const RunTime& time);

}  // namespace gaitlab::app
