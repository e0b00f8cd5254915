// Load of a dock, with components normal to the docked faces and in their plane.
#pragma once
#include <cmath>

#include "core/dynamics/wrench.h"

namespace gaitlab {

/// Load about the common origin of the docked faces. Shear and bending are magnitudes, because a magnitude does not depend on
/// the quarter turn between the docked faces. (docs/equations.md, 9)
struct DockLoad {
  double tension = 0;  ///< N, positive: pulls the modules apart
  double shear = 0;    ///< N, in the plane of the faces
  double bending = 0;  ///< N m, about an axis in the plane of the faces
  double torsion = 0;  ///< N m, of the parent on the child, right-hand about the outward normal of the parent face
};

/// Load of a dock. `on_child` is the wrench of the parent on the child (InverseDynamics::dock). `normal` is the outward unit
/// normal of the face of the parent, in the same axes as the wrench.
inline DockLoad dock_load(const Wrench& on_child, const Vec3& normal) {
  const auto across = [&](const Vec3& v) { return std::sqrt((v - v.dot(normal) * normal).squaredNorm()); };
  return {-on_child.force.dot(normal), across(on_child.force), across(on_child.moment), on_child.moment.dot(normal)};
}

/// Larger value of each component of two loads. Tension is compared with its sign, because pressure does not part a dock; the
/// other components are compared in magnitude.
inline DockLoad largest(const DockLoad& a, const DockLoad& b) {
  return {std::fmax(a.tension, b.tension), std::fmax(a.shear, b.shear), std::fmax(a.bending, b.bending),
          std::abs(b.torsion) > std::abs(a.torsion) ? b.torsion : a.torsion};
}

}  // namespace gaitlab
