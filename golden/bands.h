// How far apart two runs are, on the scale of each column and number; and the bands that follow.
#pragma once
#include <span>
#include <vector>

#include "golden/golden.h"

namespace gaitlab::golden {

/// What a golden keeps of a run: trace (`t` first), figures and the verdict's word; and what messages on it need.
struct GoldenRun {
  Trace trace;
  std::vector<Number> numbers;
  std::vector<std::string> joints = {};  ///< names, by their numbers in the columns
  std::string verdict = {};              ///< `feasible`; empty: not asked for
  std::string why = {};                  ///< a sentence behind a word that is not `feasible` (report/verdict/verdict.h)
};

/// What differences are relative to, one a column, in its unit: the column's range, but at least 1e-3 of the largest range
/// among the columns of the same unit (a planar walk's base.y is noise), and at least 1e-6 of the unit (so is what stands
/// still).
std::vector<double> scales(const Trace& trace);

/// The same for numbers, with the magnitude for the range.
std::vector<double> scales(const std::vector<Number>& numbers);

/// Mean square of the difference of a column, in its unit squared. Both have the same rows.
double mean_square(const Trace& a, const Trace& b, std::size_t column);

/// The same of every column: Golden::rounding, from a run as it was and as its golden's file gives it back.
std::vector<double> mean_squares(const Trace& a, const Trace& b);

inline constexpr double kEnsembleFactor = 10, kHalvingFactor = 3;  ///< bands over what was measured

struct Bands {
  std::vector<Band> columns, numbers;  ///< as in Golden
};

/// The bands of `base`: per column max(kEnsembleFactor x the largest RMS difference of a run of the ensemble, kHalvingFactor x
/// that of the run with half the step, 1e-6 of the range); per number the same of its difference. That is below the golden's
/// precision: what rounding took is known exactly (Golden::rounding) and taken off. All runs have the columns, rows and numbers
/// of `base` (and maybe others), and finite values. std::invalid_argument: one lacks a number.
Bands calibrate(const GoldenRun& base, std::span<const GoldenRun> ensemble, const GoldenRun& halved);

}  // namespace gaitlab::golden
