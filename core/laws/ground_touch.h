// Touch of a contact element with the ground, and constant properties of a type of ground.
#pragma once
#include "core/model/frames.h"

namespace gaitlab {

struct GroundTouch {
  double penetration;  ///< m; negative if there is a gap
  Vec3 normal;
  Vec3 point;  ///< point of action of the force: the deepest point of the element
  double friction;
};

/// Touch of a sphere of `radius` (0 for a point) centred at `centre`.
inline GroundTouch sphere_touch(double penetration, const Vec3& normal, double friction, const Vec3& centre, double radius) {
  return {penetration, normal, centre - radius * normal, friction};
}

/// Constant properties of a type of ground.
struct GroundType {
  const char* name;              ///< value of `ground.type`, and key of the settings of this type
  const char* about;             ///< text for the manual of `ground.type`, or ""
  bool has_settings = false;     ///< true if there is a key `ground.NAME`
  bool plane_and_boxes = false;  ///< true for the plane z = 0 and boxes, which other engines and formats also support
};

}  // namespace gaitlab
