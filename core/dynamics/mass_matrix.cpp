#include "core/dynamics/mass_matrix.h"

#include <algorithm>
#include <array>

namespace gaitlab {

std::span<const std::size_t> base_entries(Base base) {
  static constexpr std::array<std::size_t, 6> kAll{0, 1, 2, 3, 4, 5};
  static constexpr std::array<std::size_t, 3> kPlanar{0, 2, 4};
  if (base == Base::floating) return kAll;
  if (base == Base::planar) return kPlanar;
  return {};
}

namespace {

double entry(const Wrench& w, std::size_t i) {
  return i < 3 ? w.force[static_cast<Eigen::Index>(i)] : w.moment[static_cast<Eigen::Index>(i - 3)];
}

}  // namespace

MassMatrix::MassMatrix(const Robot& robot, Base base)
    : robot_(robot), base_(base_entries(base)), composites_(robot.links.size()) {
  matrix_.setZero(robot.dof(base), robot.dof(base));
}

Wrench MassMatrix::momentum(const Composite& c, const Vec3& w, const Vec3& v) {
  return {c.mass * v + w.cross(c.first), c.second * w + c.first.cross(v)};
}

/// Sets the entries that couple the base with `column` to `momentum`, which is the momentum at unit speed of `column`.
void MassMatrix::put(Eigen::Index column, const Wrench& momentum) {
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    matrix_(row, column) = matrix_(column, row) = entry(momentum, base_[i]);
  }
}

void MassMatrix::update(const Kinematics& k) {
  for (std::size_t i = 0; i < robot_.links.size(); ++i) {
    const Link& link = robot_.links[i];
    const Vec3 com = k.point(i, link.com) - k.p[0];
    composites_[i] = {link.mass, link.mass * com,
                      k.R[i] * link.inertia * k.R[i].transpose() +
                          link.mass * (com.squaredNorm() * Mat3::Identity() - com * com.transpose())};
  }
  for (std::size_t i = robot_.links.size(); i-- > 1;) {
    Composite& parent = composites_[static_cast<std::size_t>(robot_.links[i].parent)];
    parent.mass += composites_[i].mass;
    parent.first += composites_[i].first;
    parent.second += composites_[i].second;
  }
  for (std::size_t i = 0; i < base_.size(); ++i) {
    Vec3 v = Vec3::Zero();
    Vec3 w = Vec3::Zero();
    (base_[i] < 3 ? v : w)[static_cast<Eigen::Index>(base_[i] % 3)] = 1;
    put(static_cast<Eigen::Index>(i), momentum(composites_[0], w, v));
  }
  const auto column_of = [&](int joint) { return static_cast<Eigen::Index>(base_.size()) + joint; };
  for (std::size_t i = 1; i < robot_.links.size(); ++i) {
    const Vec3 axis = k.R[i] * robot_.links[i].axis;
    const Wrench m = momentum(composites_[i], axis, (k.p[i] - k.p[0]).cross(axis));
    const Eigen::Index column = column_of(robot_.links[i].joint);
    put(column, m);
    for (int up = static_cast<int>(i); up > 0; up = robot_.links[static_cast<std::size_t>(up)].parent) {
      const auto at = static_cast<std::size_t>(up);
      const Vec3 other = k.R[at] * robot_.links[at].axis;
      const Eigen::Index row = column_of(robot_.links[at].joint);
      matrix_(row, column) = matrix_(column, row) = other.dot(m.moment - (k.p[at] - k.p[0]).cross(m.force));
    }
  }
}

Eigen::VectorXd generalised_force(const InverseDynamics& dynamics, Base base) {
  const auto entries = base_entries(base);
  const In torques = dynamics.torques();
  Eigen::VectorXd force(static_cast<Eigen::Index>(entries.size() + torques.size()));
  auto* at = force.data();
  for (const std::size_t i : entries) *at++ = entry(dynamics.base(), i);
  std::copy(torques.begin(), torques.end(), at);
  return force;
}

}  // namespace gaitlab
