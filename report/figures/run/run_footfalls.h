// Stance phases of each leg of a run's robot.
#pragma once
#include <span>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/analysis/legs.h"
#include "report/figures/run/footfall.h"

namespace gaitlab::report {

inline constexpr double kStands = 0.02;  ///< share of the weight: a leg that carries more stands

/// The first column `load.M` of these legs that the recording lacks; empty: it has them all.
std::string lacking_load(const Scenario& scenario, const Recording& record, const std::vector<Leg>& legs);

/// A row per leg, over the whole run; `time` (s) of the recording's rows, duty factors from `from` (s) to its end.
std::vector<Footfall> footfalls(const Scenario& scenario, const Recording& record, const std::vector<Leg>& legs,
                                std::span<const double> time, double from);

}  // namespace gaitlab::report
