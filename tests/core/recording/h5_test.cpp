#include "core/recording/h5.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/errors.h"
#include "tests/core/recording/damaged_trace.h"
#include "tests/folder.h"
#include "tests/folders.h"
#include "tests/messages.h"

// HDF5 leaves objects of a damaged file open at the end of the program, which LeakSanitizer must ignore.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier): LeakSanitizer's name
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }  // NOLINT(bugprone-reserved-identifier)

// A function of HDF5, whose header is private to core.
extern "C" int H5PLget_loading_state(unsigned* state);
extern "C" int H5PLset_loading_state(unsigned state);

namespace gaitlab {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeader = 512;

class H5 : public testing::Test {
 protected:
  void put(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  [[nodiscard]] std::string bytes() const { return test::read(file_); }
  [[nodiscard]] std::string written(const Trace& trace) const {
    write_h5(trace, kOrigin, file_);
    return bytes();
  }
  // Message of the error on reading these bytes, without the name of the file; "" if there is no error.
  [[nodiscard]] std::string complaint(const std::string& bytes) const {
    put(bytes);
    const std::string text = test::message_of([&] { read_h5(file_); });
    if (text == test::kNoError) return "";
    const std::string prefix = file_.string() + ": error: ";
    EXPECT_EQ(text.substr(0, prefix.size()), prefix);
    return text.substr(prefix.size());
  }

  const Provenance kOrigin{"gaitlab: 1\nname: \"é\"\n", -5, "0.1.0+abc (g++)", "done"};
  const test::Folder own_;
  const fs::path folder_ = own_.path(), file_ = folder_ / "trace.h5";
};

Trace sample(std::size_t rows) {
  Trace trace;
  trace.columns = {{"t", "s", "time"}, {"joint.0.angle", "rad", "Winkel, größer null"}, {"joint.0.saturation", "", ""}};
  for (std::size_t k = 0; k < rows; ++k) {
    const auto t = 0.005 * static_cast<double>(k);
    trace.values.insert(trace.values.end(), {t, std::sin(t), k % 7 == 0 ? 1.0 : 0.0});
  }
  return trace;
}

void expect_same(const Trace& a, const Trace& b) {
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    EXPECT_EQ(a.columns[i].name, b.columns[i].name);
    EXPECT_EQ(a.columns[i].unit, b.columns[i].unit);
    EXPECT_EQ(a.columns[i].definition, b.columns[i].definition);
  }
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a.values[i]), std::bit_cast<std::uint64_t>(b.values[i])) << i;
}

TEST_F(H5, KeepsEveryBit) {
  using Limits = std::numeric_limits<double>;
  Trace trace = sample(5000);  // more than one chunk per column
  const std::vector<double> special{0.0,
                                    -0.0,
                                    Limits::infinity(),
                                    -Limits::infinity(),
                                    Limits::quiet_NaN(),
                                    Limits::max(),
                                    Limits::min(),
                                    Limits::denorm_min(),
                                    -Limits::denorm_min(),
                                    std::bit_cast<double>(std::uint64_t{0xfff8000000001234})};
  for (std::size_t i = 0; i < special.size(); ++i) trace.values[3 * i + 1] = special[i];
  write_h5(trace, kOrigin, file_);
  const StoredTrace stored = read_h5(file_);
  expect_same(stored.trace, trace);
  EXPECT_EQ(stored.origin.scenario, kOrigin.scenario);
  EXPECT_EQ(stored.origin.seed, kOrigin.seed);
  EXPECT_EQ(stored.origin.build, kOrigin.build);
}

TEST_F(H5, SmallAndLargeShapes) {
  Trace wide;  // more names than fit into an attribute of the older format, 64 kB
  for (int i = 0; i < 6000; ++i) wide.columns.push_back({"body.m" + std::to_string(i), "m", "a long enough definition of it"});
  wide.values.assign(2 * wide.columns.size(), 1.5);
  for (const Trace& trace : {sample(1), sample(0), Trace{}, wide}) {
    write_h5(trace, kOrigin, file_);
    expect_same(read_h5(file_).trace, trace);
  }
}

TEST_F(H5, SameTraceSameBytes) {
  const std::string first = written(sample(300));
  usleep(1100000);  // times in HDF5 files have a resolution of a second
  EXPECT_EQ(written(sample(300)), first);
}

TEST_F(H5, FirstLinesSayWhatItIs) {
  const std::string bytes = written(sample(3));
  EXPECT_EQ(bytes.substr(0, bytes.find('\0')),
            "gaitlab-trace-1\nHDF5 follows at byte 512. Bytes in all: " + std::to_string(bytes.size()) +
                "; hash from byte 512 on: " + hash_words(std::string_view(bytes).substr(kHeader)) + "\n");
  EXPECT_EQ(bytes.substr(kHeader, 4), "\x89HDF");
}

TEST_F(H5, UnwritableIsAFailedRun) {
  EXPECT_EQ(test::message_of<RunError>([&] { write_h5(sample(3), kOrigin, folder_ / "no" / "trace.h5"); }),
            (folder_ / "no" / "trace.h5").string() + ": cannot be written: No such file or directory");
  Trace trace = sample(3);
  trace.columns.change([](auto& columns) { columns[1].name = std::string("a\0b", 3); });
  EXPECT_EQ(test::message_of<RunError>([&] { write_h5(trace, kOrigin, file_); }),
            file_.string() + ": cannot be written: a text with a NUL cannot be stored");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(H5, TruncatedAnywhere) {
  const std::string whole = written(sample(400));
  for (std::size_t i = 1; i < 50; ++i) {
    const std::size_t size = kHeader + (whole.size() - kHeader) * i / 50;
    EXPECT_EQ(complaint(whole.substr(0, size)),
              "is truncated: " + std::to_string(size) + " of " + std::to_string(whole.size()) + " bytes");
  }
  for (const std::size_t size : {1U, 13U, 14U, 15U, 16U, 40U, 511U})
    EXPECT_EQ(complaint(whole.substr(0, size)), "is truncated: " + std::to_string(size) + " bytes");
  EXPECT_EQ(complaint(""), "is empty");
  EXPECT_EQ(complaint(whole + "x"), "is corrupt: " + std::to_string(whole.size() + 1) + " bytes, but " +
                                        std::to_string(whole.size()) + " were written");
}

TEST_F(H5, EveryFlippedByteIsSeen) {
  const std::string whole = written(sample(60));
  const std::size_t stride = whole.size() / 300 + 1;
  // The test writes in place, because truncating and rewriting a file waits for the disk.
  std::fstream file(file_, std::ios::binary | std::ios::in | std::ios::out);
  const auto put_byte = [&](std::size_t at, int byte) {
    file.seekp(static_cast<std::streamoff>(at)).put(static_cast<char>(byte)).flush();
  };
  for (std::size_t at = 0; at < whole.size(); at += at < kHeader ? 1 : stride) {
    for (const int mask : {0x01, 0x80}) {
      put_byte(at, whole[at] ^ mask);
      EXPECT_THROW(read_h5(file_), InputError) << "byte " << at;
    }
    put_byte(at, whole[at]);
  }
  EXPECT_NO_THROW(read_h5(file_));
  std::string damaged = whole;
  damaged[whole.size() / 2] ^= 1;
  EXPECT_EQ(complaint(damaged), "is corrupt or was changed by another program: its bytes are not those that were written");
  damaged = whole;
  damaged[20] ^= 1;
  EXPECT_EQ(complaint(damaged), "is corrupt: its second line is damaged");
  damaged = whole;
  damaged[15] ^= 1;
  EXPECT_EQ(complaint(damaged), "is corrupt: its first line is damaged");
}

TEST_F(H5, OtherVersion) {
  std::string other = written(sample(3));
  other.replace(other.find('1'), 1, "3");
  EXPECT_EQ(complaint(other), "has format gaitlab-trace-3; this gaitlab reads gaitlab-trace-1");
  other = written(sample(3));
  other.replace(other.find("1\n"), 2, "12\n");
  EXPECT_EQ(complaint(other), "has format gaitlab-trace-12; this gaitlab reads gaitlab-trace-1");
}

TEST_F(H5, KeepsTablesBesideTheTrace) {
  const Trace table{{{"x", "m", ""}}, {1, 2, 3, 4, 5}};
  const Trace none;
  write_h5(sample(3), kOrigin, file_, std::vector<BesideOf>{{"ticks", &table}, {"run", &none}});
  const StoredTrace stored = read_h5(file_);
  expect_same(stored.trace, sample(3));
  EXPECT_EQ(stored.origin.outcome, "done");
  ASSERT_EQ(stored.beside.size(), 2U);
  EXPECT_EQ(stored.beside[0].name, "ticks");
  expect_same(stored.beside[0].table, table);
  EXPECT_TRUE(stored.beside[1].table.columns.empty());
}

TEST_F(H5, ScenariosOfAnySize) {
  const std::string long_text(300000, 'x');  // longer than 64 kB, the limit of an attribute of the older format
  write_h5(sample(1), {long_text, 1, "build", "done"}, file_);
  EXPECT_EQ(read_h5(file_).origin.scenario, long_text);
}

/// Another user of HDF5 in the process, such as h5py, still loads its filters.
TEST_F(H5, LeavesTheLoadingOfFiltersAsItWas) {
  unsigned before = 0;
  for (const unsigned state : {0xffffU, 0x1U}) {
    H5PLset_loading_state(state);
    H5PLget_loading_state(&before);
    write_h5(sample(1), kOrigin, file_);
    static_cast<void>(read_h5(file_));
    put("not HDF5");
    EXPECT_ANY_THROW(static_cast<void>(read_h5(file_)));
    unsigned after = 0;
    H5PLget_loading_state(&after);
    EXPECT_EQ(after, before);
  }
}

TEST_F(H5, Foreign) {
  const std::string whole = written(sample(3));
  EXPECT_EQ(complaint(whole.substr(kHeader)), "is an HDF5 file, but not a gaitlab trace");
  EXPECT_EQ(complaint(std::string(kHeader, ' ') + whole.substr(kHeader)), "is an HDF5 file, but not a gaitlab trace");
  EXPECT_EQ(complaint("t,joint.0.angle\n0,0\n"), "is not a gaitlab trace (nor another HDF5 file)");
  EXPECT_EQ(complaint(std::string(5000, '\0')), "is not a gaitlab trace (nor another HDF5 file)");
  fs::remove(file_);
  EXPECT_EQ(test::message_of([&] { read_h5(file_); }), file_.string() + ": error: cannot be read: No such file or directory");
}

TEST_F(H5, ContentThatDoesNotFitTogether) {
  const std::string whole = written(sample(3));
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string bytes = whole;
    const std::size_t at = bytes.find(from, kHeader);
    EXPECT_NE(at, std::string::npos);
    return test::sealed(bytes.replace(at, to.size(), to));
  };
  ASSERT_EQ(complaint(test::sealed(whole)), "");
  // HDF5 detects changes of names and attributes of format 2 by a separate checksum.
  for (const auto& [from, to, where] : {std::array{hash(sample(3)), std::string("0123456789abcdef"), std::string()},
                                        {"joint.0.angle", "joint.1.angle", "dataset /trace: "},
                                        {"gaitlab-trace-1", "gaitlab-trace-3", ""},
                                        {"checksum", "checksun", ""}}) {
    EXPECT_TRUE(complaint(changed(from, to)).starts_with("is corrupt: " + where + "HDF5: ")) << from;
  }
}

}  // namespace
}  // namespace gaitlab
