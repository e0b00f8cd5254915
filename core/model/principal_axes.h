// Principal axes and moments of a tensor of inertia.
#pragma once
#include <Eigen/Eigenvalues>

#include "core/model/frames.h"

namespace gaitlab {

/// Right-handed principal axes R and moments with inertia = R diag(moments) R^T. A diagonal tensor gives R = 1 without
/// rounding.
inline Mat3 principal_axes(const Mat3& inertia, Vec3& moments) {
  const Mat3 off = inertia - Mat3(inertia.diagonal().asDiagonal());
  if (off.cwiseAbs().maxCoeff() <= 1e-15 * inertia.diagonal().cwiseAbs().maxCoeff()) {
    moments = inertia.diagonal();
    return Mat3::Identity();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  moments = solver.eigenvalues();
  return axes;
}

}  // namespace gaitlab
