// The touch of a contact element with the ground, and the constant parts of a type of ground.
#pragma once
#include "core/model/frames.h"

namespace gaitlab {

struct GroundTouch {
  double penetration;  ///< m; negative: the gap
  Vec3 normal;
  Vec3 point;  ///< where the force acts: the deepest point of the element
  double friction;
};

/// The touch of a sphere of `radius` (0: a point) centred at `centre`.
inline GroundTouch sphere_touch(double penetration, const Vec3& normal, double friction, const Vec3& centre, double radius) {
  return {penetration, normal, centre - radius * normal, friction};
}

/// Constant parts of a type of ground.
struct GroundType {
  const char* name;              ///< `ground.type`; also the key of its settings, if it has any
  const char* about;             ///< for the manual of `ground.type`; "": nothing
  bool has_settings = false;     ///< key `ground.NAME`
  bool plane_and_boxes = false;  ///< only the plane z = 0 and boxes, which other engines and formats have, too
};

}  // namespace gaitlab
