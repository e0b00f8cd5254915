#include "interchange/robot_mass.h"

namespace gaitlab::interchange {

RobotMass united_mass(const std::vector<RobotMass>& parts) {
  if (parts.size() == 1) return parts.front();
  RobotMass whole;
  for (const RobotMass& part : parts) {
    whole.mass += part.mass;
    whole.com += part.mass * part.com;
  }
  if (whole.mass > 0) whole.com /= whole.mass;
  for (const RobotMass& part : parts) {
    const Vec3 d = part.com - whole.com;
    whole.inertia += part.inertia + part.mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  return whole;
}

}  // namespace gaitlab::interchange
