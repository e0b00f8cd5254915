// Detection of a limit cycle: its start and its period.
#pragma once
#include <cstddef>
#include <span>

namespace gaitlab {

/// Result of the search. With T the period, x_c a column and s_c = half its peak-to-peak over the last 2 T, at least a tenth of
/// the largest column's and 1e-3 rad:
///     e(t) = max over c of RMS over [t, t + T] of (x_c(u + T) - x_c(u)) / s_c
/// `error` is e at the last possible t (two periods before the end); found means error < 0.02.
struct MotionCycle {
  bool found = false;
  double from =
      0;  ///< s after the first row: the earliest sample t with e < 0.02 there and at every later sample; 0 if not found
  double period = 0;  ///< s; the shortest period found, else that of the best candidate, 0 without one
  double error = 1;   ///< of that period; 1 without a candidate
};

/// Searches rows x columns of angles and set points (rad, row-major, sampled every `sample_period` s, without gaps) for the
/// shortest period. Not found: less than two periods in the data; no repetition to 2 %; no motion: no column moves by more than
/// 2e-3 rad over the last two periods (any period would fit); a number that is not finite; fewer than 12 rows; periods below 5
/// samples. Columns that are held between control ticks (set points) are joined by straight lines first: a period that is not a
/// multiple of the tick would otherwise shift the steps from cycle to cycle and count as an error. A lag is first tested on at
/// most 256 points of its window, in steps of 1/256 of the lag, then at every sample, and the period between samples is the
/// vertex of a parabola. About 10 ms for 4001 rows x 32 columns.
MotionCycle find_limit_cycle(std::span<const double> values, std::size_t columns, double sample_period);

}  // namespace gaitlab
