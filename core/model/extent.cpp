#include "core/model/extent.h"

namespace gaitlab {

double extent(const Robot& robot, const RobotState& state) {
  Kinematics k(robot);
  k.update(robot, state);
  Vec3 least = Vec3::Constant(1e300);
  Vec3 most = -least;
  const auto take = [&](const Vec3& at) {
    least = least.cwiseMin(at);
    most = most.cwiseMax(at);
  };
  for (const Vec3& origin : k.p) take(origin);
  for (const ContactElement& element : contact_elements(robot, ContactSet::all))
    take(k.p[element.link] + k.R[element.link] * element.centre);
  return (most - least).norm();
}

}  // namespace gaitlab
