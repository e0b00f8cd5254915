// Delay between two sampled signals.
#pragma once
#include <span>

namespace gaitlab {

struct TimeShift {
  double time = 0;  ///< s; positive: the second is late. 0 if no shift explains the difference
  double rms = 0;   ///< remaining RMS after the shift, in the signals' unit
};

/// The shift s that minimises the mean square of second(t + s) - first(t): the cross-correlation minus the energy of the
/// window, without which a drift would look like a shift; at whole samples first, then by a parabola through three of them,
/// between samples by cubic interpolation. Searched within the smaller of 5 % of the duration and 0.5 s; means over the rows
/// that have a partner at every such shift. The smallest of equally good shifts (a periodic signal). A shift counts only if at
/// most half of the RMS remains; else `time` is 0 and `rms` that of the unshifted signals over all rows. Both have the same
/// length and only finite values; `spacing` in s. Cost: at most about 1e6 products and 10 passes.
TimeShift best_shift(std::span<const double> first, std::span<const double> second, double spacing);

}  // namespace gaitlab
