// The ground and what a point or sphere finds there: values and pure functions.
#pragma once
#include "core/model/frames.h"

namespace gaitlab {

/// World z = 0, solid below.
struct Ground {
  enum class Kind { none, plane } kind = Kind::plane;
  double friction = 0.8;  ///< Coulomb coefficient f

  template <class T>
  struct BasicTouch {
    using Vector = Eigen::Matrix<T, 3, 1>;
    T penetration;  ///< m; negative: the gap
    Vector normal;
    Vector point;  ///< where the force acts: the deepest point of the element
    double friction;
  };
  using Touch = BasicTouch<double>;

  /// A sphere of `radius` (0: a point) centred at `centre`, world. T: double or lanes.
  template <class T>
  [[nodiscard]] BasicTouch<T> query(const Eigen::Matrix<T, 3, 1>& centre, double radius) const {
    const T lowest = centre.z() - radius;
    return {-lowest, {T(0.0), T(0.0), T(1.0)}, {centre.x(), centre.y(), lowest}, friction};
  }
};

}  // namespace gaitlab
