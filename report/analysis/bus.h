// Numbers of the supply in a run.
#pragma once
#include <optional>

#include "core/recording/recording.h"

namespace gaitlab::report {

/// The bus in a part of a run, at its control ticks.
struct BusUse {
  double voltage_least = 0, least_time = 0;               ///< V, and its time, s
  double current_peak = 0, current_rms = 0, current = 0;  ///< A; `current` is the mean
  bool held = true;                                       ///< false if no voltage satisfied the law of the bus at some tick
};

/// The bus with this number (buses()), from row `first` of Recording::supply to its end; nothing if the run has no such bus, or
/// if a number is not finite.
std::optional<BusUse> bus_use(const Recording& record, std::size_t bus, std::size_t first);

}  // namespace gaitlab::report
