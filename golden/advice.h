// What narrows the bands of a golden that are too wide, and what those that stay wide let pass.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "golden/bands.h"

namespace gaitlab::golden {

/// Share: approve refuses a column whose band is wider, for a mutant that must be seen moves a torque by 0.4 %.
inline constexpr double kWidestColumn = 0.002;
/// Share: the band of a number is explained where it is wider.
inline constexpr double kWideNumber = 0.05;

/// What `halved` in calibrate divides the step by, or the accuracy where the integrator chooses its steps.
double finer_by(const Physics& physics);

/// What brings the widest band of `columns` below kWidestColumn, in the words of a message: a finer step or accuracy, by the
/// change from `halved` (the run that made the bands) to one that is finer still; integrator `extrapolated` where the
/// engine has it; or a shorter run, where starts that differ by rounding part too far. Makes up to
/// three runs.
std::string narrower_columns(const std::vector<Band>& columns, const Scenario& scenario, const GoldenRun& halved, int jobs,
                             const std::function<void(double)>& progress = {});

/// One line per number whose band is wider than kWideNumber, the widest first, of more than three the first three and how many
/// more: what would pass unseen, why, and the remedy. "" where there is none.
std::string wide_numbers(const Golden& golden, const Scenario& scenario);

/// `m3/active torque peak 42.2 %, ...`: the same numbers by name alone; "" where there is none.
std::string wide_number_names(const Golden& golden);

}  // namespace gaitlab::golden
