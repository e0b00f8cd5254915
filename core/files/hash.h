// Hashes of bytes, for protection against accidental changes, not against attacks.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace gaitlab {

inline constexpr std::uint64_t kFnvOffset = 14695981039346656037ULL;
/// FNV-1a hash with 64 bits (Fowler, Noll, Vo), continued from `state`.
std::uint64_t fnv1a(std::string_view bytes, std::uint64_t state = kFnvOffset);

/// FNV-1a hash of the bytes with 64 bits, as 16 hex digits.
std::string hash(std::string_view bytes);

/// FNV-1a hash with 128 bits, as 32 hex digits. It serves as a name of the content, because equal hashes of different contents
/// are improbable.
std::string hash128(std::string_view bytes);

/// Hash of eight bytes at a time, several times as fast as FNV-1a: h = (h ^ word) * prime, h ^= h >> 32, with little-endian
/// words. Prime and start value are those of FNV-1a (64 bit).
class WordHash {
 public:
  /// Adds the length of `bytes`, then their words. The last word is padded with zeros.
  void add(std::string_view bytes);
  /// add() in parts: first the total length, then each part. Only the last part may have a length that is not a multiple of 8
  /// bytes.
  void add_length(std::size_t bytes);
  void add_words(std::string_view bytes);
  /// The hash as 16 hex digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t state_ = kFnvOffset;
};

/// WordHash of one text.
std::string hash_words(std::string_view bytes);

}  // namespace gaitlab
