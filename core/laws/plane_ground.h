// Plane as a type of ground, and the type without a ground.
#pragma once
#include "core/laws/ground_touch.h"
#include "core/laws/plane.h"

namespace gaitlab {

/// Plane z = 0 of the world, solid below.
struct Plane {
  static constexpr GroundType kType{.name = "plane", .about = "world z = 0, solid below", .plane_and_boxes = true};

  [[nodiscard]] GroundTouch touch(const Vec3& centre, double radius, double friction) const {
    const auto [penetration, height] = on_plane(centre.z(), radius);
    return {penetration, Vec3::UnitZ(), {centre.x(), centre.y(), height}, friction};
  }
  [[nodiscard]] double surface_below(const Vec3&, double) const { return 0; }
  [[nodiscard]] double highest() const { return 0; }
};

/// No ground. Queries return the plane, so that callers that need forces must test Ground::exists first.
struct NoGround : Plane {
  static constexpr GroundType kType{.name = "none", .about = "", .plane_and_boxes = true};
};

}  // namespace gaitlab
