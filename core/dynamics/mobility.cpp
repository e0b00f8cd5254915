#include "core/dynamics/mobility.h"

#include <Eigen/Cholesky>

#include "core/dynamics/mass_matrix.h"

namespace gaitlab {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Mat3 cross_matrix(const Vec3& v) { return (Mat3() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished(); }

/// Transform of the motion (velocity, angular velocity) of a rigid body to a point at `offset`.
Matrix6 shifted(const Vec3& offset) {
  Matrix6 X = Matrix6::Identity();
  X.topRightCorner<3, 3>() = -cross_matrix(offset);
  return X;
}

/// Inertia of one link about the origin of its frame.
Matrix6 inertia_of(const Link& link, const Mat3& R) {
  const Mat3 c = cross_matrix(R * link.com);
  Matrix6 I;
  I << link.mass * Mat3::Identity(), -link.mass * c, link.mass * c, R * link.inertia * R.transpose() - link.mass * c * c;
  return I;
}

/// Inverse of the inertia of the base in the entries in which it can move, and 0 in the others.
Matrix6 inverse_at_base(const Matrix6& inertia, Base base) {
  const auto entries = base_entries(base);
  Eigen::MatrixXd free = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(entries.size()));
  for (std::size_t i = 0; i < entries.size(); ++i)
    free(static_cast<Eigen::Index>(entries[i]), static_cast<Eigen::Index>(i)) = 1;
  if (entries.empty()) return Matrix6::Zero();
  return free * (free.transpose() * inertia * free).ldlt().solve(free.transpose());
}

/// A joint and the link that it moves.
struct Hinge {
  Matrix6 X;    ///< transform of motions from the parent's origin to the link's origin
  Vector6 S;    ///< axis
  Vector6 U_D;  ///< U / D
  double D = 0;
};

}  // namespace

double Mobility::at(std::size_t link, const Vec3& x, const Kinematics& kinematics) const {
  const Matrix6 X = shifted(x - kinematics.p[link]);
  return (X.topRows<3>() * links[link] * X.topRows<3>().transpose()).trace() / 3;
}

Mobility mobility(const Robot& robot, Base base, const Kinematics& k, std::span<const double> armature) {
  const std::size_t n = robot.links.size();
  std::vector<Matrix6> inertia;
  inertia.reserve(n);
  for (std::size_t i = 0; i < n; ++i) inertia.push_back(inertia_of(robot.links[i], k.R[i]));
  std::vector<Hinge> hinges(n);
  for (std::size_t i = n; i-- > 1;) {
    const Link& link = robot.links[i];
    const auto parent = static_cast<std::size_t>(link.parent);
    Hinge& hinge = hinges[i];
    hinge.X = shifted(k.p[i] - k.p[parent]);
    hinge.S << Vec3::Zero(), k.R[i] * link.axis;
    const Vector6 U = inertia[i] * hinge.S;
    hinge.D = hinge.S.dot(U) + armature[static_cast<std::size_t>(link.joint)];
    hinge.U_D = U / hinge.D;
    inertia[parent] += hinge.X.transpose() * (inertia[i] - U * hinge.U_D.transpose()) * hinge.X;
  }
  Mobility out{std::vector<Matrix6>(n), std::vector<double>(robot.joints.size())};
  out.links[0] = inverse_at_base(inertia[0], base);
  for (std::size_t i = 1; i < n; ++i) {
    const Hinge& hinge = hinges[i];
    const Matrix6 moved = hinge.X * out.links[static_cast<std::size_t>(robot.links[i].parent)] * hinge.X.transpose();
    const Matrix6 L = Matrix6::Identity() - hinge.S * hinge.U_D.transpose();
    out.links[i] = hinge.S * hinge.S.transpose() / hinge.D + L * moved * L.transpose();
    out.joints[static_cast<std::size_t>(robot.links[i].joint)] = 1 / hinge.D + hinge.U_D.dot(moved * hinge.U_D);
  }
  return out;
}

}  // namespace gaitlab
