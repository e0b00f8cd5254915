#include "physics_articulated/lane_model.h"

#include <algorithm>
#include <utility>

#include "core/dynamics/rotor_inertia.h"
#include "core/laws/joint_friction.h"
#include "physics_articulated/eigen.h"

namespace gaitlab::articulated {

Touch<double> query(const Ground& ground, const Vec<double>& centre, double radius) {
  if (!ground.exists()) return {-1, {}, {}, 0};
  const Ground::Touch touch = ground.query(vec3(centre), radius);
  return {touch.penetration, vec(touch.normal), vec(touch.point), touch.friction};
}

LaneConstants rollout(const LaneSettings& lane, Base base) {
  return {tree(*lane.robot, base, lane.contacts),
          vec(lane.gravity),
          lane.law,
          lane.ground.is_plane(),
          lane.ground.friction,
          lane.accuracy,
          &lane.ground};
}

LaneModel::LaneModel(const PlantSettings& settings, const LaneSettings& own, std::size_t lane, std::size_t lanes)
    : settings_(settings),
      own_(own),
      lane_(lane),
      lanes_(lanes),
      constants_(rollout(own, settings.base)),
      environment_{constants_.gravity, constants_.law, constants_.plane, constants_.friction, {constants_.ground}, query},
      body_(constants_.tree, environment_.gravity),
      contacts_(constants_.tree, environment_),
      rotor_(own.robot->joints.size()),
      a_(6 + rotor_.size()),
      zero_(rotor_.size()),
      motor_speed_(rotor_.size()),
      plays_(joints_with_play(*own.robot)),
      first_(own.robot->links.size()),
      kinematics_(*own.robot),
      monitor_(*own.robot, rotors_beside(*own.robot, settings.actuator, lane, lanes)) {
  for (auto* values : {&command_, &speed_, &torque_, &slope_}) values->resize(rotor_.size() * lanes);
  const In inertia = settings.actuator == nullptr ? In() : settings.actuator->reflected_inertia();
  for (std::size_t j = 0; j < rotor_.size() && !inertia.empty(); ++j) {
    // The rotor behind play is not part of the robot: its motor passes on a torque by the flanks.
    if (!own.robot->joints[j].play.any()) rotor_[j] = inertia[j * lanes + lane];
  }
  monitor_.contacts.reserve(own.contacts.size());
}

void LaneModel::accelerate(In x, const RobotState& state, In torque, std::span<const BodyWrench> wrenches, Acceleration& out) {
  body_.forward_kinematics(x);
  // Lists of the wrenches on each link, in their order. A search per link would be quadratic in the size of the robot.
  const std::size_t end = wrenches.size();
  std::ranges::fill(first_, end);
  next_.resize(end);
  for (std::size_t i = end; i-- > 0;) next_[i] = std::exchange(first_[own_.robot->bodies[wrenches[i].body].link], i);
  body_.solve(torque, rotor_, a_, [&](std::size_t link, TreeBody<double>::Load load) {
    for (std::size_t i = first_[link]; i < end; i = next_[i]) {
      const BodyWrench& w = wrenches[i];
      load.add_force(vec(w.point - state.position), vec(w.force));
      load.add_moment(vec(w.torque));
    }
  });
  out.linear = Vec3(a_[0], a_[1], a_[2]);
  out.angular = Vec3(a_[3], a_[4], a_[5]);
  std::copy(a_.begin() + 6, a_.end(), out.joints.begin());
}

void LaneModel::change(In hold) {
  for (std::size_t j = 0; j < rotor_.size(); ++j) monitor_.hold[j] = hold[j * lanes_ + lane_];
}

void LaneModel::ask(In command, In speed) {
  for (std::size_t j = 0; j < rotor_.size(); ++j) {
    command_[j * lanes_ + lane_] = command[j * lanes_ + lane_];
    speed_[j * lanes_ + lane_] = speed[j];
  }
  settings_.actuator->effort(command_, speed_, torque_, slope_);
  add_creeping(settings_.actuator->friction(), speed_, torque_, slope_);
}

Stability LaneModel::stability(In x, const RobotState& state, In command, bool standing) {
  kinematics_.update(*own_.robot, state);
  body_.forward_kinematics(x);
  contacts_.find(body_, 0, 0);
  contacts_.begin(0);
  body_.solve(zero_, rotor_, a_, [](std::size_t, TreeBody<double>::Load) {});  // factorises the mass matrix for apply
  if (settings_.actuator != nullptr) {
    if (standing) std::fill(command_.begin(), command_.end(), 0.0);
    motor_speed_ = state.qd;
    for (std::size_t k = 0; k < plays_.size(); ++k) motor_speed_[plays_[k]] = state.rotor_speed[k];
    ask(standing ? In(command_) : command, standing ? In(zero_) : In(motor_speed_));
  }
  for (std::size_t j = 0; j < rotor_.size(); ++j) monitor_.motor[j] = slope_[j * lanes_ + lane_];
  return monitor_.rule(own_, settings_.base, kinematics_, state, standing, settings_.step, *this, [&] {
    for (const Contact<double>& c : contacts_.touching()) {
      monitor_.contacts.push_back(
          {c.element, c.link, vec3(c.touch.point), vec3(c.n), vec3(c.slip_direction), c.tangential_damping, c.normal_damping});
    }
  });
}

}  // namespace gaitlab::articulated
