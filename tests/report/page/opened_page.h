// Reader of the data in a page that is independent of the program's writer.
#pragma once
#include <zlib.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "report/page/page.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {

inline std::string from_base64(const std::string& text) {
  std::string bytes;
  unsigned held = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const unsigned six = c >= 'A' && c <= 'Z'   ? static_cast<unsigned>(c - 'A')
                         : c >= 'a' && c <= 'z' ? static_cast<unsigned>(c - 'a') + 26
                         : c >= '0' && c <= '9' ? static_cast<unsigned>(c - '0') + 52
                         : c == '+'             ? 62U
                                                : 63U;
    held = held << 6 | six;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>(held >> bits & 255U));
  }
  return bytes;
}

inline std::string inflated(const std::string& bytes) {
  std::string all(std::size_t{64} << 20, '\0');
  uLongf size = all.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(all.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
            Z_OK);
  all.resize(size);
  return all;
}

/// Decodes the channels of a page. Returns them by name.
inline std::map<std::string, std::vector<double>> unpacked(const nlohmann::json& channels, const std::string& bytes) {
  std::map<std::string, std::vector<double>> all;
  std::size_t at = 0;
  for (const nlohmann::json& channel : channels) {
    std::vector<double>& values = all[channel[0].get<std::string>()];
    double sum = 0;
    for (std::size_t i = 0; i < channel[3].get<std::size_t>(); ++i) {
      double zigzag = 0;
      double weight = 1;
      unsigned byte = 128;
      for (; byte > 127; weight *= 128) {
        byte = static_cast<unsigned char>(bytes.at(at++));
        zigzag += (byte & 127U) * weight;
      }
      sum += std::fmod(zigzag, 2) == 0 ? zigzag / 2 : -(zigzag + 1) / 2;
      values.push_back(sum * channel[2].get<double>());
    }
  }
  EXPECT_EQ(at, bytes.size());
  return all;
}

/// Content of a page: the JSON object `meta`, and the decoded channels by name.
struct Opened {
  nlohmann::json meta;
  std::map<std::string, std::vector<double>> channels;
  explicit Opened(const report::PageData& data)
      : meta(nlohmann::json::parse(data.meta)), channels(unpacked(meta["channels"], inflated(from_base64(data.data)))) {}
};

inline report::PageData data_of(const Scenario& s, const Recording& r, std::size_t most = report::kMostData) {
  const report::Summary summary = report::summarise(s, r, 1.5);
  return report::page_data(s, r, summary, report::verdict(s, r, summary, report::overlaps(s, r)), {}, most);
}

}  // namespace gaitlab::test
