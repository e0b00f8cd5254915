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
  explicit LostSpeeds(std::size_t joints) : lost_(joints, T(0.0)) {}

  /// Finds the joints that the last part of a step, h seconds from `start` to `end`, ends at rest although their friction
  /// cannot hold them. On average they turn back after half of it: |acceleration| h / 2, rad/s. Returns the lanes of `which`
  /// whose accelerations at `end` were needed.
  math::Mask<T> find(Implicit<T>& implicit, const std::vector<T>& start, const std::vector<T>& end, In command, double h,
                     const math::Mask<T>& which) {
    math::Mask<T> any{};
    used_ = implicit.motors.any_jump;
    for (std::size_t j = 0; used_ && j < lost_.size(); ++j) {
      const std::size_t e = first() + j;
      const auto rests = math::mask_and(math::abs(start[e]) > T(0.0), math::abs(end[e]) <= T(0.0));
      const auto here = math::mask_and(which, math::mask_and(implicit.motors.jumps[j], rests));
      lost_[j] = math::select(here, T(h / 2), T(0.0));
      any = math::mask_or(any, here);
    }
    if (!math::any_lane(any)) return any;
    implicit.evaluate(std::span<const T>(end), command);
    for (std::size_t j = 0; j < lost_.size(); ++j) lost_[j] = lost_[j] * math::abs(implicit.accelerations()[6 + j]);
    return any;
  }

  /// A difference of entry e of the state, with the lost speed of its joint.
  [[nodiscard]] T added(std::size_t e, const T& apart) const {
    return used_ && e >= first() ? math::abs(apart) + lost_[e - first()] : apart;
  }

 private:
  [[nodiscard]] std::size_t first() const { return StateLayout::kAngles + lost_.size(); }

  std::vector<T> lost_;  ///< rad/s, by joint
  bool used_ = false;
};

}  // namespace gaitlab::articulated
