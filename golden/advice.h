// Advice on bands of a golden that are too wide: settings that narrow them, and changes that they would not detect.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "golden/bands.h"

namespace gaitlab::golden {

/// Band of a number, as a share of its scale, above which the width is explained.
inline constexpr double kWideNumber = 0.05;

/// Divisor of the step, or of the accuracy if the integrator chooses its steps, for the run `halved` of calibrate().
double finer_by(const Physics& physics);

/// Setting that should reduce the widest band of `columns` to less than kWidestColumn, as text for a message. It is a finer
/// step or accuracy, computed from the run `halved` and a still finer run; or integrator `extrapolated` if the engine has it.
/// It is a shorter run if runs whose start angles differ by 1e-7 rad diverge too far. Makes up to three runs.
std::string narrower_columns(const std::vector<Band>& columns, const Scenario& scenario, const GoldenRun& halved, int jobs,
                             const std::function<void(double)>& progress = {});

/// One line per number with a band wider than kWideNumber, widest first: the change that would not be detected, the reason, and
/// the remedy. After three lines, a last line gives the count of the omitted lines. "" if no band is that wide.
std::string wide_numbers(const Golden& golden, const Scenario& scenario);

/// Names of the numbers in wide_numbers(), as in `m3/active torque peak 42.2 %, ...`. "" if there is none.
std::string wide_number_names(const Golden& golden);

}  // namespace gaitlab::golden
