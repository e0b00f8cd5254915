// Parts of a step, from which torques, works and statistics are summed, and the numbers that a rollout keeps between steps.
#pragma once
#include <array>

#include "physics_articulated/implicit.h"

namespace gaitlab::articulated {

/// Motors and works at one time within a step, with their weights in sums over the step.
template <class T>
struct StepPart : StepResult<T> {
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
  [[nodiscard]] std::size_t quiet() const { return joints + 3; }   ///< time without limits and slipping, s
  [[nodiscard]] std::size_t size() const { return joints + 4; }
};

/// Index of the lane if `which` contains exactly one, otherwise kLanes.
template <class T>
std::size_t only_lane(const math::Mask<T>& which) {
  const T one = math::select(which, T(1.0), T(0.0));
  std::size_t found = math::kLanes<T>;
  for (std::size_t l = 0; l < math::kLanes<T>; ++l) {
    if (!(math::lane(one, l) > 0)) continue;
    if (found < math::kLanes<T>) return math::kLanes<T>;
    found = l;
  }
  return found;
}

/// Lanes whose state is finite. Shorter steps cannot repair the other lanes.
template <class T>
math::Mask<T> finite(std::span<const T> x) {
  T sum = 0.0;
  for (const T& one : x) sum = sum + T(0.0) * one;
  return sum <= T(0.0);
}

/// A state, and the parts [from, to) of the steps that led to it.
template <class T>
struct StepWay {
  std::vector<T> x;
  std::size_t from = 0, to = 0;
};

/// Lanes in which a motor is at its limit, by joint, and lanes in which most of the load slides; both after a solve.
template <class T>
struct StepLimits {
  std::vector<math::Mask<T>> motor;
  math::Mask<T> slide;
};

/// Steps tried at one level: one whole step, two halves and four quarters of it. The first half, the first quarter and the
/// first two quarters are also the first trials of the next level.
template <class T>
struct Level {
  std::vector<T> start;
  double at = 0;  ///< s, time of the start since the whole step began
  StepWay<T> whole, halves, quarters, half, quarter, early;
  StepLimits<T> limits;  ///< after the first two quarters
};

/// States at the eighths of an adaptive step, in the lanes where a part of the divided step ended there.
template <class T>
class Eighths {
 public:
  explicit Eighths(std::size_t numbers) { states_.fill({std::vector<T>(numbers, T(0.0)), math::Mask<T>{}}); }

  void clear() {
    for (State& one : states_) one.lanes = math::Mask<T>{};
  }
  /// Keeps the state x of the lanes `which` if the time `at` / `of` of the step is one of its inner eighths.
  void keep(std::span<const T> x, const math::Mask<T>& which, std::size_t at, std::size_t of) {
    if (at == of || at * kEighths % of != 0) return;
    State& one = states_[at * kEighths / of - 1];
    for (std::size_t e = 0; e < x.size(); ++e) one.x[e] = math::select(which, x[e], one.x[e]);
    one.lanes = math::mask_or(one.lanes, which);
  }
  /// See Plant::state_within.
  bool state(std::size_t lane, std::size_t eighth, Out out) const {
    const State& one = states_[eighth - 1];
    if (!(math::lane(math::select(one.lanes, T(1.0), T(0.0)), lane) > 0)) return false;
    for (std::size_t e = 0; e < one.x.size(); ++e) out[e * math::kLanes<T> + lane] = math::lane(one.x[e], lane);
    return true;
  }

 private:
  struct State {
    std::vector<T> x;
    math::Mask<T> lanes{};
  };
  std::array<State, kEighths - 1> states_;
};

}  // namespace gaitlab::articulated
