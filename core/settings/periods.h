// Divisibility of periods, and the nearest periods that divide each other, s.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"

namespace gaitlab {

/// Up to two steps of which all `periods` are whole multiples: one on each side of `step`. Short decimals are preferred.
std::vector<double> fitting_steps(const std::vector<double>& periods, double step);

/// Longest step for integrators that divide their steps, s. Longer steps would miss short contacts (docs/equations.md, 7).
constexpr double kLongestStep = 5e-3;

/// The longest step, at most kLongestStep, that divides the control period.
double longest_step(double control_period);

/// Up to two whole multiples of `step`, one on each side of `period`.
std::vector<double> fitting_periods(double period, double step);

/// True if `period` is a whole multiple of `step`.
bool is_multiple(double period, double step);

/// A period with its name for the user.
struct Period {
  std::string name;
  double value = 0;
  std::optional<SourceLocation> given = {};  ///< place of the value; nothing for a default
};

/// Adds a problem for each period that is not a whole multiple of the step. The place of the problem is the place of the
/// period, or of the step if only the step is given, or `otherwise` if neither is given.
void check_periods(const std::vector<Period>& periods, const Period& step, const SourceLocation& otherwise, Problems& problems);

}  // namespace gaitlab
