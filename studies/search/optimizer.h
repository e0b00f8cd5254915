// Runs the searches of a study: what they ask becomes points and runs, what comes out goes back to them.
#pragma once
#include "studies/run/runner.h"

namespace gaitlab::studies {

/// Where the searches are.
struct SearchPlace {
  std::uint64_t searches = 0, generation = 0, restart = 0;  ///< of the search that is furthest
  std::uint64_t asked = 0;                                  ///< runs of this generation
};

enum class SearchEnd { budget, converged, stopped };

/// Each search goes on by itself; their generations run side by side. Parameters with lists of values have a search for every
/// combination of these. A point that was asked before is not run again. Nothing is kept between two calls but the journal: a
/// second call asks the same, and finds the answers there. `told`: before each generation. InputError: the journal's points are
/// not those that the searches ask for (of another pagmo). RunError: the journal cannot be written.
SearchEnd run_searches(Plan& plan, Journal& journal, RunnerSettings settings,
                       const std::function<void(const SearchPlace&)>& told, std::atomic<bool>& stop);

}  // namespace gaitlab::studies
