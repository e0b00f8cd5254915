#include "actuators/rating_keys.h"

namespace gaitlab::actuators {

void RatingKeys::fields(Fields& f) {
  f.rating("i_continuous", i_continuous, {"A", 0, 1e6, "RMS current that the motor bears for good, a verdict's limit."});
  f.rating("gear_torque_peak", gear_torque_peak,
           {"N m", 0, 1e9, "Largest torque that the gear bears, at the joint, a verdict's limit."});
  f.rating("gear_torque_continuous", gear_torque_continuous,
           {"N m", 0, 1e9, "RMS torque that the gear bears for good, at the joint, a verdict's limit."});
  f.rating("speed_max", speed_max,
           {"rad/s", 0, 1e6, "Largest speed of the joint that motor and gear bear, a verdict's limit."});
}

}  // namespace gaitlab::actuators
