// Stance phases of the legs in a run, computed from the recorded loads.
#pragma once
#include <span>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/analysis/legs.h"
#include "report/figures/run/footfall.h"

namespace gaitlab::report {

inline constexpr double kStands = 0.02;  ///< share of the weight above which a leg is in stance

/// Name of the first missing column `load.M` that these legs need. Empty if the recording contains all.
std::string lacking_load(const Scenario& scenario, const Recording& record, const std::vector<Leg>& legs);

/// Footfalls over the whole run, one row per leg. `time` is that of the recording's rows, s. Duty factors are over the interval
/// from `from` (s) to the end.
std::vector<Footfall> footfalls(const Scenario& scenario, const Recording& record, const std::vector<Leg>& legs,
                                std::span<const double> time, double from);

}  // namespace gaitlab::report
