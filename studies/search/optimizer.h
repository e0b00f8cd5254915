// Runner of a study's searches, which turns their points into runs and returns the results to them.
#pragma once
#include "studies/run/runner.h"

namespace gaitlab::studies {

/// Progress of the searches.
struct SearchPlace {
  /// Number of searches; generation and restart of the most advanced search.
  std::uint64_t searches = 0, generation = 0, restart = 0;
  std::uint64_t asked = 0;  ///< runs of this generation
};

/// End of the searches. `refused`: the scenario refused all points of every search's first block.
enum class SearchEnd { budget, converged, refused, stopped };

/// Runs the searches of a study. Searches are independent, and their generations run side by side. If parameters have lists of
/// values, each combination of these values has a separate search; it ends if the scenario refuses all points of its first
/// block, and its budget goes to the others. A point that was requested before is not simulated again.
/// Only the journal remains between two calls: a second call makes the same requests and finds their results there. `told` is
/// called before each generation. Throws InputError if the points in the journal are not those of the searches, as after a
/// change of pagmo. Throws RunError if the journal cannot be written.
SearchEnd run_searches(Plan& plan, Journal& journal, RunnerSettings settings,
                       const std::function<void(const SearchPlace&)>& told, std::atomic<bool>& stop);

}  // namespace gaitlab::studies
