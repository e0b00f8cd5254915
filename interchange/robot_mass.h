// Masses of the links of a robot file.
#pragma once
#include <string>
#include <vector>

#include "core/model/module_type.h"

namespace gaitlab::interchange {

/// Mass of a link, in the frame of its body.
struct RobotMass {
  double mass = 0;              ///< kg
  Vec3 com = Vec3::Zero();      ///< m
  Mat3 inertia = Mat3::Zero();  ///< kg m^2, about the COM
  std::string link = {};
  std::vector<Shape> shapes = {};  ///< of the link
};

/// Sum of the masses. A single mass is returned unchanged, to the last digit.
RobotMass united_mass(const std::vector<RobotMass>& parts);

}  // namespace gaitlab::interchange
