#include "core/simulation/state_layout.h"

#include "core/model/kinematics.h"

namespace gaitlab {

void StateLayout::read(In state, std::size_t lane, RobotState& out) const {
  const auto at = [&](std::size_t entry) { return state[entry * lanes + lane]; };
  const auto vec = [&](std::size_t entry) { return Vec3(at(entry), at(entry + 1), at(entry + 2)); };
  out.position = vec(kPosition);
  out.orientation = Quat(at(kOrientation), at(kOrientation + 1), at(kOrientation + 2), at(kOrientation + 3));
  out.velocity = vec(kVelocity);
  out.angular_velocity = vec(kAngularVelocity);
  for (std::size_t j = 0; j < joints; ++j) {
    out.q[j] = at(kAngles + j);
    out.qd[j] = at(kAngles + joints + j);
  }
  out.rotor.resize(plays);
  out.rotor_speed.resize(plays);
  for (std::size_t k = 0; k < plays; ++k) {
    out.rotor[k] = at(kAngles + 2 * joints + k);
    out.rotor_speed[k] = at(kAngles + 2 * joints + plays + k);
  }
}

void StateLayout::write(const RobotState& in, std::size_t lane, Out state) const {
  const auto put = [&](std::size_t entry, double value) { state[entry * lanes + lane] = value; };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    put(kPosition + i, in.position[axis]);
    put(kVelocity + i, in.velocity[axis]);
    put(kAngularVelocity + i, in.angular_velocity[axis]);
  }
  put(kOrientation, in.orientation.w());
  put(kOrientation + 1, in.orientation.x());
  put(kOrientation + 2, in.orientation.y());
  put(kOrientation + 3, in.orientation.z());
  for (std::size_t j = 0; j < joints; ++j) {
    put(kAngles + j, in.q[j]);
    put(kAngles + joints + j, in.qd[j]);
  }
  for (std::size_t k = 0; k < plays; ++k) {
    put(kAngles + 2 * joints + k, in.rotor[k]);
    put(kAngles + 2 * joints + plays + k, in.rotor_speed[k]);
  }
}

}  // namespace gaitlab
