// Tests of the heat image of a run, which zlib decompresses.
#include "report/page/heat_image.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <string_view>

namespace gaitlab::report {
namespace {

/// Bytes of a text in base64 (RFC 4648).
std::string decoded(std::string_view text) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = (bits << 6U) | static_cast<unsigned>(kLetters.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xffU);
  }
  return bytes;
}

std::size_t number(std::string_view bytes) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

TEST(HeatImage, HoldsTheLargestShares) {
  Recording run;
  run.simulated = 4;
  run.joints.resize(2);
  run.ticks.columns = tick_columns(2);
  for (int k = 0; k <= 400; ++k) {
    std::vector<double> row(run.ticks.columns.size(), 0.0);
    row[0] = 0.01 * k;
    row[1 + kEnvelopePeak] = k == 150 ? 1 : 0;                  // from 1.49 to 1.5 s of 4 s, column 2 of 0 to 7
    row[1 + kTickColumns + kEnvelopePeak] = k > 200 ? 0.5 : 0;  // in the second half of the run
    run.ticks.values.insert(run.ticks.values.end(), row.begin(), row.end());
  }
  const std::string url = heat_image(run, 8);
  constexpr std::string_view kHead = "data:image/png;base64,";
  ASSERT_EQ(url.substr(0, kHead.size()), kHead);
  const std::string png = decoded(std::string_view(url).substr(kHead.size()));
  ASSERT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::string pixels;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t size = number(std::string_view(png).substr(at));
    const std::string type = png.substr(at + 4, 4);
    const std::string whole = png.substr(at + 4, size + 4);
    EXPECT_EQ(number(std::string_view(png).substr(at + 8 + size)),
              crc32(0, reinterpret_cast<const Bytef*>(whole.data()), static_cast<uInt>(whole.size())));
    if (type == "IHDR") {
      EXPECT_EQ(number(std::string_view(whole).substr(4)), 8U);
      EXPECT_EQ(number(std::string_view(whole).substr(8)), 2U);
    }
    if (type == "IDAT") {
      pixels.resize(18);
      uLongf length = pixels.size();
      EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(pixels.data()), &length, reinterpret_cast<const Bytef*>(whole.data() + 4),
                           static_cast<uLong>(size)),
                Z_OK);
      EXPECT_EQ(length, 18U);
    }
    at += size + 12;
  }
  EXPECT_EQ(pixels.substr(0, 9), std::string("\0\0\0\x1f\0\0\0\0\0", 9)) << "a filter, then a px for each part";
  EXPECT_EQ(pixels.substr(9 + 1, 4), std::string(4, '\0'));
  EXPECT_EQ(pixels.substr(9 + 5, 4), std::string(4, '\x10')) << "half of 31, rounded";
  EXPECT_EQ(url, heat_image(run, 8));
}

TEST(HeatImage, OfNothingIsEmpty) {
  EXPECT_EQ(heat_image({}, 8), "");
  Recording no_joints;
  no_joints.simulated = 1;
  EXPECT_EQ(heat_image(no_joints, 8), "");
}

}  // namespace
}  // namespace gaitlab::report
