// Numbers of the supply in a run.
#pragma once
#include <cmath>
#include <optional>
#include <string>

#include "core/recording/recording.h"
#include "core/scenario/buses.h"

namespace gaitlab::report {

/// The bus in a part of a run, at its control ticks.
struct BusUse {
  double voltage_least = 0, least_time = 0;               ///< V, and its time, s
  double current_peak = 0, current_rms = 0, current = 0;  ///< A; `current` is the mean
  bool held = true;                                       ///< false if no voltage satisfied the law of the bus at some tick
  /// Time until the mean current has drawn this charge, min, or NaN. `capacity`: A h; 0: not stated.
  [[nodiscard]] double endurance(double capacity) const;
};

/// The bus with this number (buses()), from row `first` of Recording::supply to its end; nothing if the run has no such bus, or
/// if a number is not finite.
std::optional<BusUse> bus_use(const Recording& record, std::size_t bus, std::size_t first);

/// Time until a supply or battery is empty, the first of all.
struct Endurance {
  double minutes = NAN;              ///< NaN if no capacity is stated, or no current flows
  double capacity = 0, current = 0;  ///< A h; A, mean
  std::string module = {};           ///< module of the battery; "" for the scenario's supply
};
/// `first`: as of bus_use().
Endurance endurance(const Scenario& scenario, const Recording& record, std::size_t first);

}  // namespace gaitlab::report
