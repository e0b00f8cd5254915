// Trial of runs in separate processes, so that a study survives a plugin that ends its process.
#pragma once
#include <atomic>
#include <span>
#include <vector>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Tries each run in a separate process, `jobs` at a time. Returns rows `crashed` for those whose process ended by a signal
/// that it caused (abort, a bad address, a bad number), not for those that survived, were ended from outside, or did not begin
/// because `stop` was set. Call it before there are threads.
std::vector<Row> crashes_of(const Plan& plan, std::span<const std::uint64_t> runs, int jobs, const std::atomic<bool>& stop);

}  // namespace gaitlab::studies
