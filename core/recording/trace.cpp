#include "core/recording/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace gaitlab {

namespace {

// FNV-1a, 64 bit (Fowler, Noll, Vo).
constexpr std::uint64_t kOffset = 14695981039346656037ULL;
constexpr std::uint64_t kPrime = 1099511628211ULL;

std::uint64_t absorb(std::uint64_t state, std::string_view bytes) {
  for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * kPrime;
  return state;
}

}  // namespace

std::size_t Trace::find(const std::string& name) const {
  std::size_t index = 0;
  while (index < columns.size() && columns[index].name != name) ++index;
  return index;
}

std::string hash(const Trace& trace) {
  std::uint64_t state = kOffset;
  for (const Column& column : trace.columns) {
    state = absorb(state, column.name);
    state = absorb(state, std::string_view("\0", 1));  // so that {"ab", "c"} and {"a", "bc"} differ
  }
  const char* bytes = reinterpret_cast<const char*>(trace.values.data());
  state = absorb(state, {bytes, trace.values.size() * sizeof(double)});
  return fmt::format("{:016x}", state);
}

std::string hash_words(std::string_view bytes) {
  std::uint64_t state = kOffset;
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

std::string hash(std::string_view bytes) { return fmt::format("{:016x}", absorb(kOffset, bytes)); }

}  // namespace gaitlab
