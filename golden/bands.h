// Differences between two runs, relative to the scale of each column and number, and the bands of a golden that follow from
// them.
#pragma once
#include <span>
#include <vector>

#include "core/recording/word.h"
#include "golden/golden.h"

namespace gaitlab::golden {

/// A number of the comparison with a log of the real robot, and its bound (MeasuredBounds).
struct BoundCheck {
  std::string name, unit;  ///< name as in a study: measured.angle.mae
  std::string log;         ///< file of the log; "" if the scenario contains its text
  double value = 0;        ///< NaN if the run covers fewer than two rows of the log
  double most = 0;
  [[nodiscard]] bool passed() const { return value <= most; }  // false if NaN
  [[nodiscard]] double ratio() const { return most > 0 ? value / most : value; }
};

/// Content of a golden from a run (trace with `t` first, numbers, word of the verdict), and data for messages about the run.
struct GoldenRun {
  Trace trace;
  std::vector<GoldenNumber> numbers;
  std::vector<std::string> joints = {};  ///< joint names, by their numbers in the columns
  std::vector<double> natural = {};  ///< natural scale of each column, in its unit; 0 if its unit has none (natural_scales.h)
  std::optional<Word> verdict = {};  ///< empty if the run was not judged
  std::string why = {};              ///< sentence that follows a word other than `feasible` (report/verdict/verdict.h)
  std::vector<BoundCheck> bounds = {};  ///< one for each bound of the scenario, if the run was judged
  int starts = 1;                       ///< number of runs of which the numbers are means (starts.h)
};

/// Scales of differences, one per column, in the unit of the column. A scale is the range of the column, but at least 1e-3 of
/// the largest range among columns of the same unit (base.y of a planar walk is noise), and at least 1e-6 of the unit (a
/// coordinate at rest).
std::vector<double> scales(const Trace& trace);
/// Scales for the trace of a golden with these bands. The scale of a constant column is its natural scale.
std::vector<double> scales(const Trace& trace, const std::vector<Band>& bands);

/// Scales of single numbers, computed as those of columns, but from the absolute value of the number instead of the range.
std::vector<double> scales(const std::vector<GoldenNumber>& numbers);

/// Mean square of the difference of a column between two traces with equal rows, in the unit of the column squared.
double mean_square(const Trace& a, const Trace& b, std::size_t column);

/// Mean square of the difference of every column. Golden::rounding is the mean square for a trace before and after it was
/// written to the golden's file.
std::vector<double> mean_squares(const Trace& a, const Trace& b);

inline constexpr double kEnsembleFactor = 10, kHalvingFactor = 3;  ///< factors from the measured differences to the bands
/// Widest band of a column that `gaitlab approve` accepts, as a share of the column's scale. Deliberate errors of the code that
/// the goldens must detect change a torque by 0.4 %.
inline constexpr double kWidestColumn = 0.002;
/// Range below which a column is constant, and least band of a constant column, as shares of its natural scale. The band is
/// above the effect of rounding errors on a robot at rest, and a torque of 1e-5 of the motor's torque is negligible.
inline constexpr double kConstantRange = 1e-6, kConstantBand = 1e-5;
/// Share of the natural scale below which a band is narrow enough for any range. A robot that stands on several faces bears its
/// weight with small torques. Start angles that differ by 1e-7 rad change these torques permanently, by 6e-6 of the motors'
/// torques.
inline constexpr double kNarrowBand = 1e-4;
/// Number of starts of a quantised scenario, whose numbers are means (starts.h).
inline constexpr int kStarts = 16;
/// Band of a mean over starts, in standard errors of the difference of two such means. Student's t with 15 degrees of freedom
/// exceeds 6 once in 40 000 numbers.
inline constexpr double kStandardErrors = 6;

struct Bands {
  std::vector<Band> columns, numbers;  ///< bands of the columns and of the numbers, as in Golden
};

/// Bands of the run `base`. The band of a column is the maximum of kEnsembleFactor x the largest RMS difference of a run of the
/// ensemble, kHalvingFactor x the RMS difference of the run with half the step, and 1e-6 of the range. The band of a number
/// follows from its differences in the same way. If `base` has means over starts, the ensemble is not needed: its part of the
/// band is kStandardErrors of the difference of two means. A band may be narrower than the precision of the stored golden,
/// because its rounding error is known exactly (Golden::rounding) and is subtracted. A column is constant if its range is below
/// kConstantRange of its natural scale, or if its band is wider than kWidestColumn of its range, but at most kNarrowBand of
/// that scale: its band is a share of the natural scale, at least kConstantBand. All runs must have at least the columns, rows
/// and numbers of `base`, with finite values. Throws std::invalid_argument if a run lacks a number.
Bands calibrate(const GoldenRun& base, std::span<const GoldenRun> ensemble, const GoldenRun& halved);

}  // namespace gaitlab::golden
