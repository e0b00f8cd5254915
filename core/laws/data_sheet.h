// Units of data sheets of servos, and the gain that fits a servo.
#pragma once

namespace gaitlab {

inline constexpr double kKgfCm = 0.0980665;                // N m per kgf cm
inline constexpr double kRevPerMin = 0.10471975511965977;  // rad/s per rev/min

/// Gain Kp, V/rad, whose command removes a share of the error per control period: Kp = share * V / (w0 * period). w0 is the
/// no-load speed, rad/s, at the voltage V; `period` is in s.
inline constexpr double gain_of_share(double share, double voltage, double no_load_speed, double period) {
  return share * voltage / (no_load_speed * period);
}
/// Efficiency of a gear that eats a share of the sum of motor's and load's torque: T_m - T_l = share (T_m + T_l).
inline constexpr double efficiency_of_load(double share) { return (1 - share) / (1 + share); }
inline constexpr double load_of_efficiency(double eta) { return (1 - eta) / (1 + eta); }
inline constexpr double kUsualShare = 0.7;  // chosen (docs/library.md, inertia and gains): for gaits

}  // namespace gaitlab
