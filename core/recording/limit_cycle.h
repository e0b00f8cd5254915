// Detection of a limit cycle: its start and its period.
#pragma once
#include <cstddef>
#include <span>

namespace gaitlab {

/// Number of set-point periods that a verdict needs if the motion does not settle to a limit cycle.
inline constexpr double kPeriodsNeeded = 3;
inline constexpr double kMostCycleError = 0.02;  ///< largest `error` of a motion that repeats

/// Result of the search for a limit cycle. T is the period and x_c a column. The scale s_c is half the peak-to-peak value of
/// x_c over the last 2 T. It is at least 1e-3 rad, and at least a tenth of the scale of the largest column.
///     e(t) = max over c of RMS over [t, t + T] of (x_c(u + T) - x_c(u)) / s_c
/// `error` is e at the last possible t (two periods before the end). `found` means error < kMostCycleError.
struct MotionCycle {
  bool found = false;
  double from = 0;  ///< s after the first row: earliest sample t with e < kMostCycleError at t and at every later sample; 0 if
                    ///< no cycle is found
  double period = 0;      ///< shortest period found, s; else the period of the best candidate; 0 without candidates
  double error = 1;       ///< error of that period; 1 without candidates
  std::size_t pairs = 0;  ///< samples compared with a later sample: the cost of the search, which grows with the rows
};

/// Searches for the shortest period in rows x columns of angles and set points (rad, row-major, sampled every `sample_period`
/// s, without gaps). The search requires finite numbers, at least 12 rows, at least 5 samples per period, and two periods in
/// the data. It finds nothing if no motion repeats to 2 %. It also finds nothing if no column moves by more than 2e-3 rad over
/// the last two periods, because any period would then fit.
///
/// Columns that are constant between control ticks (set points) are first joined by straight lines. Otherwise a period that is
/// not a multiple of the tick would shift the samples from cycle to cycle, and the shift would count as an error. A lag is
/// first tested on at most 256 points of its window, in steps of 1/256 of the lag, then at every sample. The vertex of a
/// parabola gives the period between samples. The search takes about 10 ms for 4001 rows x 32 columns.
MotionCycle find_limit_cycle(std::span<const double> values, std::size_t columns, double sample_period);

}  // namespace gaitlab
