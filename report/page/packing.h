// Numbers in the data of a page: rounded to a quantum, differences, variable length, deflated, as text.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab::report {

/// A row of numbers in a Packing: a value is an integer times the quantum.
struct Channel {
  std::string name, unit;
  double quantum = 1;
  std::size_t count = 0;
};

/// Channels one after another. Encoding of each: x / quantum, rounded to the nearest integer (half away from zero); the
/// difference to the one before, of the first to 0; zigzag (0, -1, 1, -2 ... become 0, 1, 2, 3 ...); seven bits a byte, the
/// lowest first, the eighth set except in the last (LEB128). A value that is not finite repeats the previous number, at the
/// start 0; values beyond 2^50 quanta are clamped, because a page reads doubles.
class Packing {
 public:
  void add(std::string name, std::string unit, double quantum, const std::vector<double>& values);
  [[nodiscard]] const std::vector<Channel>& channels() const { return channels_; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  /// Base64 of the bytes, deflated by zlib. Throws std::bad_alloc.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<Channel> channels_;
  std::string bytes_;
};

/// The quantum for numbers of at most this magnitude: `largest_quantum`, or a thousandth of the magnitude if that is less,
/// rounded down to 1, 2 or 5 times a power of ten.
double quantum_of(double magnitude, double largest_quantum);

/// RFC 4648, with padding, on one line.
std::string base64(std::string_view bytes);

}  // namespace gaitlab::report
