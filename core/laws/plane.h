// Contact of a point or sphere with the plane z = 0.
#pragma once

namespace gaitlab {

template <class T>
struct PlaneTouch {
  T penetration;  ///< m; negative: gap
  T height;       ///< height of the lowest point, where the force acts, m
};

/// Touch of a sphere of `radius` (0: a point) whose centre is at z. The plane is solid below, normal up. T: double or lanes.
template <class T>
PlaneTouch<T> on_plane(const T& z, const T& radius) {
  const T lowest = z - radius;
  return {-lowest, lowest};
}

}  // namespace gaitlab
