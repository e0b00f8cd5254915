#include "actuators/friction_keys.h"

namespace gaitlab::actuators {

void FrictionKeys::fields(Fields& f) {
  f.per_joint("dry_friction", dry_friction,
              {"N m", 0, 1e9, "Dry friction of the joint: opposes its motion, and holds it at rest."});
  f.per_joint("viscous_friction", viscous_friction, {"N m s/rad", 0, 1e9, "Viscous friction of the joint, per joint speed."});
}

}  // namespace gaitlab::actuators
