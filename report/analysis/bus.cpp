#include "report/analysis/bus.h"

#include <algorithm>
#include <cmath>

namespace gaitlab::report {

double BusUse::endurance(double capacity) const {
  constexpr double kMinutes = 60;  // of an hour
  return capacity > 0 && current > 0 ? kMinutes * capacity / current : NAN;
}

std::optional<BusUse> bus_use(const Recording& record, std::size_t bus, std::size_t first) {
  const std::size_t rows = record.supply.rows();
  if (bus >= record.buses() || rows < 2 || first + 1 >= rows) return {};
  const auto at = [&](std::size_t row, SupplyColumn column) { return record.bus(row, bus, column); };
  BusUse made;
  made.voltage_least = INFINITY;
  for (std::size_t k = first + 1; k < rows; ++k) {
    if (!std::ranges::all_of(record.supply.row(k), [](double value) { return std::isfinite(value); })) return {};
    if (at(k, kLeastVoltage) < made.voltage_least) {
      made.voltage_least = at(k, kLeastVoltage);
      made.least_time = record.supply.at(k, 0);
    }
    made.current_peak = std::max(made.current_peak, at(k, kLargestCurrent));
    made.held = made.held && at(k, kHeld) > 0;
  }
  const std::size_t last = rows - 1;
  const double time = record.supply.at(last, 0) - record.supply.at(first, 0);
  if (!(time > 0)) return {};
  made.current = (at(last, kCharge) - at(first, kCharge)) / time;
  made.current_rms = std::sqrt(std::max(0.0, at(last, kBusSquare) - at(first, kBusSquare)) / time);
  return made;
}

Endurance endurance(const Scenario& scenario, const Recording& record, std::size_t first) {
  Endurance least;
  const std::vector<MotorBus> all = buses(scenario);
  for (std::size_t number = 0; number < all.size(); ++number) {
    const std::optional<BusUse> use = bus_use(record, number, first);
    const double capacity = all[number].supply.capacity;
    const double minutes = use ? use->endurance(capacity) : NAN;
    if (!std::isnan(minutes) && !(minutes >= least.minutes)) least = {minutes, capacity, use->current, all[number].module};
  }
  return least;
}

}  // namespace gaitlab::report
