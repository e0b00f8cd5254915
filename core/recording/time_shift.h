// Delay between two sampled signals.
#pragma once
#include <span>

namespace gaitlab {

struct TimeShift {
  double time = 0;  ///< s; positive if the second signal is late; 0 if no shift explains the difference
  double rms = 0;   ///< RMS of the difference after the shift, in the unit of the signals
};

/// Returns the shift s that minimises the mean square of second(t + s) - first(t). This criterion is the cross-correlation
/// minus the energy of the window; without the energy, a drift would look like a shift. The search tests whole samples first,
/// then the vertex of a parabola through three samples, with cubic interpolation between samples. Shifts are at most 5 % of the
/// duration and at most 0.5 s. Means are over the rows that have a partner at every such shift.
///
/// If several shifts are equally good (a periodic signal), the result is the smallest. A shift counts only if at most half of
/// the RMS remains. Otherwise `time` is 0, and `rms` is the RMS difference of the unshifted signals over all rows. Both signals
/// must have the same length and only finite values; `spacing` is in s. The cost is at most about 1e6 products and 10 passes.
TimeShift best_shift(std::span<const double> first, std::span<const double> second, double spacing);

}  // namespace gaitlab
