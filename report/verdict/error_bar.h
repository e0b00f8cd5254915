// The error bar of a part of a check, and the one rule for what bars leave undecided.
#pragma once
#include <algorithm>
#include <span>
#include <string>

#include "report/verdict/check.h"

namespace gaitlab {
struct Scenario;
}

namespace gaitlab::report {

/// The least and the largest share of its limit that a part takes; above 1 it is beyond the limit.
struct ErrorBar {
  std::string part;
  double error = 0;  ///< share by which the value may be off
  double least = 0, most = 0;
  static ErrorBar around(std::string part, double share, double error) {
    return {std::move(part), error, share * (1 - error), share * (1 + error)};
  }
  [[nodiscard]] bool beyond() const { return least > 1; }
  [[nodiscard]] bool across() const { return !beyond() && most > 1; }
};

/// True where the limit lies within the bar of a part, and no part is beyond its limit with its whole bar: one such part makes
/// a check fail, however near others are.
inline bool too_close(std::span<const ErrorBar> bars) {
  return std::ranges::any_of(bars, &ErrorBar::across) && std::ranges::none_of(bars, &ErrorBar::beyond);
}

/// Sets Check::error, that of the worst part. Where `bars` are too close to their limits so becomes the status, and the text
/// gains the remedy and the range of the worst part, or, where its limit is outside of its bar, of the one that may be the
/// farthest beyond.
void widen(const Scenario& scenario, std::span<const ErrorBar> bars, Check& made);

}  // namespace gaitlab::report
