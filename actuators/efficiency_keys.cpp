#include "actuators/efficiency_keys.h"

#include <array>

namespace gaitlab::actuators {

namespace {
constexpr std::array kEfficiencyModels{"paper", "directional"};
}

void EfficiencyKeys::fields(Fields& f) {
  f.choice("efficiency_model", efficiency_model, kEfficiencyModels,
           "paper: torque times eta always, as in eq. 2; directional: eta if the motor drives, 1/eta if it is back-driven.");
  f.number("turn_speed", turn_speed,
           {"rad/s", 1e-6, 1e3, "Joint speed at which `directional` has changed from 1 to eta or 1/eta."});
}

}  // namespace gaitlab::actuators
