// Values that a caller gives at a control tick in place of those of plugins.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab {

/// One value per joint, except steering; those of joints without a motor are not used. An empty span is not given.
struct Action {
  In setpoint = {};  ///< rad, in place of the CPG's
  In residual = {};  ///< rad, added to the set points
  In steering = {};  ///< in place of the values of steering sensors, in their order (not one per joint)
  In command = {};   ///< in place of the controller's, in its unit, cut to the limit of the motor
};

}  // namespace gaitlab
