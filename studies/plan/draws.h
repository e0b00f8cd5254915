// Random numbers by counter and names by content: what a run draws depends on its number alone, never on what ran before.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace gaitlab::studies {

/// SplitMix64 (Steele, Lea, Flood 2014) over the words, one after the other.
std::uint64_t hash64(std::initializer_list<std::uint64_t> words);

/// First word of what searches draw (1 to 3 are the points').
inline constexpr std::uint64_t kSearchDraw = 4;
/// First word of the draw of points whose torque error is estimated.
inline constexpr std::uint64_t kEstimateDraw = 5;

/// In [0, 1), of the hash of the words.
double uniform(std::initializer_list<std::uint64_t> words);

/// Of mean 0 and deviation 1, of the same (Box and Muller).
double normal(std::initializer_list<std::uint64_t> words);

/// FNV-1a of 128 bit, 32 hex digits.
std::string digest(std::string_view text);

}  // namespace gaitlab::studies
