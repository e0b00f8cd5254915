// Differences between two runs on the scale of each column and number, and the bands of a golden that follow from them.
#pragma once
#include <span>
#include <vector>

#include "golden/golden.h"

namespace gaitlab::golden {

/// Content of a golden from a run: trace (`t` first), numbers and the verdict's word; and data for messages on it.
struct GoldenRun {
  Trace trace;
  std::vector<Number> numbers;
  std::vector<std::string> joints = {};  ///< names, by their numbers in the columns
  std::string verdict = {};              ///< `feasible`; empty: not judged
  std::string why = {};                  ///< sentence after a word that is not `feasible` (report/verdict/verdict.h)
};

/// Scales of differences, one per column, in its unit: the column's range, but at least 1e-3 of the largest range among the
/// columns of the same unit (base.y of a planar walk is noise), and at least 1e-6 of the unit (as is a coordinate at rest).
std::vector<double> scales(const Trace& trace);

/// Scales of numbers, with the magnitude in place of the range.
std::vector<double> scales(const std::vector<Number>& numbers);

/// Mean square of the difference of a column, in its unit squared. Both have the same rows.
double mean_square(const Trace& a, const Trace& b, std::size_t column);

/// The same for every column: Golden::rounding, from a run before and after it was written to the golden's file.
std::vector<double> mean_squares(const Trace& a, const Trace& b);

inline constexpr double kEnsembleFactor = 10, kHalvingFactor = 3;  ///< factors from the measured differences to bands

struct Bands {
  std::vector<Band> columns, numbers;  ///< as in Golden
};

/// The bands of `base`: per column max(kEnsembleFactor x the largest RMS difference of a run of the ensemble, kHalvingFactor x
/// that of the run with half the step, 1e-6 of the range); per number the same of its difference. These may be below the
/// golden's precision: its rounding error is known exactly (Golden::rounding) and subtracted. All runs have the columns, rows
/// and numbers of `base` (and maybe others), and finite values. Throws std::invalid_argument if one lacks a number.
Bands calibrate(const GoldenRun& base, std::span<const GoldenRun> ensemble, const GoldenRun& halved);

}  // namespace gaitlab::golden
