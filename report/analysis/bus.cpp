#include "report/analysis/bus.h"

#include <algorithm>
#include <cmath>

namespace gaitlab::report {

double BusUse::endurance(double capacity) const {
  constexpr double kMinutes = 60;  // of an hour
  return capacity > 0 && current > 0 ? kMinutes * capacity / current : NAN;
}

std::optional<BusUse> bus_use(const Recording& record, std::size_t first) {
  const Trace& bus = record.supply;
  if (bus.rows() < 2 || first + 1 >= bus.rows()) return {};
  BusUse made;
  made.voltage_least = INFINITY;
  for (std::size_t k = first + 1; k < bus.rows(); ++k) {
    if (!std::ranges::all_of(bus.row(k), [](double value) { return std::isfinite(value); })) return {};
    if (bus.at(k, kLeastVoltage) < made.voltage_least) {
      made.voltage_least = bus.at(k, kLeastVoltage);
      made.least_time = bus.at(k, 0);
    }
    made.current_peak = std::max(made.current_peak, bus.at(k, kLargestCurrent));
    made.held = made.held && bus.at(k, kHeld) > 0;
  }
  const std::size_t last = bus.rows() - 1;
  const double time = bus.at(last, 0) - bus.at(first, 0);
  if (!(time > 0)) return {};
  made.current = (bus.at(last, kCharge) - bus.at(first, kCharge)) / time;
  made.current_rms = std::sqrt(std::max(0.0, bus.at(last, kBusSquare) - bus.at(first, kBusSquare)) / time);
  return made;
}

}  // namespace gaitlab::report
