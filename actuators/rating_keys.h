// Settings for the data-sheet ratings of a drive, shared by all motors with a data sheet.
#pragma once
#include "core/plugin/actuator.h"

namespace gaitlab::actuators {

/// Part of a motor's Settings. A rating is 0 if the data sheet does not state it.
struct RatingKeys {
  PerJoint i_continuous, gear_torque_peak, gear_torque_continuous, speed_max;
  void fields(Fields& f);
  [[nodiscard]] DriveRatings of(std::size_t joint) const {
    return {i_continuous[joint], gear_torque_peak[joint], gear_torque_continuous[joint], speed_max[joint]};
  }
};

}  // namespace gaitlab::actuators
