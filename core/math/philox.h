// Philox4x32-10, and streams of random numbers selected by seed and name.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "core/math/functions.h"

namespace gaitlab::math {

using PhiloxKey = std::array<std::uint32_t, 2>;
using PhiloxBlock = std::array<std::uint32_t, 4>;

/// Philox4x32-10: four random words that depend on counter and key alone. Reference: Salmon, Moraes, Dror, Shaw, Parallel
/// random numbers: as easy as 1, 2, 3, SC11, with the constants of its table 2.
constexpr PhiloxBlock philox(PhiloxBlock counter, PhiloxKey key) {
  constexpr std::uint64_t kFirst = 0xD2511F53;
  constexpr std::uint64_t kSecond = 0xCD9E8D57;
  constexpr PhiloxKey kWeyl{0x9E3779B9, 0xBB67AE85};
  constexpr int kRounds = 10;
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t a = kFirst * counter[0];
    const std::uint64_t b = kSecond * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32U) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32U) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key = {key[0] + kWeyl[0], key[1] + kWeyl[1]};
  }
  return counter;
}

/// FNV-1a hash with 32 bits (Fowler, Noll, Vo).
constexpr std::uint32_t fnv1a32(std::string_view text) {
  constexpr std::uint32_t kOffset = 0x811C9DC5;
  constexpr std::uint32_t kPrime = 0x01000193;
  std::uint32_t hash = kOffset;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  return hash;
}

/// Random numbers by tick and draw. The key of Philox is the seed, and its counter is (tick low, tick high, FNV-1a-32(name),
/// draw). No draw therefore depends on an earlier draw or on another stream. Streams whose names have the same hash are equal.
class PhiloxStream {
 public:
  PhiloxStream(std::uint64_t seed, std::string_view name) : key_{low(seed), high(seed)}, name_(fnv1a32(name)) {}

  /// Uniformly distributed number in (0, 1]: (the upper 53 bits of the first two words + 1/2) 2^-53.
  [[nodiscard]] double uniform(std::uint64_t tick, std::uint32_t draw) const { return above_zero(block(tick, draw)); }

  /// Normally distributed number with mean 0 and deviation 1 (Box and Muller): sqrt(-2 ln u) cos(2 pi v), where u is uniform()
  /// and v has the upper 53 bits of the other two words.
  [[nodiscard]] double normal(std::uint64_t tick, std::uint32_t draw) const {
    const PhiloxBlock words = block(tick, draw);
    const double v = static_cast<double>(bits53(words[2], words[3])) * 0x1p-53;
    return std::sqrt(-2 * log(above_zero(words))) * cos(2 * std::numbers::pi * v);
  }

 private:
  static constexpr std::uint32_t low(std::uint64_t word) { return static_cast<std::uint32_t>(word); }
  static constexpr std::uint32_t high(std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32U); }
  static constexpr std::uint64_t bits53(std::uint32_t upper, std::uint32_t lower) {
    return (std::uint64_t{upper} << 21U) ^ (lower >> 11U);
  }
  static double above_zero(const PhiloxBlock& words) {
    return (static_cast<double>(bits53(words[0], words[1])) + 0.5) * 0x1p-53;
  }
  [[nodiscard]] PhiloxBlock block(std::uint64_t tick, std::uint32_t draw) const {
    return philox({low(tick), high(tick), name_, draw}, key_);
  }

  PhiloxKey key_;
  std::uint32_t name_;
};

}  // namespace gaitlab::math
