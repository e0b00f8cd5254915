// Supplies of the lanes of a simulation, which turn the commands of controllers into commands of motors.
#include <algorithm>
#include <limits>

#include "core/simulation/lane.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

void Simulation::make_supplies() {
  if (actuator_ == nullptr) return;
  for (const auto& lane : lanes_) {
    if (lane->controller == nullptr) continue;
    lane->supply = LaneSupply(lane->scenario, lane->changes, actuator_->dc_motors(), lane->index, lanes_.size());
    bounded_ = bounded_ || lane->supply.any();
    buses_ = std::max(buses_, lane->supply.buses());
  }
}

/// Converts the commands of a lane to volts and bounds them by the voltage of its bus.
void Simulation::supply(Lane& lane) {
  if (!bounded_) return;
  const std::size_t lanes = lanes_.size();
  const In speeds = motor_speeds();
  for (std::size_t j = 0; j < layout_.joints; ++j) lane.speed_now[j] = speeds[j * lanes + lane.index];
  std::fill(lane.bound.begin(), lane.bound.end(), std::numeric_limits<double>::infinity());
  lane.supply.apply(lane.changes.segment(), lane.speed_now, lane.command, lane.bound);
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    const std::size_t i = j * lanes + lane.index;
    command_[i] = lane.command[j];
    bound_[i] = lane.bound[j];
    within_bound_[i] = std::clamp(command_[i], -bound_[i], bound_[i]);
  }
  for (std::size_t b = 0; b < lane.supply.buses(); ++b) {
    const BusState& bus = lane.supply.states()[b];
    const std::size_t at = 2 * (b * lanes + lane.index);
    bus_[at] = bus.voltage;
    bus_[at + 1] = bus.current;
  }
  if (recorded(lane)) lane.recorder->add_buses(lane.supply.states());
}

}  // namespace gaitlab
