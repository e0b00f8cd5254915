// Joints that stick in an implicit step: their modes, and the contradictions that change them.
#pragma once
#include "physics_articulated/body.h"
#include "physics_articulated/motors.h"

namespace gaitlab::articulated {

/// Changes the modes of StepMotors. `torque` contains the torques in the solve, N m, and `end` the speeds at the end of the
/// step, rad/s, both of the iterate and by joint.
template <class T>
class Sticking {
 public:
  static constexpr int kTogether = 10;        ///< solves after which only one joint at a time changes its mode
  static constexpr double kTolerance = 1e-9;  ///< share of the largest torque of a motor at rest

  Sticking(StepMotors<T>& motors, std::size_t joints) : locks(joints), motors_(motors) {}

  /// Gives joints that stick the acceleration that ends a step h at rest.
  void stop(std::span<const T> speed, double h) {
    for (std::size_t j = 0; j < speed.size(); ++j) locks.acceleration[j] = -speed[j] / T(h);
  }
  /// Locks joints that stick, and removes their motors from the forces and resistances of a solve.
  void lock(const std::vector<T>& stop, const std::vector<T>& stop_slope, const std::vector<T>& rotor, double h,
            std::vector<T>& force, std::vector<T>& diagonal) {
    locks.on = motors_.sticks;
    for (std::size_t j = 0; j < force.size(); ++j) {
      force[j] = math::select(locks.on[j], stop[j], force[j]);
      diagonal[j] = math::select(locks.on[j], rotor[j] + (h > 0 ? T(h) * stop_slope[j] : T(0.0)), diagonal[j]);
    }
  }
  /// Lets a joint turn if more than its friction would be needed to hold it at rest. Returns true if it did.
  bool release(std::size_t j) {
    const T& held = locks.torque[j];
    const T most = math::clamp(held, motors_.below[j], motors_.above[j]);
    const auto leave = math::mask_and(motors_.sticks[j], math::abs(held - most) > T(kTolerance) * motors_.scale[j]);
    motors_.law[j] = math::select(leave, most, motors_.law[j]);
    motors_.torque[j] = math::select(leave, most, motors_.torque[j]);
    motors_.sticks[j] = math::fresh(motors_.sticks[j], leave);
    return math::any_lane(leave);
  }
  /// Removes the rounding error of the end speeds of joints that stick. `speed`: at the start of the step, rad/s.
  void come_to_rest(std::span<const T> speed, std::vector<T>& end) const {
    for (std::size_t j = 0; j < end.size(); ++j) {
      const T still = T(kStill) * (T(1.0) + math::abs(speed[j]));
      end[j] = math::select(math::mask_and(motors_.sticks[j], math::abs(end[j]) <= still), T(0.0), end[j]);
    }
  }
  /// Lanes in which the iterate contradicts the mode of a joint.
  [[nodiscard]] math::Mask<T> contradicts(std::size_t j, const std::vector<T>& torque, const std::vector<T>& end) const {
    return math::mask_or(math::mask_or(turns_back(j, end), leaves(j, torque, end)), moves(j, end));
  }
  /// Changes the modes that contradict the iterate in the lanes `which`: of all joints of a lane, or, if `one`, of the first,
  /// which cannot cycle in a linear problem (the least-index rule of Murty, 1974). Adds the lanes with a change to `switched`,
  /// and returns true if there is one.
  bool change(const math::Mask<T>& which, const std::vector<T>& torque, const std::vector<T>& end, bool one,
              math::Mask<T>& switched) {
    math::Mask<T> may = which;
    math::Mask<T> any{};
    for (std::size_t j = 0; j < end.size(); ++j) {
      const auto leave = math::mask_and(may, leaves(j, torque, end));
      const auto stick = math::mask_and(may, turns_back(j, end));
      motors_.side[j] = math::select(leave, math::select(torque[j] > motors_.above[j], T(-1.0), T(1.0)), motors_.side[j]);
      motors_.sticks[j] = math::mask_or(stick, math::fresh(motors_.sticks[j], leave));
      const auto changed = math::mask_or(leave, stick);
      any = math::mask_or(any, changed);
      if (one) may = math::fresh(may, changed);
    }
    switched = math::mask_or(switched, any);
    return math::any_lane(any);
  }

  Locks<T> locks;  ///< of the last solve

 private:
  static constexpr double kStill = 1e-12;  // rad/s; rounding error of the speed of a joint that sticks

  /// Lanes in which a joint that sticks is not at rest, because a part of the way to the solve was taken.
  [[nodiscard]] math::Mask<T> moves(std::size_t j, const std::vector<T>& end) const {
    return math::mask_and(motors_.sticks[j], math::abs(end[j]) > T(0.0));
  }
  /// Lanes in which a joint sticks under a torque beyond its bounds.
  [[nodiscard]] math::Mask<T> leaves(std::size_t j, const std::vector<T>& torque, const std::vector<T>& end) const {
    const T slack = T(kTolerance) * motors_.scale[j];
    const auto beyond = math::mask_or(torque[j] > motors_.above[j] + slack, torque[j] < motors_.below[j] - slack);
    return math::fresh(math::mask_and(motors_.sticks[j], beyond), moves(j, end));
  }
  /// Lanes in which a joint turns against its side.
  [[nodiscard]] math::Mask<T> turns_back(std::size_t j, const std::vector<T>& end) const {
    const auto back = math::mask_and(motors_.jumps[j], motors_.side[j] * end[j] < T(0.0));
    return math::fresh(back, motors_.sticks[j]);
  }

  StepMotors<T>& motors_;
};

}  // namespace gaitlab::articulated
