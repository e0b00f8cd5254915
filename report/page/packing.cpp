#include "report/page/packing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "report/plot/deflate.h"

namespace gaitlab::report {

namespace {

constexpr double kMostQuanta = 0x1p50;
constexpr int kLevel = 6;  // compression level; 9 takes three times as long for 1 % less (hexapod, 20 s)

void append_varint(std::string& bytes, std::uint64_t value) {
  for (; value > 127; value >>= 7) bytes.push_back(static_cast<char>(static_cast<unsigned char>((value & 127) | 128)));
  bytes.push_back(static_cast<char>(value));
}

std::uint64_t zigzag(std::int64_t value) {
  const auto twice = static_cast<std::uint64_t>(value) << 1;
  return value < 0 ? ~twice : twice;
}

}  // namespace

void Packing::add(std::string name, std::string unit, double quantum, const std::vector<double>& values) {
  channels_.push_back({std::move(name), std::move(unit), quantum, values.size()});
  std::int64_t before = 0;
  for (const double value : values) {
    std::int64_t now = before;
    if (std::isfinite(value)) now = std::llround(std::clamp(value / quantum, -kMostQuanta, kMostQuanta));
    append_varint(bytes_, zigzag(now - before));
    before = now;
  }
}

std::string Packing::text() const { return base64(deflated(bytes_, kLevel)); }

double quantum_of(double magnitude, double largest_quantum) {
  const double wanted = magnitude / 1000;
  if (!std::isfinite(wanted) || !(wanted > 1e-12) || wanted >= largest_quantum) return largest_quantum;
  // The result is 5, 2 or 1 divided by a power of ten (10, 100, ...), and thus the double nearest to the decimal number.
  double below = 1;
  while (wanted * below < 1) below *= 10;
  const double digit = wanted * below;
  return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) / below;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t three = 0;
    for (std::size_t i = 0; i < 3; ++i) three = three << 8 | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i) text.push_back(i <= count ? kDigits[three >> (18 - 6 * i) & 63] : '=');
  }
  return text;
}

}  // namespace gaitlab::report
