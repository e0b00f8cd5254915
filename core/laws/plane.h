// Contact of a point or sphere with the plane z = 0.
#pragma once

namespace gaitlab {

template <class T>
struct PlaneTouch {
  T penetration;  ///< m; negative if there is a gap
  T height;       ///< height of the lowest point, at which the force acts, m
};

/// Touch of a sphere of `radius` (0 for a point) whose centre is at height z. The plane is solid below, with its normal
/// upwards. T: double or lanes.
template <class T>
PlaneTouch<T> on_plane(const T& z, const T& radius) {
  const T lowest = z - radius;
  return {-lowest, lowest};
}

}  // namespace gaitlab
