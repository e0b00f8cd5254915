// Error bar of a part of a check, and the rule for undecided checks.
#pragma once
#include <algorithm>
#include <span>
#include <string>

#include "report/verdict/check.h"

namespace gaitlab {
struct Scenario;
}

namespace gaitlab::report {

/// Range of the share of its limit that a part uses; above 1 it is beyond the limit.
struct ErrorBar {
  std::string part;
  double error = 0;  ///< relative error of the value
  double least = 0, most = 0;
  static ErrorBar around(std::string part, double share, double error) {
    return {std::move(part), error, share * (1 - error), share * (1 + error)};
  }
  [[nodiscard]] bool beyond() const { return least > 1; }
  [[nodiscard]] bool across() const { return !beyond() && most > 1; }
};

/// Whether the limit lies within the bar of some part, and no part is beyond its limit with its whole bar: one such part makes
/// a check fail, regardless of the others.
inline bool too_close(std::span<const ErrorBar> bars) {
  return std::ranges::any_of(bars, &ErrorBar::across) && std::ranges::none_of(bars, &ErrorBar::beyond);
}

/// Sets Check::error to that of the worst part. If `bars` are too close to their limits the status becomes so, and the text
/// gains the remedy and the range of the worst part or, if its limit is outside of its bar, of the part that may be farthest
/// beyond.
void widen(const Scenario& scenario, std::span<const ErrorBar> bars, Check& made);

}  // namespace gaitlab::report
