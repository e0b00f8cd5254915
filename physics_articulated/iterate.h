// Iterate and result of an implicit step, for a scalar type T (double or lanes).
#pragma once
#include <vector>

#include "physics_articulated/motion.h"
#include "physics_articulated/solo.h"

namespace gaitlab::articulated {

/// Result of one implicit step.
template <class T>
struct StepResult {
  std::vector<T> torque, speed, angle;  ///< at the end of the step: torques and speeds of motors, N m, rad/s; joint angles
  T contact = 0.0, friction = 0.0, stops = 0.0;  ///< work of the robot on the ground and on stops, J
  T hinges = 0.0;                                ///< work on dampers and friction of passive hinges, J
  explicit StepResult(std::size_t joints) : torque(joints), speed(joints), angle(joints) {}

  /// Takes the result of a solo in the lane `l`.
  void take(const Solo& solo, std::size_t l) {
    for (std::size_t j = 0; j < torque.size(); ++j) {
      math::lane(torque[j], l) = solo.torque[j];
      math::lane(speed[j], l) = solo.speed[j];
      math::lane(angle[j], l) = solo.angle[j];
    }
    math::lane(contact, l) = solo.contact;
    math::lane(friction, l) = solo.friction;
    math::lane(stops, l) = solo.stops;
    math::lane(hinges, l) = solo.hinges;
  }
};

/// Iterate of Newton's method: accelerations, and the torques of motors and of stops in the solve at these accelerations.
template <class T>
struct Iterate {
  std::vector<T> a, torque, stop;
  Iterate(std::size_t joints, std::size_t plays) : a(6 + joints + plays), torque(joints), stop(joints) {}

  /// Replaces the lanes `which` by those of another iterate.
  void move(const math::Mask<T>& which, const Iterate& to) {
    each(to, [&](T& from, const T& end) { from = math::select(which, end, from); });
  }
  /// Moves the lanes `which` by a share of the way to another iterate.
  void move(const math::Mask<T>& which, const T& share, const Iterate& to) {
    each(to, [&](T& from, const T& end) { from = between(which, share, from, end); });
  }

 private:
  template <class Go>
  void each(const Iterate& to, const Go& go) {
    for (std::vector<T> Iterate::*values : {&Iterate::a, &Iterate::torque, &Iterate::stop})
      for (std::size_t i = 0; i < (this->*values).size(); ++i) go((this->*values)[i], (to.*values)[i]);
  }
};

}  // namespace gaitlab::articulated
