// Agreement of two results of an adaptive step, which is divided if they do not agree.
#pragma once
#include <span>
#include <utility>

#include "physics_articulated/step_parts.h"

namespace gaitlab::articulated {

/// Compares the speeds of two results with the relative accuracy of the torques. The difference of a joint speed is converted
/// to a torque, relative to the largest torque of the joint so far. The difference of the base speeds is relative to kBaseSpeed
/// and kBaseTurn, because errors of the base change the torques only later. A motor at its limit and sliding contacts make the
/// tolerance smaller (decision 26); a time without them makes it larger (decision 48).
template <class T>
class Agreement {
 public:
  // Largest allowed difference between the results of two orders, in units of the accuracy. Together with the constants below,
  // these are the least strict values that bring the gaits and limits of docs/validation.md within the accuracy.
  static constexpr double kSecondOrder = 1, kThirdOrder = 2;

  explicit Agreement(const T& accuracy) : accuracy_(accuracy) {}

  /// Begins a whole step, `quiet` seconds after the last limit or slip.
  void begin(const T& quiet) {
    const auto up_to_one = [](const T& x) { return math::select(x < T(1.0), x, T(1.0)); };
    quiet_ = quiet;
    of_quiet_ =
        accuracy_ * (T(1.0) + T(kQuiet - 1) * up_to_one(T(1 / kQuietAfter) * quiet) * up_to_one(T(1 / kQuietAt) * accuracy_));
    event_ = {};
  }
  /// Adds an event in the lanes `which`.
  void add_event(const math::Mask<T>& which) { event_ = math::mask_or(event_, which); }
  /// Time since the last limit or slip, s, at the end of the whole step of `h` seconds.
  [[nodiscard]] T quiet(double h) const { return math::select(event_, T(0.0), quiet_ + T(h)); }

  /// Lanes of `which` in which no speed differs by more than `share` of the accuracy. `difference(e)`: difference of entry e of
  /// the state. `peak` contains the largest torque of each joint so far, N m.
  template <class Difference>
  math::Mask<T> within(double share, const math::Mask<T>& which, const StepLimits<T>& limits, const StepMotors<T>& motors,
                       const Plays<T>& plays, std::span<const T> peak, Difference difference) {
    math::Mask<T> within = which;
    math::Mask<T> loose = limits.slide;
    for (const math::Mask<T>& limited : limits.motor) loose = math::mask_or(loose, limited);
    event_ = math::mask_or(event_, math::mask_and(which, loose));
    const T allowed = T(share) * math::select(loose, accuracy_, of_quiet_);
    const std::size_t joints = limits.motor.size();
    for (std::size_t j = 0; j < joints; ++j) {
      const T least = kFloor * motors.scale[j];
      T apart = motors.per_speed[j] * math::abs(difference(plays.entry(j)));
      if (plays.has(j)) {  // the speed of the link counts like that of its motor
        const T of_link = motors.per_speed[j] * math::abs(difference(StateLayout::kAngles + joints + j));
        apart = math::select(of_link > apart, of_link, apart);
      }
      const T here = math::select(limits.motor[j], kAtLimit * allowed, allowed);
      within = math::mask_and(within, apart <= here * math::select(peak[j] > least, peak[j], least));
    }
    const T of_base = math::select(loose, kLoose * allowed, allowed);
    for (const auto& [first, speed] :
         {std::pair(StateLayout::kVelocity, kBaseSpeed), {StateLayout::kAngularVelocity, kBaseTurn}}) {
      const Vec<T> apart{difference(first), difference(first + 1), difference(first + 2)};
      const T most = speed * of_base;
      within = math::mask_and(within, dot(apart, apart) <= most * most);
    }
    return within;
  }

 private:
  static constexpr double kBaseSpeed = 0.02, kBaseTurn = 0.2;  ///< m/s, rad/s
  static constexpr double kFloor = 0.01;                       ///< least largest torque, as a share of that at rest
  // An undamped speed error becomes a position error, which changes a torque long after the step that caused the error.
  static constexpr double kAtLimit = 0.25;  ///< factor on the tolerance of a joint whose motor is at its limit
  static constexpr double kLoose = 0.5;     ///< factor on the tolerance of the base, for a motor at its limit or a sliding load
  // A motion without limits and slipping is smooth, and its error is a small share of the accuracy, the smaller the less
  // accurate it is.
  static constexpr double kQuiet = 2;         ///< factor on the tolerances in such a motion
  static constexpr double kQuietAfter = 0.5;  ///< s; the factor grows linearly from 1 in this time after a limit or slip
  static constexpr double kQuietAt = 0.01;    ///< accuracy with the whole factor; smaller accuracies have a smaller one

  T accuracy_;
  T quiet_ = 0.0, of_quiet_ = 0.0;  ///< at the start of the whole step: time, s, and accuracy
  math::Mask<T> event_{};           ///< lanes with a limit or a slip since then
};

}  // namespace gaitlab::articulated
