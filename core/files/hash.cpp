#include "core/files/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace gaitlab {

namespace {

constexpr std::uint64_t kPrime = 1099511628211ULL;

}  // namespace

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t state) {
  for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * kPrime;
  return state;
}

std::string hash_words(std::string_view bytes) {
  std::uint64_t state = kFnvOffset;
  const auto absorb_word = [&](std::uint64_t word) {
    state = (state ^ word) * kPrime;
    state ^= state >> 32U;  // else a flip of the highest bit stays there, and two of them cancel
  };
  absorb_word(bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
    absorb_word(word);
  }
  return fmt::format("{:016x}", state);
}

std::string hash(std::string_view bytes) { return fmt::format("{:016x}", fnv1a(bytes)); }

}  // namespace gaitlab
