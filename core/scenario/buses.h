// Buses of a scenario: the supplies of its motors, each with the joints that share it.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

struct MotorBus {
  std::string module = {};  ///< `m3` for the battery of a module; "" for the scenario's supply
  Supply supply = {};
  std::vector<std::size_t> joints = {};  ///< driven joints, in ascending order

  /// Name at the head of columns: `supply` or `battery.m3`.
  [[nodiscard]] std::string name() const { return module.empty() ? "supply" : "battery." + module; }
};

/// The scenario's supply, if there is one and some motor has no battery, then the batteries of modules with motors.
std::vector<MotorBus> buses(const Scenario& scenario);

/// Supply of the motor of a joint: the battery of its module, or else the supply of the scenario, which may have no voltage.
const Supply& supply_of(const Scenario& scenario, std::size_t joint);

}  // namespace gaitlab
