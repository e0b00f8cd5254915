// The plane as a ground, and no ground.
#pragma once
#include "core/laws/ground_touch.h"
#include "core/laws/plane.h"

namespace gaitlab {

/// World z = 0, solid below.
struct Plane {
  static constexpr GroundType kType{.name = "plane", .about = "world z = 0, solid below", .plane_and_boxes = true};

  [[nodiscard]] GroundTouch touch(const Vec3& centre, double radius, double friction) const {
    const auto [penetration, height] = on_plane(centre.z(), radius);
    return {penetration, Vec3::UnitZ(), {centre.x(), centre.y(), height}, friction};
  }
  [[nodiscard]] double surface_below(const Vec3&, double) const { return 0; }
  [[nodiscard]] double highest() const { return 0; }
};

/// Nothing touches the robot. A query finds the plane: callers that need forces ask Ground::exists first.
struct NoGround : Plane {
  static constexpr GroundType kType{.name = "none", .about = "", .plane_and_boxes = true};
};

}  // namespace gaitlab
