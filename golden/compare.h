// Comparison of a run with its golden, which finds the columns and numbers outside their bands.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "golden/bands.h"

namespace gaitlab::golden {

inline constexpr double kOutside = 3;  ///< number of bands; an error whose RMS is one band rarely exceeds it

/// Comparison of one column. `name` is the name in the trace, and `label` is a readable form, such as `m7/passive torque`.
/// Shares are relative to the column's scale (bands.h). The rounding error of the golden is subtracted, so that equal runs
/// differ by 0 and differences below the precision are measured correctly.
struct ColumnCheck {
  std::string name, label, unit;
  double rms = 0, maximum = 0;         ///< RMS and maximum of the difference, shares of the scale
  double band = 0;                     ///< share of the scale; the check passes if rms <= band
  double scale = 0;                    ///< scale, in the unit of the column
  bool constant = false;               ///< true if the scale is the natural one, not the range
  double time_shift = 0;               ///< s; positive if the run is late (best_shift); 0 if no shift explains the difference
  double rms_after_shift = 0;          ///< share of the scale; equal to rms if time_shift is 0
  std::optional<double> outside = {};  ///< first time at which the difference exceeds kOutside bands, s
  [[nodiscard]] bool passed() const { return rms <= band; }  // false if rms is NaN
  [[nodiscard]] double ratio() const { return band > 0 ? rms / band : rms; }
};

/// Share of the scale; sums over steps differ by 3e-5 between the engines with steps of 25 us.
inline constexpr double kOtherEngine = 1e-4;

struct NumberCheck {
  std::string name, label, unit;
  double golden = 0, now = 0;
  double change = 0, band = 0;  ///< shares of the scale; the check passes if change <= band
  [[nodiscard]] bool passed() const { return change <= band; }
  [[nodiscard]] double ratio() const { return band > 0 ? change / band : change; }
};

struct GoldenDifference {
  /// Sentences on differences of form, which are found before any numbers are compared: values that are not finite, rows,
  /// columns, and time base.
  std::vector<std::string> findings;
  std::vector<ColumnCheck> columns;  ///< columns of both runs with finite values, in the order of the golden
  std::vector<NumberCheck> numbers;
  std::vector<BoundCheck> bounds = {};  ///< those of the run, which compare() leaves out

  [[nodiscard]] bool passed() const;
  [[nodiscard]] const ColumnCheck* worst_column() const;  ///< column with the largest ratio, or null without columns
  [[nodiscard]] const NumberCheck* worst_number() const;
  [[nodiscard]] const BoundCheck* worst_bound() const;
};

/// Compares a run with the golden: first the columns and the times of the rows, then the values over the common rows, then the
/// numbers. Maximum, shift and first time outside do not decide, because a contact that changes one step earlier alters a
/// maximum by tens of percent. `other_engine` is true if the run used another engine than the golden. Columns are compared in
/// the same way for any engine. Numbers of another engine have bands of at least kOtherEngine, because they depend on every
/// step. Peak torques of joints are then omitted, because they occur in the first step after a control tick, for which one
/// method evaluates the motor at the start and another takes the mean (10 % difference).
/// If `halved`, the same run with half its step, is given, every band is wider by kHalvingFactor x the change from `run` to it:
/// the bands of the golden are those of the golden's own step.
GoldenDifference compare(const Golden& golden, const GoldenRun& run, bool other_engine = false,
                         const GoldenRun* halved = nullptr);

}  // namespace gaitlab::golden
