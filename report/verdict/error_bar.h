// Error bar of a number, and the rule by which a check becomes `too close`.
#pragma once
#include <algorithm>
#include <span>
#include <string>

#include "report/verdict/check.h"

namespace gaitlab {
struct Scenario;
}

namespace gaitlab::report {

/// Range of value / limit of a joint, given the error of the value. A share above 1 is beyond the limit.
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

/// True if the limit lies within some joint's error bar, and no joint's error bar is completely beyond its limit. A joint that
/// is completely beyond makes the check fail, regardless of the others.
inline bool too_close(std::span<const ErrorBar> bars) {
  return std::ranges::any_of(bars, &ErrorBar::across) && std::ranges::none_of(bars, &ErrorBar::beyond);
}
inline bool certain(std::span<const ErrorBar> bars) { return std::ranges::any_of(bars, &ErrorBar::beyond); }

/// Sets Check::certain, and Check::error to the error of the worst part. If too_close(bars), also sets the status `too close`,
/// adds the range of a part to the text, and sets the remedy. The range is that of the worst part if its limit lies within its
/// error bar. Otherwise it is the range with the largest upper end among joints whose error bars contain their limits.
void widen(const Scenario& scenario, std::span<const ErrorBar> bars, Check& made);

}  // namespace gaitlab::report
