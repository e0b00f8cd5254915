// Counter-based random numbers. A draw depends only on the words given to it, never on earlier draws.
#pragma once
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>

#include "core/math/functions.h"

namespace gaitlab::math {

/// Increment and output function of SplitMix64 (Steele, Lea, Flood 2014).
inline constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;
constexpr std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

/// Number `counter` in the stream of seed 0.
constexpr std::uint64_t splitmix64(std::uint64_t counter) { return mixed(counter * kGolden); }

/// Hash of the words: SplitMix64 over one word after the other.
constexpr std::uint64_t hash64(std::initializer_list<std::uint64_t> words) {
  std::uint64_t hash = 0;
  for (const std::uint64_t word : words) hash = mixed((hash ^ word) + kGolden);
  return hash;
}

/// Number in [0, 1) from the upper 53 bits.
constexpr double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }
/// Number in [-1, 1) from the upper 53 bits.
constexpr double symmetric(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-52 - 1; }

/// Number in [0, 1) from the hash of the words.
constexpr double uniform(std::initializer_list<std::uint64_t> words) { return unit(hash64(words)); }

/// Normally distributed number with mean 0 and deviation 1, from the hash of the words (Box and Muller).
inline double normal(std::initializer_list<std::uint64_t> words) {
  const std::uint64_t first = hash64(words);
  const double radius = std::sqrt(-2 * log(1 - unit(first)));
  return radius * cos(2 * std::numbers::pi * unit(hash64({first, 1})));
}

}  // namespace gaitlab::math
