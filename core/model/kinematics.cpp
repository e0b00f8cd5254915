#include "core/model/kinematics.h"

#include <algorithm>
#include <limits>

namespace gaitlab {

Kinematics::Kinematics(const Robot& robot)
    : R(robot.links.size(), Mat3::Identity()),
      p(robot.links.size(), Vec3::Zero()),
      omega(robot.links.size(), Vec3::Zero()),
      v(robot.links.size(), Vec3::Zero()),
      turns(robot.links.size(), Quat::Identity()) {}

void Kinematics::place(const Robot& robot, const RobotState& state) {
  R[0] = state.orientation.toRotationMatrix();
  p[0] = state.position;
  for (std::size_t i = 1; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    const auto parent = static_cast<std::size_t>(link.parent);
    const auto joint = static_cast<std::size_t>(link.joint);
    turns[i] = turn(link.axis, state.q[joint]);
    R[i] = R[parent] * link.in_parent.R * turns[i].toRotationMatrix();
    p[i] = p[parent] + R[parent] * link.in_parent.p;
  }
}

void Kinematics::update(const Robot& robot, const RobotState& state) {
  place(robot, state);
  omega[0] = state.angular_velocity;
  v[0] = state.velocity;
  for (std::size_t i = 1; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    const auto parent = static_cast<std::size_t>(link.parent);
    const auto joint = static_cast<std::size_t>(link.joint);
    const Vec3 arm = R[parent] * link.in_parent.p;
    omega[i] = omega[parent] + R[i] * link.axis * state.qd[joint];
    v[i] = v[parent] + omega[parent].cross(arm);
  }
}

Kinematics at_zero(const Robot& robot) {
  RobotState zero;
  zero.q.assign(robot.joints.size(), 0.0);
  zero.qd = zero.q;
  Kinematics kinematics(robot);
  kinematics.update(robot, zero);
  return kinematics;
}

Vec3 centre_of_mass(const Robot& robot, const Kinematics& k) {
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < robot.links.size(); ++i) moment += robot.links[i].mass * k.point(i, robot.links[i].com);
  return moment / robot.mass;
}

Sums sums(const Robot& robot, const Kinematics& k, const Vec3& gravity) {
  Sums total;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    const Vec3 com = k.point(i, link.com);
    const Vec3 velocity = k.velocity(i, com);
    const Vec3 spin = k.R[i] * (link.inertia * (k.R[i].transpose() * k.omega[i]));
    total.com += link.mass * com;
    total.momentum += link.mass * velocity;
    total.angular_momentum += com.cross(link.mass * velocity) + spin;
    total.kinetic += 0.5 * (link.mass * velocity.squaredNorm() + k.omega[i].dot(spin));
    total.potential -= link.mass * gravity.dot(com);
  }
  total.com /= robot.mass;
  return total;
}

double lowest_point(const Robot& robot, const Kinematics& k, std::span<const ContactElement> elements) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const ContactElement& element : elements) {
    lowest = std::min(lowest, k.point(element.link, element.centre).z() - element.radius);
  }
  if (!elements.empty()) return lowest;
  for (const Body& body : robot.bodies) {
    for (const Shape& shape : robot.types[robot.modules[body.module].type].bodies[body.type].shapes) {
      const Pose world = Pose{k.R[body.link], k.p[body.link]} * body.in_link * shape.in_body;
      const Vec3 down = world.R.transpose() * -Vec3::UnitZ();
      double reach = shape.size.x();  // sphere: radius
      if (shape.kind == Shape::Kind::hull) reach = down.dot(shape.hull->farthest(down));
      if (shape.kind == Shape::Kind::box) reach = 0.5 * down.cwiseAbs().dot(shape.size);
      if (shape.kind == Shape::Kind::cylinder || shape.kind == Shape::Kind::half_cylinder) {
        // A half cylinder that bulges downwards reaches as far as a whole cylinder. Otherwise only the edge of its flat side
        // counts.
        const bool round = shape.kind == Shape::Kind::cylinder || down.x() > 0;
        const double across = round ? std::sqrt(down.x() * down.x() + down.z() * down.z()) : std::abs(down.z());
        reach = shape.size.x() * across + 0.5 * shape.size.y() * std::abs(down.y());
      }
      lowest = std::min(lowest, world.p.z() - reach);
    }
  }
  return std::isfinite(lowest) ? lowest : 0.0;
}

}  // namespace gaitlab
