#include "actuators/rating_keys.h"

namespace gaitlab::actuators {

void RatingKeys::fields(Fields& f) {
  f.rating("i_continuous", i_continuous,
           {"A", 0, 1e6, "Continuous current rating of the motor (RMS), a limit of the verdict."});
  f.rating("gear_torque_peak", gear_torque_peak,
           {"N m", 0, 1e9, "Peak torque rating of the gear, at the joint, a limit of the verdict."});
  f.rating("gear_torque_continuous", gear_torque_continuous,
           {"N m", 0, 1e9, "Continuous torque rating of the gear (RMS), at the joint, a limit of the verdict."});
  f.rating("speed_max", speed_max, {"rad/s", 0, 1e6, "Speed rating of motor and gear, at the joint, a limit of the verdict."});
}

}  // namespace gaitlab::actuators
