// Position loops of the joints: stiffness, and largest gain of a joint that settles.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Position loop of a joint with a DC motor whose controller has a gain `Kp` in V/rad. Angles are sampled every T (control
/// period, or the longer one of the joint's encoder), and a command u turns the joint without load at u / (Ks n), with n the
/// gear ratio; for a servo, Ks n = V / w0. With D the response of the derivative part to an error that alternates, in V/rad, a
/// command removes the share g of an alternating error, and a deflected joint at rest makes the torque k times its error:
///
///     g = (Kp + D) T / (Ks n)      D = 2 Kd N / (2 Kd + N T)      k = Kp eta Kt n / R
///
/// (eq. 1-3, 5; k of directional gears has no eta).
///
/// With an angle that is d samples old, d >= 0, not always whole, the joint settles for
///
///     g < 2 / (2 d + 1)
///
/// without contact, springs and friction, whatever inertia J it moves (tests/report/verdict/position_loop_test.cpp). D
/// compensates for a part of the delay. With a delay, D is therefore 0 if Kd / N is at most 4 T (to 2 %), else the response to
/// a step, Kd N / (Kd + N T). The bound is exact for tau >> T, with tau = J R / (eta Kt Ks n^2), and without delay also for tau
/// = 0. For tau in between, a joint settles up to a larger g: up to 4.1 without delay and D (tau = T / 3.7), up to 8.7 with D =
/// Kp / 4, and never above that. Measured on eight robots: docs/paper.md.
struct PositionLoop {
  std::size_t joint = 0;
  double Kp = 0, Kd = 0;   ///< V/rad, V s/rad
  const char* key = "Kp";  ///< key of the controller that states Kp, its unit, and Kp per unit of it
  const char* unit = "V/rad";
  double per_key = 1;
  double factor = 1;      ///< gain of the encoder, a factor of g and k
  double sharp = 0;       ///< 1 / N, rad/V
  double emf = 0;         ///< Ks n, V s/rad
  double period = 0;      ///< T, s
  double tick = 0;        ///< s, time between commands: the control period, or the servo's own sample time
  double delay = 0;       ///< s, largest age of an angle that is measured
  double stiffness = 0;   ///< k, N m/rad
  double stall = 0;       ///< largest torque at rest, N m
  double step = 0;        ///< torque that one step of the encoder commands, N m
  double resolution = 0;  ///< step of the encoder, rad; 0 without an encoder
  /// True if the bound holds: the motor has back-EMF, and the responses of the derivative and the integral part to a step of
  /// the error, Kd N / (Kd + N T) and Ki T, are at most a quarter of Kp.
  bool bounded = false;

  [[nodiscard]] double derivative() const;                ///< D, V/rad
  [[nodiscard]] double gain() const;                      ///< g
  [[nodiscard]] double settles() const;                   ///< bound of g
  [[nodiscard]] double share() const;                     ///< g as a share of its bound; 0 without a bound
  [[nodiscard]] std::string key_text(double gain) const;  ///< `Kp 100 V/rad`, for a gain in V/rad
  /// Kp whose g is `share` of the bound, V/rad.
  [[nodiscard]] double Kp_of(double share) const;
  /// T whose g is `share` of the bound without delay, s; 0 if there is none.
  [[nodiscard]] double period_of(double share) const;
  bool operator==(const PositionLoop&) const = default;
};

/// Gain with which no joint settles (PositionLoop).
inline constexpr double kNeverSettles = 9;

/// Loops of all driven joints, in their order, without joints that make no torque; none if motors or controller are of another
/// kind. Throws PluginError.
std::vector<PositionLoop> position_loops(const Scenario& scenario);

/// `commands every 0.015 s, angles up to 0.03 s old`.
std::string commands_text(const PositionLoop& loop);

/// Line of `gaitlab check`: `k = 38.2 N m/rad at every joint (Kp 100 V/rad); the loop settles up to 116.1 N m/rad (Kp 304
/// V/rad) with commands every 0.015 s`. If joints differ: the range of k, and the numbers of the joint nearest to its bound.
std::string loop_text(const Scenario& scenario, const std::vector<PositionLoop>& loops);

}  // namespace gaitlab::report
