// Data-sheet ratings of a drive, as settings that all motors with a data sheet have.
#pragma once
#include "core/plugin/actuator.h"

namespace gaitlab::actuators {

/// Part of a motor's Settings. A rating of 0 is not stated.
struct RatingKeys {
  PerJoint i_continuous, gear_torque_peak, gear_torque_continuous, speed_max;
  void fields(Fields& f);
  [[nodiscard]] DriveRatings of(std::size_t joint) const {
    return {i_continuous[joint], gear_torque_peak[joint], gear_torque_continuous[joint], speed_max[joint]};
  }
};

}  // namespace gaitlab::actuators
