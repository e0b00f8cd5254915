// Parts of a step, from which torques, works and statistics are summed, and the numbers that a rollout keeps between steps.
#pragma once
#include "physics_articulated/implicit.h"

namespace gaitlab::articulated {

/// Motors and works at one time within a step, with the weights of this time.
template <class T>
struct Part : StepResult<T> {
  using StepResult<T>::StepResult;
  math::Mask<T> lanes{};  ///< lanes to which the part belongs
  double h = 0;           ///< duration of the part, s; 0 for the start of the step under the new command
  T sum = 0.0;            ///< weight in integrals, s; from Richardson's extrapolation, may be negative
  T share = 0.0;          ///< weight in shares of time, s
  T off = 0.0;            ///< number of motors and stops that do not satisfy their law
  /// False for a trial that no lane uses. Its numbers need not be finite.
  [[nodiscard]] bool weighed() const { return math::any_lane(math::mask_or(T(0.0) < math::abs(sum), T(0.0) < share)); }
};

/// Layout of the numbers that a rollout keeps between steps in addition to its state: one entry per joint, then single entries.
struct History {
  std::size_t joints = 0;
  [[nodiscard]] std::size_t peak() const { return 0; }  ///< per joint: largest motor torque at the end of a step so far, N m
  [[nodiscard]] std::size_t solves() const { return joints; }
  [[nodiscard]] std::size_t off() const { return joints + 1; }  ///< number of torques that differ from their law after a step
  [[nodiscard]] std::size_t coarse() const { return joints + 2; }  ///< time in which the shortest steps missed the accuracy, s
  [[nodiscard]] std::size_t size() const { return joints + 3; }
};

/// A state, and the parts [from, to) of the steps that led to it.
template <class T>
struct Way {
  std::vector<T> x;
  std::size_t from = 0, to = 0;
};

/// Lanes in which a motor is at its limit, by joint, and lanes in which most of the load slides; both after a solve.
template <class T>
struct Limits {
  std::vector<math::Mask<T>> motor;
  math::Mask<T> slide;
};

/// Steps tried at one level: one, two and four that together have the length of the level. The first half, the first quarter
/// and the first two quarters are the first trials of the next level.
template <class T>
struct Level {
  std::vector<T> start;
  Way<T> whole, halves, quarters, half, quarter, early;
  Limits<T> limits;  ///< after the first two quarters
};

}  // namespace gaitlab::articulated
