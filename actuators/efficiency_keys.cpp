#include "actuators/efficiency_keys.h"

#include <array>

namespace gaitlab::actuators {

namespace {
constexpr std::array kEfficiencyModels{"paper", "directional"};
}

void EfficiencyKeys::fields(Fields& f) {
  f.choice("efficiency_model", efficiency_model, kEfficiencyModels,
           "`paper`: the torque is always multiplied by eta, as in eq. 2; `directional`: by eta if the motor drives, by 1/eta "
           "if it is back-driven.");
  f.number(
      "turn_speed", turn_speed,
      {"rad/s", 1e-6, 1e3,
       "Joint speed at which the factor of `directional` has changed from 1 to eta or 1/eta, under an explicit integrator."});
}

}  // namespace gaitlab::actuators
