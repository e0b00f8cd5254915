// Whether one period is a whole number of another, and which ones would be. All in s.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"

namespace gaitlab {

/// Nearest whole number of `step`s in `period` if it fits within 1e-9 relative, else 0.
double whole_multiple(double period, double step);

/// Up to two steps, one on each side of `step`, of which all `periods` are whole multiples; short decimals are preferred.
std::vector<double> fitting_steps(const std::vector<double>& periods, double step);

/// The longest step of an integrator that divides it as it needs, s: beyond, contacts that come and go are missed
/// (docs/equations.md, 7).
constexpr double kLongestStep = 5e-3;

/// The longest such step that is a whole part of the control period.
double longest_step(double control_period);

/// Up to two whole multiples of `step`, one on each side of `period`.
std::vector<double> fitting_periods(double period, double step);

/// A period as the user knows it.
struct Period {
  std::string name;
  double value = 0;
  std::optional<SourceLocation> given = {};  ///< where; nothing: it is a default
};

/// A problem for each period that is not a whole multiple of the step: at the period's place, or the step's where only that is
/// given, or `otherwise`.
void check_periods(const std::vector<Period>& periods, const Period& step, const SourceLocation& otherwise, Problems& problems);

}  // namespace gaitlab
