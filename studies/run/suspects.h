// Trial of runs in separate processes, so that a study survives a plugin that terminates its process.
#pragma once
#include <atomic>
#include <span>
#include <vector>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Tries each run in a separate process, `jobs` at a time. Returns rows with outcome `crashed` for runs that terminated their
/// process by a signal of their own (abort, bad address, bad number). Runs that survived, were ended from outside, or did not
/// begin because `stop` was set have no row. Call this function before other threads exist.
std::vector<Row> crashes_of(const Plan& plan, std::span<const std::uint64_t> runs, int jobs, const std::atomic<bool>& stop);

}  // namespace gaitlab::studies
