// The ground and what a point or sphere finds there: values and pure functions.
#pragma once
#include "core/model/frames.h"

namespace gaitlab {

/// World z = 0, solid below.
struct Ground {
  enum class Kind { none, plane } kind = Kind::plane;
  double friction = 0.8;  ///< Coulomb coefficient f

  struct Touch {
    double penetration = 0;  ///< m; negative: the gap
    Vec3 normal = Vec3::UnitZ();
    Vec3 point = Vec3::Zero();  ///< where the force acts: the deepest point of the element
    double friction = 0;
  };

  /// A sphere of `radius` (0: a point) centred at `centre`, world.
  [[nodiscard]] Touch query(const Vec3& centre, double radius) const {
    return {radius - centre.z(), Vec3::UnitZ(), {centre.x(), centre.y(), centre.z() - radius}, friction};
  }
};

}  // namespace gaitlab
