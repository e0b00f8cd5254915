// Runner of a study's searches: turns their points into runs, and returns the results to them.
#pragma once
#include "studies/run/runner.h"

namespace gaitlab::studies {

/// Progress of the searches.
struct SearchPlace {
  std::uint64_t searches = 0, generation = 0, restart = 0;  ///< of the most advanced search
  std::uint64_t asked = 0;                                  ///< runs of this generation
};

enum class SearchEnd { budget, converged, stopped };

/// Runs the searches. Each search proceeds independently; their generations run side by side. Parameters with lists of values
/// have a search for every combination of these. A point that was requested before is not run again. Only the journal is kept
/// between two calls: a second call makes the same requests and finds the answers there. `told`: called before each generation.
/// Throws InputError if the journal's points are not those of the searches (another version of pagmo), RunError if the journal
/// cannot be written.
SearchEnd run_searches(Plan& plan, Journal& journal, RunnerSettings settings,
                       const std::function<void(const SearchPlace&)>& told, std::atomic<bool>& stop);

}  // namespace gaitlab::studies
