#include "core/dynamics/inverse_dynamics.h"

namespace gaitlab {

InverseDynamics::InverseDynamics(const Robot& robot)
    : robot_(robot),
      tree_(robot),
      body_of_joint_(robot.joints.size()),
      alpha_(robot.links.size(), Vec3::Zero()),
      a_(robot.links.size(), Vec3::Zero()),
      carried_(robot.bodies.size()),
      torques_(robot.joints.size()) {
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const Attachment& at = tree_.attachments[b];
    if (at.kind == Attachment::Kind::hinge) body_of_joint_[at.index] = b;
  }
}

void InverseDynamics::move_links(const Kinematics& k, const Acceleration& acceleration) {
  alpha_[0] = acceleration.angular;
  a_[0] = acceleration.linear;
  for (std::size_t i = 1; i < robot_.links.size(); ++i) {
    const Link& link = robot_.links[i];
    const auto parent = static_cast<std::size_t>(link.parent);
    const Vec3 arm = k.p[i] - k.p[parent];
    const Vec3& w = k.omega[parent];
    // omega_i - omega_parent = axis * qd, and the axis turns with the parent: w x (axis qd) = w x omega_i.
    alpha_[i] =
        alpha_[parent] + k.R[i] * link.axis * acceleration.joints[static_cast<std::size_t>(link.joint)] + w.cross(k.omega[i]);
    a_[i] = a_[parent] + alpha_[parent].cross(arm) + w.cross(w.cross(arm));
  }
}

Wrench InverseDynamics::needed(const Kinematics& k, std::size_t b, const Vec3& gravity) const {
  const Body& body = robot_.bodies[b];
  const Mat3 R = k.R[body.link] * body.in_link.R;
  const Vec3 com = k.point(body.link, body.in_link * body.com);
  const Vec3 arm = com - k.p[body.link];
  const Vec3& w = k.omega[body.link];
  const Vec3& alpha = alpha_[body.link];
  const Vec3 a = a_[body.link] + alpha.cross(arm) + w.cross(w.cross(arm));
  const Vec3 spin = R * (body.inertia * (R.transpose() * w));
  const Vec3 force = body.mass * (a - gravity);
  return {force, R * (body.inertia * (R.transpose() * alpha)) + w.cross(spin) + (com - k.p[0]).cross(force)};
}

void InverseDynamics::update(const Kinematics& k, const Acceleration& acceleration, const Vec3& gravity,
                             std::span<const BodyWrench> wrenches) {
  move_links(k, acceleration);
  for (const std::size_t b : tree_.order) carried_[b] = needed(k, b, gravity);
  for (const BodyWrench& w : wrenches) {
    carried_[w.body].force -= w.force;
    carried_[w.body].moment -= w.torque + (w.point - k.p[0]).cross(w.force);
  }
  for (std::size_t i = tree_.order.size(); i-- > 1;) {
    const std::size_t b = tree_.order[i];
    const Attachment& at = tree_.attachments[b];
    Wrench& carried = carried_[b];
    carried_[at.parent].force += carried.force;
    carried_[at.parent].moment += carried.moment;
    const std::size_t link = robot_.bodies[b].link;
    carried.moment -= (k.point(link, at.origin) - k.p[0]).cross(carried.force);
    if (at.kind == Attachment::Kind::hinge) torques_[at.index] = carried.moment.dot(k.R[link] * robot_.links[link].axis);
  }
}

}  // namespace gaitlab
