// Comparison of a run with its golden: columns and numbers outside their bands.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "golden/bands.h"

namespace gaitlab::golden {

inline constexpr double kOutside = 3;  ///< bands; an error whose RMS is one band rarely exceeds it

/// Comparison of one column. `name` is that of the trace, `label` is readable: `m7/passive torque`. Shares are of its scale
/// (bands.h); the golden's rounding error is subtracted, so that the same run differs by 0 and a difference below the precision
/// is measured correctly.
struct ColumnCheck {
  std::string name, label, unit;
  double rms = 0, maximum = 0;         ///< share
  double band = 0;                     ///< share; the gate is rms <= band
  double scale = 0;                    ///< in the unit
  double time_shift = 0;               ///< s; positive: the run is late (see best_shift); 0 if no shift explains the difference
  double rms_after_shift = 0;          ///< share; rms if time_shift is 0
  std::optional<double> outside = {};  ///< s; first time at which the difference exceeds kOutside bands
  [[nodiscard]] bool passed() const { return rms <= band; }  // false for NaN
  [[nodiscard]] double ratio() const { return band > 0 ? rms / band : rms; }
};

inline constexpr double kOtherEngine = 1e-4;  ///< share; sums over steps differ by 3e-5 between the engines at 25 us

struct NumberCheck {
  std::string name, label, unit;
  double golden = 0, now = 0;
  double change = 0, band = 0;  ///< share of the scale; the gate is change <= band
  [[nodiscard]] bool passed() const { return change <= band; }
  [[nodiscard]] double ratio() const { return band > 0 ? change / band : change; }
};

struct GoldenDifference {
  /// Differences of form, found before any number is compared: values that are not finite, rows, columns, time base; a sentence
  /// each.
  std::vector<std::string> findings;
  std::vector<ColumnCheck> columns;  ///< finite columns of both, in the golden's order
  std::vector<NumberCheck> numbers;

  [[nodiscard]] bool passed() const;
  [[nodiscard]] const ColumnCheck* worst_column() const;  ///< by ratio; nullptr: none
  [[nodiscard]] const NumberCheck* worst_number() const;
};

/// Compares a run with the golden: form first, then every column over the common rows, then the numbers. The maximum, the shift
/// and the first time outside are reported only: one contact that switches a step earlier moves a maximum by tens of percent.
/// `other_engine`: the run used another engine than the golden. Columns are judged in the same way, because they do not depend
/// on it. Numbers are over all steps. Peak torques of joints are left out: they occur in the first step after a control tick,
/// for which one method evaluates the motor at the start and another takes the mean (10 % apart). The other numbers have bands
/// of at least kOtherEngine.
GoldenDifference compare(const Golden& golden, const GoldenRun& run, bool other_engine = false);

}  // namespace gaitlab::golden
