// Gears with play in an implicit step: motors with angles and speeds of their own, and the flanks that join them to the links.
#pragma once
#include <span>
#include <vector>

#include "core/math/functions.h"
#include "core/simulation/state_layout.h"
#include "physics_articulated/motors.h"
#include "physics_articulated/sticking.h"
#include "physics_articulated/tree.h"

namespace gaitlab::articulated {

/// The motor of a joint with play is a coordinate beside those of the tree: angle r and speed w of the motor, geared, relative
/// to the same body as the joint angle q (docs/equations.md, 3):
///     J w' = T(u, w) + g        M v' = ... - g        g = torque of the flanks at (r - q, w - q')
/// J: reflected inertia of the rotor, which is not part of M. A step therefore solves for w' by hand:
///     w' = (T + g + K q'') / (J + h s + K)
/// with T and g at the start speeds and the slopes s of T and K / h of g. The joint keeps one resistance, so that
/// the recursion is unchanged. A motor that sticks has a given w'. A step that crosses the whole play meets the flank at its
/// end. Only the constructor allocates.
template <class T>
class Plays {
 public:
  /// `rotor` contains the reflected inertia of each joint; those of joints with play are taken out.
  Plays(const Tree<T>& tree, std::vector<T>& rotor) : tree_(tree), joints_(tree.lo.size()), entry_(joints_), shaft_(joints_) {
    for (std::size_t j = 0; j < joints_; ++j) {
      entry_[j] = StateLayout::kAngles + joints_ + j;
      shaft_[j] = j;
    }
    for (std::size_t k = 0; k < tree.plays.size(); ++k) {
      const std::size_t j = tree.plays[k].joint;
      entry_[j] = speeds() + k;
      shaft_[j] = joints_ + k;
      inertia_.push_back(rotor[j]);
      rotor[j] = T(0.0);
    }
    const std::size_t count = tree.plays.size();
    for (auto* values : {&torque, &slope, &now, &next}) values->assign(count, T(0.0));
    if (count > 0) of_motors_.assign(joints_, T(0.0));
  }

  [[nodiscard]] bool any() const { return !torque.empty(); }
  [[nodiscard]] std::size_t size() const { return torque.size(); }
  [[nodiscard]] bool has(std::size_t j) const { return shaft_[j] != j; }
  /// Entry of the state with the speed of the motor of a joint.
  [[nodiscard]] std::size_t entry(std::size_t j) const { return entry_[j]; }
  /// Number of the acceleration of the motor of a joint, behind the six of the base.
  [[nodiscard]] std::size_t shaft(std::size_t j) const { return shaft_[j]; }
  /// Speeds of the motors of all joints at the state x; valid until the next call.
  [[nodiscard]] std::span<const T> motor_speeds(std::span<const T> x) {
    const std::span<const T> of_joints = x.subspan(StateLayout::kAngles + joints_, joints_);
    if (!any()) return of_joints;
    std::ranges::copy(of_joints, of_motors_.begin());
    for (std::size_t k = 0; k < size(); ++k) of_motors_[joint(k)] = x[speeds() + k];
    return of_motors_;
  }

  /// Sets the torques of the flanks at the state x.
  void evaluate(std::span<const T> x) {
    for (std::size_t k = 0; k < size(); ++k) {
      torque[k] = tree_.plays[k].law.at(angle(x, k), speed(x, k)).torque;
      slope[k] = T(0.0);
    }
  }
  /// Power that the flanks take from motors and links, W, after evaluate().
  [[nodiscard]] T power(std::span<const T> x) const {
    T sum = 0.0;
    for (std::size_t k = 0; k < size(); ++k) sum = sum - torque[k] * speed(x, k);
    return sum;
  }

  /// Sets the tangents at the start of a step.
  void start(std::span<const T> x, double h) {
    for (std::size_t k = 0; k < size(); ++k) {
      const Flank at = flanks(x, k, speed(x, k), h);
      torque[k] = at.torque;
      slope[k] = at.slope;
    }
  }
  /// Replaces forces and resistances of the joints with play, and unlocks these joints, whose motors may stick.
  void reduce(const StepMotors<T>& motors, const std::vector<T>& stop, const std::vector<T>& stop_slope, double h,
              Locks<T>& locks, std::vector<T>& force, std::vector<T>& diagonal) {
    for (std::size_t k = 0; k < size(); ++k) {
      const std::size_t j = joint(k);
      const T K = T(h) * slope[k];
      const T free = without_flanks(k, motors, h);
      const T held = stop[j] - torque[k];
      const T share = K / (free + K);
      const auto sticks = motors.any_jump ? motors.sticks[j] : math::Mask<T>{};
      force[j] = math::select(sticks, held + K * locks.acceleration[j], held + share * (motors.torque[j] + torque[k]));
      diagonal[j] = T(h) * stop_slope[j] + math::select(sticks, K, share * free);
      locks.on[j] = {};
    }
  }
  /// Computes the accelerations of the motors, which `a` has behind those of the joints, the torques of the flanks in the
  /// solve, and the torques that hold motors that stick.
  void recover(const StepMotors<T>& motors, double h, Locks<T>& locks, std::vector<T>& a) {
    for (std::size_t k = 0; k < size(); ++k) {
      const std::size_t j = joint(k);
      const T& of_joint = a[6 + j];
      const T K = T(h) * slope[k];
      const T turning = (motors.torque[j] + torque[k] + K * of_joint) / (without_flanks(k, motors, h) + K);
      const auto sticks = motors.any_jump ? motors.sticks[j] : math::Mask<T>{};
      a[6 + joints_ + k] = math::select(sticks, locks.acceleration[j], turning);
      next[k] = torque[k] - K * (a[6 + joints_ + k] - of_joint);
      locks.torque[j] = math::select(sticks, inertia_[k] * locks.acceleration[j] - next[k], locks.torque[j]);
    }
  }

  /// Replaces the iterate by a part of the way to the last solve.
  void move(const math::Mask<T>& which, const T& share) {
    for (std::size_t k = 0; k < size(); ++k) now[k] = between(which, share, now[k], next[k]);
  }
  /// Torque of the flanks if a step h ends with these speeds of motors and links, by joint.
  [[nodiscard]] T law(std::span<const T> x, std::size_t k, const std::vector<T>& motors, const std::vector<T>& links,
                      double h) const {
    return flanks(x, k, motors[joint(k)] - links[joint(k)], h).torque;
  }
  /// Sets the tangents at these end speeds in the lanes `which`.
  void touch(const math::Mask<T>& which, std::span<const T> x, const std::vector<T>& motors, const std::vector<T>& links,
             double h) {
    for (std::size_t k = 0; k < size(); ++k) {
      const T last = motors[joint(k)] - links[joint(k)];
      const Flank at = flanks(x, k, last, h);
      slope[k] = math::select(which, at.slope, slope[k]);
      torque[k] = math::select(which, at.torque + at.slope * (last - speed(x, k)), torque[k]);
    }
  }
  /// Work on the flanks in the iterate, J, with the mean of the speeds at start and end of the step.
  [[nodiscard]] T work(std::span<const T> x, const std::vector<T>& a, double h) const {
    T sum = 0.0;
    for (std::size_t k = 0; k < size(); ++k) {
      const T change = T(h) * (a[6 + joints_ + k] - a[6 + joint(k)]);
      sum = sum - T(h) * now[k] * (speed(x, k) + T(0.5) * change);
    }
    return sum;
  }

  [[nodiscard]] std::size_t joint(std::size_t k) const { return tree_.plays[k].joint; }
  [[nodiscard]] std::size_t angles() const { return StateLayout::kAngles + 2 * joints_; }  ///< entry of the first
  [[nodiscard]] std::size_t speeds() const { return angles() + tree_.plays.size(); }       ///< entry of the first

  std::vector<T> torque, slope;  ///< linear model of the flanks in a solve, for the motor: torque - slope (dd - dd_start)
  std::vector<T> now, next;      ///< torques of the flanks on the motors in the iterate and in the last solve, N m

 private:
  /// Inertia and resistance of a motor without its flanks. The slope of a motor that stuck in the last step is infinite.
  [[nodiscard]] T without_flanks(std::size_t k, const StepMotors<T>& motors, double h) const {
    return h > 0 ? inertia_[k] + T(h) * motors.slope[joint(k)] : inertia_[k];
  }
  struct Flank {
    T torque, slope;
  };

  /// Angle and speed of the motor relative to the link.
  [[nodiscard]] T angle(std::span<const T> x, std::size_t k) const {
    return x[angles() + k] - x[StateLayout::kAngles + joint(k)];
  }
  [[nodiscard]] T speed(std::span<const T> x, std::size_t k) const {
    return x[speeds() + k] - x[StateLayout::kAngles + joints_ + joint(k)];
  }

  /// Torque on the motor at the end of a step h with the relative speed dd. As at the stop of a hinge (implicit.h), the damping
  /// is its mean over the step where the motor starts within the play.
  [[nodiscard]] Flank flanks(std::span<const T> x, std::size_t k, const T& dd, double h) const {
    using math::select;
    const BasicGearPlay<T>& own = tree_.plays[k].law;
    const T d = angle(x, k), zero = 0.0, c = own.damping();
    Flank both{zero, zero};
    for (const double side : {-1.0, 1.0}) {
      const T excess = T(side) * d - own.half;
      const T rate = T(side) * dd;
      const T last = excess + T(h) * rate;
      const T push = own.stiffness * last + c * select(excess > zero, rate, T(1 / h) * last);
      const auto acts = push > zero;
      both.torque = both.torque - select(acts, T(side) * push, zero);
      both.slope = both.slope + select(acts, c + T(h) * own.stiffness, zero);
    }
    return both;
  }

  const Tree<T>& tree_;
  std::size_t joints_;
  std::vector<std::size_t> entry_, shaft_;
  std::vector<T> inertia_;    ///< reflected inertia of the rotors of joints with play, kg m^2
  std::vector<T> of_motors_;  ///< result of motor_speeds(); empty without play
};

}  // namespace gaitlab::articulated
