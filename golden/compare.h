// Whether a run is still the golden one, and what strayed where.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "golden/bands.h"

namespace gaitlab::golden {

inline constexpr double kOutside = 3;  ///< bands; an error whose RMS is one band rarely exceeds three bands

/// One column. `name` is that of the trace, `label` for people: `m7/passive torque`. Shares are of its scale (bands.h); what
/// the golden's own rounding explains is taken off, so that the same run differs by 0 and one that differs by less than the
/// precision is measured right.
struct ColumnCheck {
  std::string name, label, unit;
  double rms = 0, maximum = 0;         ///< share
  double band = 0;                     ///< share; the gate is rms <= band
  double scale = 0;                    ///< in the unit
  double time_shift = 0;               ///< s; positive: the run is late (see best_shift); 0 where no shift explains it
  double rms_after_shift = 0;          ///< share; rms where time_shift is 0
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
  /// What makes the run another, before any number: values that are not finite, rows, columns, time base; a sentence each.
  std::vector<std::string> findings;
  std::vector<ColumnCheck> columns;  ///< those that both have and that are finite, in the golden's order
  std::vector<NumberCheck> numbers;

  [[nodiscard]] bool passed() const;
  [[nodiscard]] const ColumnCheck* worst_column() const;  ///< by ratio; nullptr: none
  [[nodiscard]] const NumberCheck* worst_number() const;
};

/// Compares a run with the golden: form first, then every column over the rows that both have, then the numbers. The maximum,
/// the shift and the first time outside are reported only: one contact that switches a step earlier moves a maximum by tens of
/// percent.
/// `other_engine`: the run is by another than the golden's. Columns are judged alike, for they depend on neither. The numbers
/// are over all steps: a joint's largest torque is that of a control tick's first step, at whose start one method asks the
/// motor and of which another takes the mean (10 % apart), and is left out; the others have bands of at least kOtherEngine.
GoldenDifference compare(const Golden& golden, const GoldenRun& run, bool other_engine = false);

}  // namespace gaitlab::golden
