// Tests of the packed trace: a trace that is written and read is equal within its precision, and every damage has a message.
#include "golden/file.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/golden/golden_sample.h"
#include "tests/messages.h"

namespace gaitlab::test {
namespace {

std::string refused(const std::string& bytes) {
  return message_of([&] { (void)unpack(bytes, "x.golden"); });
}

TEST(GoldenFile, KeepsEveryValueWithinTheDeclaredPrecision) {
  const Trace trace = walk();
  const RoundedTrace read = unpack(pack(trace), "x");
  ASSERT_EQ(read.trace.columns.size(), trace.columns.size());
  ASSERT_EQ(read.trace.values.size(), trace.values.size());
  for (std::size_t i = 0; i < trace.columns.size(); ++i) {
    EXPECT_EQ(read.trace.columns[i].name, trace.columns[i].name);
    EXPECT_EQ(read.trace.columns[i].unit, trace.columns[i].unit);
    double low = INFINITY;
    double high = -INFINITY;
    for (std::size_t k = 0; k < trace.rows(); ++k) {
      low = std::min(low, trace.at(k, i));
      high = std::max(high, trace.at(k, i));
      // The tolerance is half of the quantisation step, and 1e-15 for the rounding error of low + n * precision, at most 2.6.
      EXPECT_NEAR(read.trace.at(k, i), trace.at(k, i), 0.5 * read.precision[i] + 1e-15) << trace.columns[i].name;
    }
    EXPECT_EQ(read.precision[i], i == 0 ? 0 : (high - low) / 65534) << trace.columns[i].name;
  }
  EXPECT_EQ(read.trace.at(7, 4), -0.0325);  // constant columns are exact
  EXPECT_EQ(read.precision[0], 0);
  EXPECT_EQ(pack(trace), pack(trace));
}

TEST(GoldenFile, IsSmall) {
  // The trace has 73 columns for 20 s, like a trace of the hexapod. Noise, which compresses worst, takes less than 2 bytes per
  // value and 1 % of overhead.
  std::mt19937_64 random(1);
  Trace trace;
  trace.columns = {{"t", "s", {}}};
  for (int i = 0; i < 73; ++i) trace.columns.push_back({"c" + std::to_string(i), "", {}});
  for (int k = 0; k <= 1000; ++k) {
    trace.values.push_back(k * kSpacing);
    for (int i = 0; i < 73; ++i) trace.values.push_back(static_cast<double>(random() >> 11U));
  }
  EXPECT_LT(pack(trace).size(), 2 * 1001 * 73 * 1.01 + 73 * 30);
}

TEST(GoldenFile, FewRowsAndColumns) {
  for (const std::size_t rows : {0U, 1U, 2U}) {
    const Trace trace = walk(rows);
    EXPECT_EQ(unpack(pack(trace), "x").trace.rows(), rows);
  }
  Trace alone;
  alone.columns = {{"t", "s", {}}};
  alone.values = {0, 0.5, 1};
  EXPECT_EQ(unpack(pack(alone), "x").trace.values, alone.values);
}

TEST(GoldenFile, RefusesWhatItCannotHold) {
  Trace trace = walk();
  trace.values[1] = kNan;
  EXPECT_THROW(pack(trace), std::invalid_argument);
  trace.values[1] = std::numeric_limits<double>::max();
  trace.values[6] = std::numeric_limits<double>::lowest();
  EXPECT_THROW(pack(trace), std::invalid_argument);
  trace = walk();
  trace.values[5] += 0.001;  // time of the second row
  EXPECT_THROW(pack(trace), std::invalid_argument);
  trace.columns.change([](auto& columns) { columns[0].name = "x"; });
  EXPECT_THROW(pack(trace), std::invalid_argument);
  EXPECT_THROW(pack({}), std::invalid_argument);
}

TEST(GoldenFile, EveryDamageHasItsMessage) {
  const std::string bytes = pack(walk());
  const std::string size = std::to_string(bytes.size());
  EXPECT_EQ(refused(""), "x.golden: error: is truncated: 0 bytes");
  EXPECT_EQ(refused(bytes.substr(0, 30)), "x.golden: error: is truncated: 30 bytes");
  EXPECT_EQ(refused(bytes.substr(0, 200)), "x.golden: error: is truncated: 200 of " + size + " bytes");
  EXPECT_EQ(refused("t,joint.0.torque\n0,1\n"), "x.golden: error: is not a golden trace of gaitlab");
  std::string other = bytes;
  other[15] = '7';
  EXPECT_EQ(refused(other),
            "x.golden: error: has format gaitlab-golden-7; this gaitlab reads gaitlab-golden-1: make it anew with gaitlab "
            "approve");
  other[15] = '?';
  EXPECT_EQ(refused(other), "x.golden: error: is corrupt: its first line is damaged");
  other = bytes;
  other[40] = 'x';
  EXPECT_EQ(refused(other), "x.golden: error: is corrupt: its second line is damaged");
  other = bytes;
  other[bytes.size() - 9] ^= 1;
  EXPECT_EQ(refused(other), "x.golden: error: is corrupt: its bytes are not those that were written");
  EXPECT_EQ(refused(bytes + "\n"), "x.golden: error: is corrupt: its bytes are not those that were written");
}

TEST(GoldenFile, NoTruncationAndNoFlippedByteIsTaken) {
  const std::string bytes = pack(walk(21));
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_NE(refused(bytes.substr(0, size)), kNoError) << size;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int flip : {1, 0x80, 0xFF}) {
      std::string flipped = bytes;
      flipped[at] = static_cast<char>(flipped[at] ^ flip);
      EXPECT_NE(refused(flipped), kNoError) << at;
    }
  }
}

// A damaged file with a correct checksum does not crash the reader. The sanitizers detect invalid memory accesses.
TEST(GoldenFile, DamageBehindARightChecksumIsNoCrash) {
  const std::string bytes = pack(walk(21));
  const std::size_t start = bytes.find('\n', bytes.find('\n') + 1) + 1;
  const auto sealed = [&](const std::string& body) {
    std::string head = bytes.substr(0, start);
    const std::string size = std::to_string(start + body.size());
    head.replace(31, 20, std::string(20 - size.size(), ' ') + size);
    head.replace(start - 17, 16, hash(body));
    return head + body;
  };
  const std::string body = bytes.substr(start);
  EXPECT_EQ(refused(sealed(body)), kNoError);
  for (std::size_t size = 0; size < body.size(); ++size) EXPECT_NE(refused(sealed(body.substr(0, size))), kNoError) << size;
  std::mt19937_64 random(2);
  int refusals = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string damaged = body;
    for (std::uint64_t n = 1 + random() % 4; n > 0; --n) damaged[random() % 120] = static_cast<char>(random());
    refusals += refused(sealed(damaged)) == kNoError ? 0 : 1;
  }
  EXPECT_GT(refusals, 1000);  // other bit flips only change a name or a value
  std::string many = body;
  many.replace(4, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_EQ(refused(sealed(many)), "x.golden: error: is corrupt: more rows than it can hold");
}

}  // namespace
}  // namespace gaitlab::test
