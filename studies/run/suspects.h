// Runs in processes of their own: where a plugin ends the process, the study goes on.
#pragma once
#include <atomic>
#include <span>
#include <vector>

#include "studies/plan/plan.h"

namespace gaitlab::studies {

/// Runs each in another process first, `jobs` at a time. The rows `crashed` of those whose process ended by a signal of its own
/// making (abort, a bad address, a bad number); none of those that lived, were ended from outside, or did not begin because
/// `stop` was set. To be called before there are threads.
std::vector<Row> crashes_of(const Plan& plan, std::span<const std::uint64_t> runs, int jobs, const std::atomic<bool>& stop);

}  // namespace gaitlab::studies
