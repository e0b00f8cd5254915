// Registration of the engine `articulated`, and its integrators over other forward dynamics.
#pragma once
#include <memory>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/simulation/plant.h"
#include "physics_articulated/other_dynamics.h"

namespace gaitlab {

/// Registers the articulated-body algorithm of gaitlab with implicit integration (adaptive, implicit, extrapolated) and rk4.
void register_articulated(Catalog& catalog);

inline constexpr double kImplicitStep = 5e-4;  ///< default step of implicit integrators with given steps, s

/// Integrators that are implicit in motors, stops and contacts; the first is adaptive.
std::vector<Integrator> implicit_integrators();
/// Plant of one lane with one of these integrators, under the weight, centrifugal and gyroscopic forces of `dynamics`.
std::unique_ptr<Plant> make_implicit_plant(const PlantSettings& settings, std::unique_ptr<articulated::OtherDynamics> dynamics);

}  // namespace gaitlab
