#include "core/simulation/lane_sensors.h"

#include <algorithm>

#include "core/scenario/sensor_section.h"

namespace gaitlab {

LaneSensors::LaneSensors(const Scenario& scenario)
    : robot_(*scenario.robot),
      gravity_(scenario.physics.gravity),
      sensors_(make_sensors(scenario)),
      kinematics_(*scenario.robot) {
  for (const auto& sensor : sensors_) {
    for (const SensorReading& reading : sensor->readings()) {
      if (reading.replaces != Replaces::nothing) continue;
      if (sensor->is_steering()) steering_.push_back(channels_);
      ++channels_;
    }
    readings_.insert(readings_.end(), sensor->readings().begin(), sensor->readings().end());
    points_.insert(points_.end(), sensor->points().begin(), sensor->points().end());
    states_ += sensor->states();
    need_current_ = need_current_ || sensor->needs_current();
  }
  current_.assign(robot_.joints.size(), 0.0);
  state_.q = state_.qd = current_;
  module_load_.assign(robot_.modules.size(), 0.0);
  body_load_.assign(robot_.bodies.size(), 0.0);
  motion_.resize(points_.size());
}

void LaneSensors::bind(Out numbers) {
  state_numbers_ = numbers.first(states_);
  values_ = numbers.subspan(states_);
}

void LaneSensors::sense(std::int64_t tick, const std::vector<ContactElement>& elements, std::span<const ContactSample> contacts,
                        const MeasuredValues& measured) {
  sum_loads(elements, contacts);
  compute_motion();
  Truth truth{tick, measured.angle, measured.speed, measured.torque, current_, module_load_, body_load_, measured.load, {}};
  std::size_t state = 0;
  std::size_t value = 0;
  std::size_t point = 0;
  for (const auto& sensor : sensors_) {
    const std::size_t points = sensor->points().size();
    truth.motion = std::span<const BodyMotion>(motion_).subspan(point, points);
    sensor->sense(truth, state_numbers_.subspan(state, sensor->states()), values_.subspan(value, sensor->readings().size()));
    state += sensor->states();
    value += sensor->readings().size();
    point += points;
  }
  // A second loop replaces the values, because all sensors need the true values.
  std::size_t channel = 0;
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    const std::size_t part = readings_[i].part;
    switch (readings_[i].replaces) {
      case Replaces::nothing:
        measured.channels[channel++] = values_[i];
        break;
      case Replaces::angle:
        measured.angle[part] = values_[i];
        break;
      case Replaces::speed:
        measured.speed[part] = values_[i];
        break;
      case Replaces::torque:
        measured.torque[part] = values_[i];
        break;
      case Replaces::touching:
        measured.touching[part] = values_[i];
        break;
      case Replaces::load:
        measured.load[part] = values_[i];
        break;
    }
  }
}

void LaneSensors::sum_loads(const std::vector<ContactElement>& elements, std::span<const ContactSample> contacts) {
  std::fill(module_load_.begin(), module_load_.end(), 0.0);
  std::fill(body_load_.begin(), body_load_.end(), 0.0);
  for (std::size_t c = 0; c < elements.size(); ++c) {
    body_load_[elements[c].body] += contacts[c].fn;
    module_load_[robot_.bodies[elements[c].body].module] += contacts[c].fn;
  }
}

void LaneSensors::compute_motion() {
  if (points_.empty()) return;
  kinematics_.update(robot_, state_);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Body& body = robot_.bodies[points_[i].body];
    const Mat3 R = kinematics_.R[body.link] * body.in_link.R;
    const Vec3 in_link = body.in_link * Vec3(points_[i].position[0], points_[i].position[1], points_[i].position[2]);
    const Vec3 v = kinematics_.velocity(body.link, kinematics_.point(body.link, in_link));
    const Vec3& w = kinematics_.omega[body.link];
    BodyMotion& motion = motion_[i];
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 3; ++column) {
        motion.rotation[static_cast<std::size_t>(3 * row + column)] = R(row, column);
      }
    }
    motion.angular_velocity = {w.x(), w.y(), w.z()};
    motion.velocity = {v.x(), v.y(), v.z()};
    motion.gravity = {gravity_.x(), gravity_.y(), gravity_.z()};
  }
}

}  // namespace gaitlab
