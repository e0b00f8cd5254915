// Forces with their moments; world axes, N and N m.
#pragma once
#include <cstddef>

#include "core/model/frames.h"

namespace gaitlab {

/// Force and moment about a point. The owner of the wrench defines the point.
struct Wrench {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

/// External load on one body: a force at a world point, m, and a torque.
struct BodyWrench {
  std::size_t body = 0;
  Vec3 point = Vec3::Zero(), force = Vec3::Zero(), torque = Vec3::Zero();
};

}  // namespace gaitlab
