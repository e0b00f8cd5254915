// Advice on bands of a golden that are too wide: settings that narrow them, and changes that wide bands do not detect.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "golden/bands.h"

namespace gaitlab::golden {

/// Share: approve refuses a column with a wider band, because a mutant that has to be detected changes a torque by 0.4 %.
inline constexpr double kWidestColumn = 0.002;
/// Share: a number with a wider band is explained.
inline constexpr double kWideNumber = 0.05;

/// Divisor of the step for `halved` in calibrate, or of the accuracy if the integrator chooses its steps.
double finer_by(const Physics& physics);

/// Setting that brings the widest band of `columns` below kWidestColumn, in the words of a message: a finer step or accuracy,
/// from the difference of `halved` (the run for the bands) and a still finer one; integrator `extrapolated` if the engine has
/// it; or a shorter run, if starts that differ by rounding diverge too far. Makes up to three runs.
std::string narrower_columns(const std::vector<Band>& columns, const Scenario& scenario, const GoldenRun& halved, int jobs,
                             const std::function<void(double)>& progress = {});

/// One line per number with a band wider than kWideNumber, the widest first (of more than three the first three, with the
/// number of others): the change that would not be detected, the reason, and the remedy. "" if there is none.
std::string wide_numbers(const Golden& golden, const Scenario& scenario);

/// `m3/active torque peak 42.2 %, ...`: the same numbers by name alone; "" if there is none.
std::string wide_number_names(const Golden& golden);

}  // namespace gaitlab::golden
