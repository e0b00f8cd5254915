// The plane z = 0 and what a point or sphere finds there.
#pragma once

namespace gaitlab {

template <class T>
struct PlaneTouch {
  T penetration;  ///< m; negative: the gap
  T height;       ///< of its lowest point, where the force acts, m
};

/// Solid below, normal up. A sphere of `radius` (0: a point) whose centre is at z. T: double or lanes.
template <class T>
PlaneTouch<T> on_plane(const T& z, const T& radius) {
  const T lowest = z - radius;
  return {-lowest, lowest};
}

}  // namespace gaitlab
