#include "studies/plan/draws.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/math/functions.h"

namespace gaitlab::studies {

namespace {

double share(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

}  // namespace

std::uint64_t hash64(std::initializer_list<std::uint64_t> words) {
  std::uint64_t hash = 0;
  for (const std::uint64_t word : words) {
    hash = (hash ^ word) + 0x9e3779b97f4a7c15U;
    hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9U;
    hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111ebU;
    hash ^= hash >> 31U;
  }
  return hash;
}

double uniform(std::initializer_list<std::uint64_t> words) { return share(hash64(words)); }

double normal(std::initializer_list<std::uint64_t> words) {
  const std::uint64_t first = hash64(words);
  const double radius = std::sqrt(-2 * math::log(1 - share(first)));
  return radius * math::cos(2 * std::numbers::pi * share(hash64({first, 1})));
}

std::string digest(std::string_view text) {
  __extension__ using Wide = unsigned __int128;
  constexpr Wide kPrime = (Wide{1} << 88U) + 0x13b;
  Wide hash = (Wide{0x6c62272e07bb0142U} << 64U) + 0x62b821756295c58dU;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(hash >> 64U), static_cast<std::uint64_t>(hash));
}

}  // namespace gaitlab::studies
