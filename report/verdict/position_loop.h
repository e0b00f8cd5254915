// Position loops of the joints: stiffness, and largest gain of a joint that settles.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Position loop of a joint with a DC motor whose controller has a gain `Kp` in V/rad. Angles are sampled every T (control
/// period, or the longer one of the joint's encoder), and a command u turns the joint without load at u / (Ks n), with n the
/// gear ratio; for a servo, Ks n = V / w0. A command therefore removes the share g of the error, and a deflected joint at rest
/// makes the torque k times its error:
///
///     g = Kp T / (Ks n)        k = Kp eta Kt n / R        (eq. 1-3; without eta where the efficiency is directional)
///
/// With d the delay of the encoder in samples, the joint settles for g < 2 / (2 d + 1), whatever inertia J it moves, and never
/// for
///
///     g > 4.03 if d = 0        g > 2 sin(pi / (2 (2 d + 1))) if d >= 1
///
/// In between it depends on J, through tau = J R / (eta Kt Ks n^2): tau >> T has the first bound, tau = 0 the second one
/// (without delay the first), and tau = T / 3.6 has 4.03 (Kuruklis 1994, x_{k+1} = x_k - g x_{k-d}; Jury's criterion). Without
/// contact, springs and friction; measured on eight robots at 15 ms: all settle at 1.9, seven do not at 2.1, one, with heavy
/// legs, at 2.6 (docs/paper.md).
struct PositionLoop {
  std::size_t joint = 0;
  double Kp = 0;         ///< V/rad
  double stiffness = 0;  ///< k, N m/rad
  double stall = 0;      ///< largest torque at rest, N m
  double gain = 0;       ///< g
  /// First and second bound of g; infinite if the motor has no back-EMF, or the derivative part adds more than a quarter of the
  /// proportional part to a step of the error, so that it changes them.
  double settles = 2, never_settles = 4.03;
  double resolution = 0;  ///< step of the measured angle, rad; 0 without an encoder
  double period = 0;      ///< T, s
  double delay = 0;       ///< s, of the measured angle
  /// g as a share of its bound.
  [[nodiscard]] double share() const { return gain / settles; }
};

/// Loops of all driven joints, in their order; none if motors or controller are of another kind. Throws PluginError.
std::vector<PositionLoop> position_loops(const Scenario& scenario);

/// `commands every 0.015 s, angles that are 0.03 s old`.
std::string commands_text(const Scenario& scenario, const PositionLoop& loop);

/// Line of `gaitlab check`: `k = 38.2 N m/rad at every joint (Kp 100 V/rad); settles up to 119 N m/rad (Kp 312 V/rad) with a
/// command every 0.015 s`. If joints differ: the range of k, and the numbers of the joint nearest to its bound.
std::string loop_text(const Scenario& scenario, const std::vector<PositionLoop>& loops);

}  // namespace gaitlab::report
