// Speeds that joints lose in a step because they turn back within it, but end it at rest.
#pragma once
#include <span>
#include <vector>

#include "core/simulation/state_layout.h"
#include "physics_articulated/implicit.h"

namespace gaitlab::articulated {

/// If a joint with friction turns back in the last part of a step, an implicit method ends this part at rest. The whole step
/// and its halves then agree on the speed 0, so that their difference does not show this error.
template <class T>
class LostSpeeds {
 public:
  /// `entries`: number of the entries of the state behind the joint angles.
  explicit LostSpeeds(std::size_t entries) : lost_(entries, T(0.0)) {}

  /// Finds the joints that the last part of a step, h seconds from `start` to `end`, ends at rest although their friction
  /// cannot hold them. On average they turn back after half of it: |acceleration| h / 2, rad/s. Returns the lanes of `which`
  /// whose accelerations at `end` were needed.
  math::Mask<T> find(Implicit<T>& implicit, const std::vector<T>& start, const std::vector<T>& end, In command, double h,
                     const math::Mask<T>& which) {
    math::Mask<T> any{};
    used_ = implicit.motors.any_jump;
    const Plays<T>& plays = implicit.plays;
    const std::size_t joints = implicit.motors.jumps.size();
    first_ = StateLayout::kAngles + joints;
    for (std::size_t j = 0; used_ && j < joints; ++j) {
      const std::size_t e = plays.entry(j);
      const auto rests = math::mask_and(math::abs(start[e]) > T(0.0), math::abs(end[e]) <= T(0.0));
      const auto here = math::mask_and(which, math::mask_and(implicit.motors.jumps[j], rests));
      lost_[e - first_] = math::select(here, T(h / 2), T(0.0));
      any = math::mask_or(any, here);
    }
    if (!math::any_lane(any)) return any;
    implicit.evaluate(std::span<const T>(end), command);
    for (std::size_t j = 0; j < joints; ++j) {
      T& lost = lost_[plays.entry(j) - first_];
      lost = lost * math::abs(implicit.accelerations()[6 + plays.shaft(j)]);
    }
    return any;
  }

  /// A difference of entry e of the state, with the lost speed of its joint.
  [[nodiscard]] T added(std::size_t e, const T& apart) const {
    return used_ && e >= first_ ? math::abs(apart) + lost_[e - first_] : apart;
  }

 private:
  std::size_t first_ = 0;  ///< entry of the first joint speed
  std::vector<T> lost_;    ///< rad/s, by entry of the state from the joint speeds on; 0 for entries other than speeds of motors
  bool used_ = false;
};

}  // namespace gaitlab::articulated
