// Pass of core/simulation/meter_pass.h for the vector type `Lanes` of the including file. All operations are elementwise, so
// that the bits do not depend on the vector width. Files for other processor types must not share the compiled functions
// (tests/gates/kernels.sh).
#pragma once
#include "core/recording/motor_limit.h"
#include "core/simulation/meter_pass.h"

namespace gaitlab {
namespace {

constexpr std::size_t kLanesWide = sizeof(Lanes) / sizeof(double);
static_assert(kMeterBlock % kLanesWide == 0);
constexpr double kAtVoltage = saturation_of(MotorLimit::voltage), kAtCurrent = saturation_of(MotorLimit::current);

consteval std::size_t place(double JointStatistics::*member) {
  std::size_t k = 0;
  while (kJointStatistics[k].member != member) ++k;
  return k;
}

inline Lanes load(const double* from) {
  Lanes x;
  __builtin_memcpy(&x, from, sizeof(x));
  return x;
}
inline void store(double* to, const Lanes& x) { __builtin_memcpy(to, &x, sizeof(x)); }
// larger() and magnitude() have the same results as std::max and std::abs, also for NaN.
inline Lanes larger(const Lanes& a, const Lanes& b) { return a < b ? b : a; }
inline Lanes magnitude(const Lanes& x) { return x <= 0 ? 0 - x : x; }
inline void raise(double* to, const Lanes& value) { store(to, larger(load(to), value)); }
inline void add(double* to, const Lanes& value) { store(to, load(to) + value); }

/// Processes the entries of one vector, the first of which is entry `at`.
inline void add_lanes(const MeterPass& p, std::size_t at) {
  using F = JointStatistics;
  const Lanes zero = {};
  const Lanes one = zero + 1;
  const auto sum_of = [&](std::size_t k) { return p.sums[k] + at; };
  const Lanes angle = load(p.in.angle + at);
  const Lanes speed = load(p.in.speed + at);
  const Lanes torque = load(p.in.torque + at);
  const Lanes setpoint = load(p.in.setpoint + at);
  const Lanes current = load(p.in.current + at);
  const Lanes saturation = load(p.in.saturation + at);
  const Lanes gear = load(p.in.gear + at);
  const Lanes lo = load(p.lo + at);
  const Lanes hi = load(p.hi + at);
  const Lanes seen = load(p.seen + at);
  const auto driven = load(p.driven + at) > 0;
  const Lanes error = driven ? setpoint - angle : zero;
  const Lanes apart = magnitude(error);
  const Lanes excess = larger(larger(angle - hi, lo - angle), zero);
  const Lanes shaft = torque * speed;
  if (p.some) {
    const Lanes torque_now = seen * magnitude(torque);
    const Lanes apart_now = seen * apart;
    // Stores the time of a new peak. Called before the peak itself is updated.
    const auto first = [&](std::size_t when, std::size_t of, const Lanes& now) {
      double* const to = sum_of(when);
      store(to, now > kLarger * load(sum_of(of)) ? zero + p.time : load(to));
    };
    first(place(&F::torque_peak_time), place(&F::torque_peak), torque_now);
    raise(sum_of(place(&F::torque_peak)), torque_now);
    const Lanes before = load(p.recent.peak + at);
    store(p.recent.limit + at, torque_now > before ? saturation : load(p.recent.limit + at));
    store(p.recent.peak + at, larger(before, torque_now));
    raise(p.recent.error + at, apart_now);
    const Lanes speed_now = seen * magnitude(speed);
    raise(p.recent.speed + at, speed_now);
    const Lanes available = load(p.in.available + at);
    raise(p.recent.envelope + at, torque_now < available ? torque_now / available : torque_now > 0 ? one : zero);
    raise(p.recent.voltage + at, seen * magnitude(load(p.in.voltage + at)));
    const Lanes current_now = seen * magnitude(current);
    raise(p.recent.current + at, current_now);
    raise(sum_of(place(&F::speed_peak)), speed_now);
    raise(sum_of(place(&F::current_peak)), current_now);
    first(place(&F::error_peak_time), place(&F::error_peak), apart_now);
    raise(sum_of(place(&F::error_peak)), apart_now);
    if (p.time == 0) raise(sum_of(place(&F::start_jump)), apart_now);
    raise(sum_of(place(&F::range_worst)), seen * excess);
  }
  if (p.instant) return;
  const Lanes weight = load(p.weight + at);
  add(sum_of(place(&F::error_rms)), weight * (error * error));
  add(sum_of(place(&F::electrical)), weight * load(p.in.power_in + at));
  add(sum_of(place(&F::copper)), weight * load(p.in.copper + at));
  add(sum_of(place(&F::gear)), weight * gear);
  add(sum_of(place(&F::shaft)), weight * shaft);
  add(sum_of(place(&F::dry)), weight * load(p.in.dry + at));
  if (!p.some) return;
  const Lanes share = load(p.share + at);
  add(sum_of(place(&F::torque_rms)), share * (torque * torque));
  add(sum_of(place(&F::current_rms)), share * (current * current));
  add(sum_of(place(&F::saturated_voltage)), share * (saturation == kAtVoltage ? one : zero));
  add(sum_of(place(&F::saturated_current)), share * (saturation == kAtCurrent ? one : zero));
  add(sum_of(place(&F::range_share)), share * (excess > 0 ? one : zero));
  const auto outside = driven & ((setpoint > hi) | (setpoint < lo));
  add(sum_of(place(&F::setpoint_outside)), share * (outside ? one : zero));
  add(sum_of(place(&F::created)), share * larger(-gear, zero));
  add(sum_of(place(&F::shaft_positive)), share * larger(shaft, zero));
}

}  // namespace
}  // namespace gaitlab
