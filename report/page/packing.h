// Compact encoding of number series in the data of a page.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab::report {

/// A series of numbers in a Packing. Each value is an integer times the quantum.
struct PageChannel {
  std::string name, unit;
  double quantum = 1;
  std::size_t count = 0;
};

/// Encoder of channels one after another. A value is encoded in these steps:
/// - x / quantum, rounded to the nearest integer (half away from zero).
/// - Difference from the previous integer; the first one is preceded by 0.
/// - Zigzag code: 0, -1, 1, -2, ... become 0, 1, 2, 3, ....
/// - Seven bits per byte, the lowest first; the eighth bit is set except in the last byte (LEB128).
/// A value that is not finite repeats the previous integer, or is 0 at the start. Values beyond 2^50 quanta are clamped,
/// because a page computes with doubles.
class Packing {
 public:
  void add(std::string name, std::string unit, double quantum, const std::vector<double>& values);
  [[nodiscard]] const std::vector<PageChannel>& channels() const { return channels_; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  /// Bytes of all channels, compressed by zlib, in Base64. Throws std::bad_alloc.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<PageChannel> channels_;
  std::string bytes_;
};

/// Quantum for numbers of at most this magnitude. It is a thousandth of the magnitude, rounded down to 1, 2 or 5 times a power
/// of ten, but at most `largest_quantum`.
double quantum_of(double magnitude, double largest_quantum);

/// Base64 text (RFC 4648) with padding, on one line.
std::string base64(std::string_view bytes);

}  // namespace gaitlab::report
