#include "actuators/dc_motor.h"

#include <algorithm>
#include <array>

namespace gaitlab::actuators {

namespace {
constexpr std::array kEfficiencyModels{"paper", "directional"};
}

const char* const DcMotorActuator::kManual = R"(A DC motor behind a gear; inductance neglected.

    i = (u - Ks n w) / R      |u| <= u_max (driver supply)
    T = eta Kt i n            |i| <= i_max (absolute rating)

u: command, V; w: joint speed, rad/s; T: torque on the joint, N m. Saturation is counted: 1 voltage, 2 current.
voltage = R i + Ks n w, the terminal voltage; electrical power = voltage * i.

Eq. 2 as printed (efficiency_model: paper) multiplies the torque by eta in both directions, so that a joint that drives its
motor gains energy; the summary shows how much. efficiency_model: directional takes the loss from the driving side:

    T = eta^s Kt i n          s = w sign(i) / turn_speed, within [-1, 1]

The factor is eta while the motor drives and 1 / eta while it is driven. Implicit integrators have the jump at w = 0, where the
joint can stick (s = sign(w i)); turn_speed smooths it under explicit ones.
Source: Chariot, Filippi, Verlinden 2012, eq. 1 and 2. Defaults (chosen): a 6 V, 2 W coreless motor driven at 7.4 V.
Takes commands in V.

    actuator: {type: dc_motor, i_max: 0.8})";

void DcMotorActuator::Settings::fields(Fields& f) {
  f.per_joint("R", R, {"ohm", 1e-6, 1e6, "Terminal resistance."});
  f.per_joint("Kt", Kt, {"N m/A", 0, 1e3, "Torque constant of the motor."});
  f.per_joint("Ks", Ks, {"V s/rad", 0, 1e3, "Speed constant of the motor (back-EMF)."});
  f.per_joint("gear", gear, {"", 1e-3, 1e6, "Reduction: motor turns per joint turn (n)."});
  f.per_joint("efficiency", efficiency, {"", 0, 1, "Efficiency of the gear (eta)."});
  f.choice("efficiency_model", efficiency_model, kEfficiencyModels,
           "`paper`: the torque is always multiplied by eta, as in eq. 2; `directional`: by eta if the motor drives, by 1/eta "
           "if it is back-driven.");
  f.number(
      "turn_speed", turn_speed,
      {"rad/s", 1e-6, 1e3,
       "Joint speed at which the factor of `directional` has changed from 1 to eta or 1/eta, under an explicit integrator."});
  f.limit("u_max", u_max, {"V", 0, 1e6, "Supply voltage of the driver: commands are limited to +- this value."});
  f.limit("i_max", i_max, {"A", 0, 1e6, "Absolute rating: the current is limited to +- this value."});
  f.per_joint("rotor_inertia", rotor_inertia, {"kg m^2", 0, 1, "Inertia of the rotor (J); acts on the joint as n^2 J."});
  FrictionKeys::fields(f);
  RatingKeys::fields(f);
  const auto useless = [](double eta) { return !(eta > 0); };
  if (efficiency_model == EfficiencyModel::directional &&
      (useless(efficiency.common) || std::any_of(efficiency.each.begin(), efficiency.each.end(), useless)))
    f.problem("efficiency", "must be above 0 with efficiency_model: directional, which divides by it");
}

DcMotorActuator::DcMotorActuator(const RobotInfo& robot, const std::vector<const Settings*>& lanes) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    for (const Settings* s : lanes) {
      const bool directional = s->efficiency_model == EfficiencyModel::directional;
      const double eta = s->efficiency[j];
      add({s->R[j], s->Kt[j], s->Ks[j], s->gear[j], directional ? 1 : eta, s->u_max[j], s->i_max[j], directional ? eta : 1,
           directional ? s->turn_speed : 0},
          s->gear[j] * s->gear[j] * s->rotor_inertia[j], s->of(j), s->friction_of(j));
    }
  }
}

}  // namespace gaitlab::actuators
