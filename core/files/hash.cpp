#include "core/files/hash.h"

#include <fmt/format.h>

#include <cstring>

namespace gaitlab {

namespace {

constexpr std::uint64_t kPrime = 1099511628211ULL;

std::uint64_t absorbed(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * kPrime;
  // Without this shift, a change of the highest bit would not spread, and two such changes would cancel.
  return state ^ state >> 32U;
}

}  // namespace

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t state) {
  for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * kPrime;
  return state;
}

void WordHash::add(std::string_view bytes) {
  add_length(bytes.size());
  add_words(bytes);
}

void WordHash::add_length(std::size_t bytes) { state_ = absorbed(state_, bytes); }

void WordHash::add_words(std::string_view bytes) {
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  // The compiler can keep this copy in a register, but not state_, because `bytes` may alias any object.
  std::uint64_t state = state_;
  const auto absorb = [&](const char* from, std::size_t size) {
    std::uint64_t word = 0;
    std::memcpy(&word, from, size);
    state = absorbed(state, word);
  };
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

std::string hash128(std::string_view bytes) {
  __extension__ using Wide = unsigned __int128;
  constexpr Wide kWidePrime = (Wide{1} << 88U) + 0x13b;
  Wide state = (Wide{0x6c62272e07bb0142U} << 64U) + 0x62b821756295c58dU;
  for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * kWidePrime;
  return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(state >> 64U), static_cast<std::uint64_t>(state));
}

std::string hash(std::string_view bytes) { return fmt::format("{:016x}", fnv1a(bytes)); }

}  // namespace gaitlab
