// The inertias that a body of positive mass can have.
#pragma once
#include <Eigen/Eigenvalues>

#include "core/model/frames.h"

namespace gaitlab {

/// Principal moments of a tensor of inertia, ascending, kg m^2, with their axes: inertia = axes diag(moments) axes^T.
struct Principal {
  static constexpr double kRelative = 1e-6;  ///< of the largest moment; tolerance of hand-written numbers
  Vec3 moments = Vec3::Zero();
  Mat3 axes = Mat3::Identity();

  /// True if every moment is positive, beyond rounding.
  [[nodiscard]] bool positive() const { return moments[0] > 1e-14 * moments[2]; }
  /// True if the largest moment does not exceed the sum of the other two, as of every distribution of mass.
  [[nodiscard]] bool triangle() const { return moments[0] + moments[1] >= moments[2] * (1 - kRelative); }
  [[nodiscard]] bool possible() const { return positive() && triangle(); }
};

/// The tensor, which must be finite, is scaled to a largest entry of 1, so that intermediate results remain within the range of
/// a double. Only its lower triangle is read.
inline Principal principal(const Mat3& inertia) {
  const double scale = inertia.cwiseAbs().maxCoeff();
  if (!(scale > 0)) return {};
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia / scale);
  return {scale * solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace gaitlab
