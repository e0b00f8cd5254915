// Tests of the encoding of numbers in a page, byte by byte.
#include "report/page/packing.h"

#include <limits>

#include "tests/report/page/opened_page.h"

namespace gaitlab::test {
namespace {

using nlohmann::json;

std::vector<unsigned> bytes_of(const report::Packing& packing) {
  std::vector<unsigned> all;
  for (const char c : packing.bytes()) all.push_back(static_cast<unsigned char>(c));
  return all;
}

/// Bytes of a channel, computed by hand from the differences 0, 1, -2, 65, -128, 8255, -16383, 1008192. The test of the page's
/// decoder uses the same numbers.
TEST(Packing, BytesAreThese) {
  report::Packing packing;
  packing.add("x", "", 1, {0, 1, -1, 64, -64, 8191, -8192, 1000000});
  EXPECT_EQ(bytes_of(packing), (std::vector<unsigned>{0x00, 0x02, 0x03, 0x82, 0x01, 0xff, 0x01, 0xfe, 0x80, 0x01, 0xfd, 0xff,
                                                      0x01, 0x80, 0x89, 0x7b}));
}

TEST(Packing, WhatIsNoNumberRepeatsTheOneBefore) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double most = std::numeric_limits<double>::infinity();
  report::Packing packing;
  packing.add("x", "", 0.5, {nan, 2, nan, most, 2.5});
  EXPECT_EQ(bytes_of(packing), (std::vector<unsigned>{0, 8, 0, 0, 2}));
  report::Packing huge;
  huge.add("x", "", 1, {1e300, -1e300});
  const json channels = json::array({json::array({"x", "", 1, 2})});
  EXPECT_EQ(unpacked(channels, huge.bytes()).at("x"), (std::vector<double>{0x1p50, -0x1p50}));
}

TEST(Packing, Base64IsThatOfTheRfc) {  // examples of RFC 4648, section 10
  for (const auto& [bytes, text] : {std::pair("", ""),
                                    {"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"fooba", "Zm9vYmE="},
                                    {"foobar", "Zm9vYmFy"}}) {
    EXPECT_EQ(report::base64(bytes), text);
  }
  EXPECT_EQ(report::base64("\xff\xfe\xfb"), "//77");
}

TEST(Packing, SmallNumbersHaveFinerQuanta) {
  EXPECT_EQ(report::quantum_of(5, 1e-3), 1e-3);
  EXPECT_EQ(report::quantum_of(0, 1e-3), 1e-3) << "nothing ever moved";
  EXPECT_EQ(report::quantum_of(0.9, 1e-3), 5e-4);
  EXPECT_EQ(report::quantum_of(0.012, 1e-3), 1e-5);
  EXPECT_EQ(report::quantum_of(0.4, 1e-3), 2e-4);
  EXPECT_EQ(report::quantum_of(std::numeric_limits<double>::infinity(), 1e-3), 1e-3);
}

}  // namespace
}  // namespace gaitlab::test
