// Friction and rotor inertia of motors that are only chosen: neither the scenario nor a module type states them.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

/// Keys of an actuator whose values count as chosen where they are not stated
/// (docs/decisions/0052-a-servo-has-losses.md).
inline constexpr std::array<const char*, 4> kChosenFriction{"dry_friction", "viscous_friction", "load_friction",
                                                            "rotor_inertia"};

/// Setting in the form of --set that multiplies the chosen values of `key` by `factor`; stated values of other joints stay.
/// Empty if the actuator has no such key, or states it for every motor.
std::string times_chosen(const Scenario& scenario, const std::string& key, double factor);

/// Settings that take all chosen friction and rotor inertia away; empty if nothing is chosen.
std::vector<std::string> without_chosen_friction(const Scenario& scenario);

}  // namespace gaitlab
