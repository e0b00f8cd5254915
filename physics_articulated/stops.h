// Torques of end stops, of stuck hinges and of passive hinges, for a scalar type T (double or lanes).
#pragma once
#include <span>
#include <vector>

#include "core/laws/hinge_stop.h"
#include "physics_articulated/body.h"
#include "physics_articulated/holds.h"
#include "physics_articulated/motion.h"

namespace gaitlab::articulated {

/// Laws of the hinges other than their motors, at a state x with the entries of StateLayout, SI.
template <class T>
class Stops {
 public:
  explicit Stops(const Tree<T>& tree) : holds(tree.lo.size()), hinges(tree.hinges), tree_(tree) {
    for (BasicPassiveHinge<T>& hinge : hinges) hinge.friction = T(0.0);  // StepMotors has it
  }

  /// Takes smooth laws of friction, for explicit methods.
  void creep() { hinges = tree_.hinges; }

  /// Torque of stop and passive hinge together if a step h ends with the speed qd.
  [[nodiscard]] StopTorque<T> both_at_end(std::span<const T> x, std::size_t j, const T& qd, double h) const {
    StopTorque<T> both = at_end(x, j, qd, h);
    for (std::size_t k = 0; k < tree_.passive.size(); ++k) {
      if (tree_.passive[k] != j) continue;
      const BasicPassiveHinge<T>& hinge = hinges[k];
      const auto loss = hinge.loss(qd);
      both.torque = both.torque + hinge.spring(x[StateLayout::kAngles + j] + T(h) * qd) + loss.torque;
      both.slope = both.slope + loss.slope + T(h) * hinge.stiffness;
    }
    return both;
  }

  /// Torque of a stop if a step h ends with the speed qd: -ks (q + h qd - q_lim) - cs qd, or 0 if the stop would pull. If the
  /// joint starts within its range, the damping torque is -cs (q + h qd - q_lim) / h, the mean over the step. The damping
  /// torque at the end of the step would jump.
  [[nodiscard]] StopTorque<T> at_end(std::span<const T> x, std::size_t j, const T& qd, double h) const {
    using math::select;
    const T& q = x[StateLayout::kAngles + j];
    const T &lo = tree_.lo[j], &hi = tree_.hi[j], zero = 0.0;
    constexpr double k = BasicHingeStop<T>::kStiffness;
    constexpr double c = BasicHingeStop<T>::kDamping;
    const auto up = q > 0.5 * (lo + hi);
    const T excess = q - select(up, hi, lo);
    const auto within = math::mask_and(q <= hi, q >= lo);
    const T end = excess + h * qd;
    const T torque = -k * end - c * select(within, (1 / h) * end, qd);
    const auto acts = math::mask_or(math::mask_and(up, torque < zero), math::fresh(torque > zero, up));
    const StopTorque<T> own{select(acts, torque, zero), select(acts, T(c + h * k), zero)};
    return holds.any() ? holds.instead_of(own, j, q, qd, h) : own;
  }

  /// Torque of a stop or of a stuck hinge at the state x, whose speed is qd.
  [[nodiscard]] T at(std::span<const T> x, std::size_t j, const T& qd) const {
    const T& q = x[StateLayout::kAngles + j];
    const T own = BasicHingeStop<T>::at(q, qd, tree_.lo[j], tree_.hi[j]).torque;
    return holds.any() ? holds.instead_of({own, T(0.0)}, j, q, qd, 0).torque : own;
  }

  Holds<T> holds;                            ///< their time is set before a step and before at()
  std::vector<BasicPassiveHinge<T>> hinges;  ///< laws of passive hinges, without dry friction unless it creeps

 private:
  const Tree<T>& tree_;
};

}  // namespace gaitlab::articulated
