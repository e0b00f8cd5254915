#include "report/page/heat_image.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "report/page/packing.h"
#include "report/plot/deflate.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kColours = 32;

struct Stop {
  double share;
  std::array<double, 3> colour;
};
/// Colour ramp that is equal to that of the page's heat map (report/page/src/colour.ts). Its lightness is monotonic, so that it
/// is readable in grey.
constexpr Stop kRamp[] = {
    {0, {236, 239, 242}}, {0.25, {254, 226, 178}}, {0.5, {252, 178, 92}}, {0.8, {222, 84, 28}}, {1, {140, 0, 34}}};

std::string palette() {
  std::string bytes;
  for (std::size_t i = 0; i < kColours; ++i) {
    const double share = static_cast<double>(i) / (kColours - 1);
    std::size_t k = 1;
    while (kRamp[k].share < share) ++k;
    const Stop& a = kRamp[k - 1];
    const Stop& b = kRamp[k];
    const double part = (share - a.share) / (b.share - a.share);
    for (std::size_t c = 0; c < 3; ++c)
      bytes += static_cast<char>(static_cast<unsigned char>(std::lround(a.colour[c] + part * (b.colour[c] - a.colour[c]))));
  }
  return bytes;
}

std::string big_endian(std::size_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((value >> static_cast<unsigned>(shift)) & 0xffU);
  return bytes;
}

std::string chunk(std::string_view type, const std::string& data) {
  const std::string all = std::string(type) + data;
  const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(all.data()), static_cast<uInt>(all.size()));
  return big_endian(data.size()) + all + big_endian(crc);
}

/// Pixels of the image: the largest share in each of `columns` equal parts of the run, one row per joint. Each row begins with
/// the PNG filter type 0.
std::string pixels(const Recording& record, std::size_t columns) {
  const Series t(record.ticks, 0);
  std::string all;
  for (std::size_t j = 0; j < record.joints.size(); ++j) {
    const Series share = record.tick(j, kEnvelopePeak);
    std::vector<double> largest(columns, 0.0);
    for (std::size_t k = 1; k < t.size(); ++k) {
      const auto column = static_cast<std::size_t>(static_cast<double>(columns) * t[k - 1] / t.back());
      double& cell = largest[std::min(column, columns - 1)];
      cell = std::max(cell, share[k]);
    }
    all += '\0';
    for (const double value : largest)
      all += static_cast<char>(std::lround(std::clamp(value, 0.0, 1.0) * static_cast<double>(kColours - 1)));
  }
  return all;
}

}  // namespace

std::string heat_image(const Recording& record, std::size_t columns) {
  if (record.joints.empty() || record.tick(0, kEnvelopePeak).empty() || !(record.simulated > 0)) return "";
  constexpr std::string_view kEightBitsOfAPalette("\x08\x03\0\0\0", 5);
  const std::string size = big_endian(columns) + big_endian(record.joints.size());
  return "data:image/png;base64," +
         base64("\x89PNG\r\n\x1a\n" + chunk("IHDR", size + std::string(kEightBitsOfAPalette)) + chunk("PLTE", palette()) +
                chunk("IDAT", deflated(pixels(record, columns), kMostDeflated)) + chunk("IEND", ""));
}

}  // namespace gaitlab::report
