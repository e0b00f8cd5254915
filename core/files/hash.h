// Hashes of bytes, against accidental changes, not against attacks.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace gaitlab {

inline constexpr std::uint64_t kFnvOffset = 14695981039346656037ULL;
/// FNV-1a, 64 bit (Fowler, Noll, Vo), continued from `state`.
std::uint64_t fnv1a(std::string_view bytes, std::uint64_t state = kFnvOffset);

/// FNV-1a (64 bit) of the bytes. 16 hex digits.
std::string hash(std::string_view bytes);

/// FNV-1a, 128 bit. 32 hex digits: names of contents that must not meet by chance.
std::string hash128(std::string_view bytes);

/// Eight bytes at a time and so several times as fast: h = (h ^ word) * prime, h ^= h >> 32, words little-endian; prime and
/// start are those of FNV-1a (64 bit).
class WordHash {
 public:
  /// Adds the length of `bytes`, then their words, the last one filled up with zeros.
  void add(std::string_view bytes);
  /// The same in parts: first the length of all, then each part, of which only the last may be other than a multiple of 8
  /// bytes.
  void add_length(std::size_t bytes);
  void add_words(std::string_view bytes);
  /// 16 hex digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t state_ = kFnvOffset;
};

/// WordHash of one text.
std::string hash_words(std::string_view bytes);

}  // namespace gaitlab
