// Faults of motors and hinges in a simulation, which are passed to actuators and plant while they are in force.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simulation/faulty_actuator.h"
#include "core/simulation/lane.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

/// Called before the plant is made. Without faults of motors or hinges, the actuators remain as they are.
void Simulation::prepare_faults() {
  const auto changes = [](const auto& lane) { return lane->changes.change_joints(); };
  if (actuator_ == nullptr || std::ranges::none_of(lanes_, changes)) return;
  const auto wrap = [&](std::unique_ptr<Actuator>& actuator, std::size_t lanes) {
    auto faulty = std::make_unique<FaultyActuator>(std::move(actuator), layout_.joints * lanes);
    FaultyActuator* const all = faulty.get();
    actuator = std::move(faulty);
    return all;
  };
  faulty_ = wrap(actuator_, lanes_.size());
  if (own_actuator_) own_faulty_ = wrap(own_actuator_, recorded_);
  hold_.assign(layout_.joints * lanes_.size(), std::numeric_limits<double>::quiet_NaN());
  stuck_for_.assign(hold_.size(), 0.0);
}

/// Passes the faults in force to actuators and plant if the faults have changed, by a change of the scenario or by a snapshot
/// that was written back, or if the hold of a stuck hinge still grows. A lane that has ended does not have faults.
void Simulation::apply_faults() {
  if (faulty_ == nullptr) return;
  constexpr double kFree = std::numeric_limits<double>::quiet_NaN();
  bool changed = false;
  for (const auto& lane : lanes_) {
    for (std::size_t j = 0; j < layout_.joints; ++j) {
      const std::size_t i = j * lanes_.size() + lane->index;
      const FaultInForce own = lane->closed ? FaultInForce() : lane->changes.fault(j);
      const double hold = lane->closed ? kFree : lane->changes.hold(j);
      const double since = lane->closed ? 0 : lane->changes.stuck_for(j, time(*lane));
      const bool same = since == stuck_for_[i] && (hold == hold_[i] || (std::isnan(hold) && std::isnan(hold_[i])));
      hold_[i] = hold;
      stuck_for_[i] = since;
      const FaultyActuator::Fault fault{own.kind == FaultKind::open, own.kind == FaultKind::weak ? own.share : 1};
      changed = faulty_->set(i, fault) || changed || !same;
      if (own_faulty_ != nullptr && lane->index < recorded_) own_faulty_->set(j * recorded_ + lane->index, fault);
    }
  }
  if (changed) plant_->change_joints(hold_, stuck_for_);
}

}  // namespace gaitlab
