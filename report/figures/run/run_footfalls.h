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

/// Load of each leg at the rows of a recording, N.
struct LegLoads {
  std::vector<std::vector<double>> loads;
  std::string lacks;  ///< first column that is missing; loads is empty then
};

/// The loads are sums of the columns `load.M` of modules that belong to a leg alone, or else of the columns `foot.BODY.fz` of
/// its bodies (loads_at_rows).
LegLoads loads_of(const Scenario& scenario, const Recording& record, const std::vector<Leg>& legs);

/// Footfalls over the whole run, one row per leg. `time` is that of the recording's rows, s. Duty factors are over the interval
/// from `from` (s) to the end. Empty without the loads of the legs.
std::vector<Footfall> footfalls(const Scenario& scenario, const Recording& record, const std::vector<Leg>& legs,
                                std::span<const double> time, double from);

}  // namespace gaitlab::report
