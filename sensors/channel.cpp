#include "sensors/channel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/periods.h"

namespace gaitlab::sensors {
namespace {

// Numbers of the draws. Component i of a vector uses the draw + i.
constexpr std::uint32_t kNoise = 0;
constexpr std::uint32_t kWalk = 8;
constexpr std::uint32_t kLost = 16;
constexpr std::uint32_t kZero = 24;  // this draw and the following ones are made once per run
constexpr std::uint32_t kGain = 32;
constexpr std::uint32_t kDelay = 40;

std::int64_t ticks(double time, double period) { return time > 0 ? math::steps_in(time, period) : 0; }

}  // namespace

Channel::Channel(const ChannelKeys& keys, const SensorSite& site, std::string name, std::size_t size)
    : keys_(keys),
      name_(std::move(name)),
      size_(size),
      draws_(site.seed, name_),
      every_(std::max<std::int64_t>(1, ticks(keys.period, site.period))),
      sample_period_(static_cast<double>(every_) * site.period),
      lo_(keys.range.empty() ? -std::numeric_limits<double>::infinity() : keys.range[0]),
      hi_(keys.range.empty() ? std::numeric_limits<double>::infinity() : keys.range[1]) {
  const std::int64_t least = ticks(keys.delay_least, site.period);
  const std::int64_t most = ticks(keys.delay_most, site.period);
  const auto choices = static_cast<double>(most - least + 1);
  // uniform() may be 1.
  delay_ = std::min(most, least + static_cast<std::int64_t>(choices * draws_.uniform(0, kDelay)));
  for (std::uint32_t i = 0; i < size_; ++i) {
    gain_[i] = keys.gain * (1 + keys.gain_deviation * draws_.normal(0, kGain + i));
    constant_[i] = keys.zero * draws_.normal(0, kZero + i) + keys.bias;
  }
  if (keys.walk_time > 0) {
    keeps_ = math::exp(-sample_period_ / keys.walk_time);
    wanders_ = keys.walk * std::sqrt(keys.walk_time / 2 * (1 - keeps_ * keeps_));
  } else {
    wanders_ = keys.walk * std::sqrt(sample_period_);
  }
}

void Channel::sense(std::int64_t tick, In truth, Out state, Out value) const {
  const Out walk = state.first(size_);
  const Out held = state.subspan(size_, size_);
  const Out line = state.subspan(2 * size_);
  if (tick == 0) std::fill(walk.begin(), walk.end(), 0.0);
  if (tick % every_ == 0) sample(tick, truth, walk, held);
  // A ring of d + 1 samples, in which tick k has slot k mod (d + 1). Tick k - d has the slot after it.
  const std::size_t ring = slots();
  const auto now = static_cast<std::size_t>(tick) % ring;
  const std::size_t first = tick == 0 ? 0 : now;
  const std::size_t last = tick == 0 ? ring : now + 1;
  for (std::size_t slot = first; slot < last; ++slot) std::ranges::copy(held, line.subspan(slot * size_).begin());
  std::ranges::copy(line.subspan((now + 1) % ring * size_, size_), value.begin());
}

void Channel::sample(std::int64_t tick, In truth, Out walk, Out held) const {
  const auto k = static_cast<std::uint64_t>(tick);
  for (std::uint32_t i = 0; wanders_ > 0 && i < size_; ++i) {
    walk[i] = keeps_ * walk[i] + wanders_ * draws_.normal(k, kWalk + i);
  }
  if (tick > 0 && keys_.lost > 0 && draws_.uniform(k, kLost) <= keys_.lost) return;
  for (std::uint32_t i = 0; i < size_; ++i) {
    double a = gain_[i] * truth[i] + constant_[i] + walk[i];
    if (keys_.noise > 0) a += keys_.noise * draws_.normal(k, kNoise + i);
    held[i] = quantised(std::clamp(a, lo_, hi_));
  }
}

double Channel::quantised(double value) const {
  const double q = keys_.resolution;
  return q > 0 ? q * std::floor(value / q + 0.5) : value;
}

}  // namespace gaitlab::sensors
