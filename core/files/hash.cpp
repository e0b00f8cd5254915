#include "core/files/hash.h"

#include <fmt/format.h>

#include <cstring>

namespace gaitlab {

namespace {

constexpr std::uint64_t kPrime = 1099511628211ULL;

std::uint64_t absorbed(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * kPrime;
  return state ^ state >> 32U;  // else a flip of the highest bit stays there, and two of them cancel
}

}  // namespace

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t state) {
  for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * kPrime;
  return state;
}

void WordHash::add(std::string_view bytes) {
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  std::uint64_t state = state_;  // in a register: a byte may be any object's, this one's too
  const auto absorb = [&](const char* from, std::size_t size) {
    std::uint64_t word = 0;
    std::memcpy(&word, from, size);
    state = absorbed(state, word);
  };
  state = absorbed(state, bytes.size());
  const std::size_t whole = bytes.size() / kWord * kWord;
  for (std::size_t at = 0; at < whole; at += kWord) absorb(bytes.data() + at, kWord);
  if (whole < bytes.size()) absorb(bytes.data() + whole, bytes.size() - whole);
  state_ = state;
}

std::string WordHash::text() const { return fmt::format("{:016x}", state_); }

std::string hash_words(std::string_view bytes) {
  WordHash words;
  words.add(bytes);
  return words.text();
}

std::string hash(std::string_view bytes) { return fmt::format("{:016x}", fnv1a(bytes)); }

}  // namespace gaitlab
