// DC motor with gear: pure functions with their slopes, elementwise over joints and lanes.
#pragma once
#include <array>
#include <limits>

#include "core/math/functions.h"
#include "core/math/lanes.h"

namespace gaitlab {

/// i = (u - Ks n w) / R, |u| <= u_max, |i| <= i_max; T = eta Kt i n.  (eq. 1, 2; limits: text of the paper)
/// u: voltage, V; w: joint speed, rad/s; i: current, A; T: torque on the joint, N m; n: gear ratio; eta: efficiency. Inductance
/// is neglected, as in the paper. V: double or lanes.
///
/// As printed, eq. 2 multiplies the torque by eta in both directions. A joint that drives its motor then needs only eta T
/// instead of T / eta, and the gear creates energy. A directional gear has the efficiency `load`, beside eta:
///     T = load^s eta Kt i n, s = w sign(i) / reversal_speed within [-1, 1]
/// Its factor is `load` while the motor drives and 1 / load while it is back-driven, and its loss (1 - load^s) eta Kt i n w is
/// never negative. A torque that jumps at w = 0 would make any explicit method chatter. `reversal_speed` smooths the jump, as
/// v_lim does for friction. Implicit methods have `jumps` = 1 instead: s is the sign of w i. At w = 0 the torque is any between
/// those of both sides, and the joint can stick.
///
/// Power drawn: u i. With `returns` = 1, a motor that is driven gets back only eta Kt i n w of its joint's power, so that
/// neither eta nor the gear creates energy.
template <class V>
struct BasicDcMotor {
  V R = 1.0, Kt = 0.0, Ks = 0.0, gear = 1.0, efficiency = 1.0, u_max = 0.0, i_max = 0.0;
  V load = 1.0;            ///< efficiency of a directional gear; 1 for eq. 2 as printed
  V reversal_speed = 0.0;  ///< joint speed, rad/s; 0 for eq. 2 as printed, or for a gear that jumps
  V returns = 0.0;         ///< 1 or 0
  V jumps = 0.0;           ///< 1 for a directional gear that jumps at rest, otherwise 0
  V back_emf_damping = Kt * Ks * gear * gear / R;
  V log_load = math::log(load);     ///< <= 0
  V driven = math::exp(-log_load);  ///< 1 / load, with the rounding of exp(): factor of a gear that is driven by its joint
  V driving = math::exp(log_load);  ///< load, with the same rounding

  /// All members, in their order.
  static constexpr std::array<V BasicDcMotor::*, 15> constants() {
    using M = BasicDcMotor;
    return {&M::R,        &M::Kt,         &M::Ks,
            &M::gear,     &M::efficiency, &M::u_max,
            &M::i_max,    &M::load,       &M::reversal_speed,
            &M::returns,  &M::jumps,      &M::back_emf_damping,
            &M::log_load, &M::driven,     &M::driving};
  }
  /// Computes the constants that follow from others, after a change of others.
  void derive() { *this = {R, Kt, Ks, gear, efficiency, u_max, i_max, load, reversal_speed, returns, jumps}; }

  struct Effort {
    V torque;                        ///< N m
    V slope;                         ///< -dT/dw >= 0, N m s/rad: eta Kt Ks n^2 / R, 0 if limited; larger below `reversal_speed`
    V current;                       ///< A
    V voltage;                       ///< terminal voltage R i + Ks n w, V
    math::Mask<V> limited, clamped;  ///< true if the current is limited, or the command is clamped
    V drawn;                         ///< electrical power, W
    V copper, gear;                  ///< power lost in the winding and in the gear, W

    /// Limit as a number: 0 none, 1 voltage, 2 current.
    [[nodiscard]] V saturation() const { return math::select(limited, V(2.0), math::select(clamped, V(1.0), V(0.0))); }
  };

  /// A gear that jumps has the factor 1 at rest, between those of both sides.
  [[nodiscard]] Effort operator()(const V& command, const V& speed) const { return on(sign(speed), command, speed); }
  /// Effort by the law of one side of a jump, 1 (w >= 0) or -1 (w <= 0), continued past rest.
  [[nodiscard]] Effort on(const V& side, const V& command, const V& speed) const { return at(side, command, speed, i_max); }
  /// Effort without the current limit.
  [[nodiscard]] Effort unlimited(const V& command, const V& speed) const {
    return at(sign(speed), command, speed, std::numeric_limits<double>::infinity());
  }

 private:
  static V sign(const V& speed) {
    const V zero = 0.0;
    const V one = 1.0;
    return math::select(speed > zero, one, math::select(speed < zero, -one, zero));
  }
  [[nodiscard]] Effort at(const V& side, const V& command, const V& speed, const V& largest) const {
    using math::select;
    const V u = math::clamp(command, -u_max, u_max);
    const V emf = Ks * gear * speed;
    const V wanted = (u - emf) / R;
    const V current = math::clamp(wanted, -largest, largest);
    const auto limited = math::abs(wanted) > largest;
    const Share share = gear_share(side, current, speed);
    const V torque = share.eta * Kt * current * gear;
    const V voltage = select(limited, R * current + emf, u);
    const V copper = R * current * current;
    V drawn = voltage * current;
    const auto back = math::mask_and(returns > V(0.0), current * speed < V(0.0));
    if (math::any_lane(back)) drawn = select(back, copper + efficiency * Kt * current * gear * speed, drawn);
    return {torque,
            share.eta * select(limited, V(0.0), back_emf_damping) + share.slope * Kt * math::abs(current) * gear,
            current,
            voltage,
            limited,
            math::abs(command) > u_max,
            drawn,
            copper,
            drawn - copper - torque * speed};
  }

  struct Share {
    V eta;    ///< T / (Kt i n)
    V slope;  ///< -d eta / d(w sign(i)), s/rad
  };
  [[nodiscard]] Share gear_share(const V& side, const V& current, const V& speed) const {
    using math::select;
    const V zero = 0.0;
    const V one = 1.0;
    const auto jump = jumps > zero;
    if (math::any_lane(jump)) {
      const V along = select(current < zero, -side, side);
      const V factor = select(along > zero, driving, select(along < zero, driven, one));
      const Share smooth = smooth_share(current, speed);
      return {select(jump, efficiency * factor, smooth.eta), select(jump, zero, smooth.slope)};
    }
    return smooth_share(current, speed);
  }
  [[nodiscard]] Share smooth_share(const V& current, const V& speed) const {
    using math::select;
    const V zero = 0.0;
    const V one = 1.0;
    const auto directional = reversal_speed > zero;
    if (!math::any_lane(directional)) return {efficiency, zero};
    const V along = select(current < zero, -speed, speed) / select(directional, reversal_speed, one);
    const auto turning_over = math::mask_and(directional, math::abs(along) < one);
    V eta = select(directional, efficiency * select(along < zero, driven, driving), efficiency);
    if (!math::any_lane(turning_over)) return {eta, zero};
    eta = select(turning_over, efficiency * math::exp(log_load * math::clamp(along, -one, one)), eta);
    return {eta, select(turning_over, -eta * log_load / select(directional, reversal_speed, one), zero)};
  }
};

using DcMotor = BasicDcMotor<double>;

}  // namespace gaitlab
