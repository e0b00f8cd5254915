// Sensor channel: from a true value, or three of a vector, to the value that is read.
#pragma once
#include <cstdint>
#include <string>

#include "core/math/philox.h"
#include "core/plugin/sensor.h"
#include "sensors/channel_keys.h"

namespace gaitlab::sensors {

/// At every Nth control tick k (N = period / Ts; Ts is the control period) a sample s of the true value x is taken:
///
///     a_k = G x_k + z + bias + b_k + noise n_k           G = gain (1 + gain_deviation g), z = zero m
///     s_k = q floor(clamp(a_k, lo, hi) / q + 1/2)        q = resolution; q = 0: s_k = clamp(a_k, lo, hi)
///     b_k = e^(-N Ts / tau) b_(k-N) + walk W w_k         W^2 = tau/2 (1 - e^(-2 N Ts / tau)); tau = walk_time
///                                                        tau = 0: b_k = b_(k-N) + walk (N Ts)^1/2 w_k; b = 0 before tick 0
///
/// A lost sample is replaced by the previous one. The sample s is held until the next. The value at tick k is y_k = s_(k-d),
/// and s_0 before tick d; d is a whole number of control periods, drawn once per run with equal probabilities. n, m, g and w
/// are normal with deviation 1. All draws come from PhiloxStream(seed, name), at the tick k or, if they are drawn once per run,
/// at the tick 0. Values are exact if all errors are 0.
///
/// Reference for b: first-order Gauss-Markov process, IEEE Std 952-1997, annex B. Quantisation precedes the delay (chosen),
/// because the delay is that of a bus behind the converter.
class Channel {
 public:
  /// A channel of `size` numbers (at most 3) with common losses and delay. Periods and delays of `keys` are whole numbers of
  /// control periods.
  Channel(const ChannelKeys& keys, const SensorSite& site, std::string name, std::size_t size = 1);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] SensorStream stream() const { return {name_, math::fnv1a32(name_)}; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t states() const { return size_ * (2 + slots()); }
  [[nodiscard]] bool quantises() const { return keys_.resolution > 0; }
  [[nodiscard]] bool draws() const {
    return keys_.noise > 0 || keys_.zero > 0 || keys_.gain_deviation > 0 || keys_.walk > 0 || keys_.lost > 0 ||
           keys_.delay_most > keys_.delay_least;
  }
  [[nodiscard]] std::int64_t delay() const { return delay_; }            ///< d
  [[nodiscard]] double sample_period() const { return sample_period_; }  ///< N Ts, s
  /// True if a new sample arrives at this tick.
  [[nodiscard]] bool arrives(std::int64_t tick) const { return tick >= delay_ && (tick - delay_) % every_ == 0; }

  /// Computes the value at a control tick. It must be called at every tick in order; tick 0 initialises the state. Allocates
  /// nothing.
  void sense(std::int64_t tick, In truth, Out state, Out value) const;

 private:
  [[nodiscard]] std::size_t slots() const { return static_cast<std::size_t>(delay_) + 1; }
  void sample(std::int64_t tick, In truth, Out walk, Out held) const;
  [[nodiscard]] double quantised(double value) const;

  ChannelKeys keys_;
  std::string name_;
  std::size_t size_;
  math::PhiloxStream draws_;
  std::int64_t every_, delay_ = 0;                   ///< N, d
  double sample_period_;                             ///< s
  double lo_, hi_;                                   ///< range
  double keeps_ = 1, wanders_ = 0;                   ///< e^(-N Ts / tau), walk W
  std::array<double, 3> gain_ = {}, constant_ = {};  ///< G, z + bias
};

}  // namespace gaitlab::sensors
