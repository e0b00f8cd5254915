// Tests of the readers of NumPy matrices and grey PNGs, with files of other programs and with invalid files.
#include "core/files/number_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/files/gzip.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

constexpr std::size_t kRoom = 1000;

/// Bytes of a NumPy file: a header as numpy.save writes it, followed by the bytes of the numbers.
std::string npy(const std::string& dict, const std::string& numbers, int version = 1) {
  std::string header = dict;
  const std::size_t before = version == 1 ? 10 : 12;
  while ((before + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes = std::string(kNpyMagic) + static_cast<char>(version) + '\0';
  for (std::size_t i = 0; i < before - 8; ++i) bytes += static_cast<char>(header.size() >> (8 * i));
  return bytes + header + numbers;
}

std::string dict(const std::string& type, const std::string& shape) {
  return "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
}

template <class Number>
std::string bytes_of(std::initializer_list<Number> numbers) {
  std::string bytes;
  for (const Number number : numbers) {
    std::string one(sizeof number, '\0');
    std::memcpy(one.data(), &number, sizeof number);
    bytes += one;
  }
  return bytes;
}

template <class Number>
void expect_numbers(const std::string& type, std::initializer_list<Number> numbers, const std::vector<double>& read) {
  std::string bytes = bytes_of(numbers);
  EXPECT_EQ(read_npy(npy(dict("<" + type, "(1, 3)"), bytes), kRoom).values, read) << type;
  std::string swapped;
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(Number)) {
    const std::string one = bytes.substr(i, sizeof(Number));
    swapped.append(one.rbegin(), one.rend());
  }
  EXPECT_EQ(read_npy(npy(dict(">" + type, "(1, 3)"), swapped, 2), kRoom).values, read) << type;
}

std::string refused_npy(const std::string& bytes) {
  const std::string text = test::message_of<TableError>([&] { (void)read_npy(bytes, kRoom); });
  return text.substr(0, text.find("; expected a matrix of float32, float64 or integers in C order, as numpy.save writes it"));
}

TEST(Npy, IsReadAsNumpyWroteIt) {
  // Bytes that numpy 1.24.2 writes for save(file, array([[0, 0.5, -0.25], [1, 2, 3]], dtype='<f4')).
  std::string file = std::string("\x93NUMPY\x01\x00v\x00", 10) + "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
  file.resize(127, ' ');
  file += std::string("\n\x00\x00\x00\x00\x00\x00\x00?\x00\x00\x80\xbe\x00\x00\x80?\x00\x00\x00@\x00\x00@@", 25);
  const NumberTable table = read_npy(file, kRoom);
  EXPECT_EQ(table.rows, 2U);
  EXPECT_EQ(table.columns, 3U);
  EXPECT_EQ(table.values, (std::vector<double>{0, 0.5, -0.25, 1, 2, 3}));
}

TEST(Npy, HoldsNumbersOfEachKindInBothByteOrders) {
  if constexpr (std::endian::native != std::endian::little) GTEST_SKIP() << "the bytes are made here";
  expect_numbers<float>("f4", {0.1F, -1, 3e30F}, {0.1F, -1, 3e30F});
  expect_numbers<double>("f8", {0.1, -1, 3e300}, {0.1, -1, 3e300});
  expect_numbers<std::int16_t>("i2", {-32768, 1, 32767}, {-32768, 1, 32767});
  expect_numbers<std::int32_t>("i4", {-2147483647, 1, 2}, {-2147483647, 1, 2});
  expect_numbers<std::int64_t>("i8", {-1, 1, 2}, {-1, 1, 2});
  expect_numbers<std::uint16_t>("u2", {65535, 1, 2}, {65535, 1, 2});
  expect_numbers<std::uint32_t>("u4", {4294967295, 1, 2}, {4294967295, 1, 2});
  expect_numbers<std::uint64_t>("u8", {1, 2, 3}, {1, 2, 3});
  EXPECT_EQ(read_npy(npy(dict("|u1", "(2, 1)"), "\x01\xff"), kRoom).values, (std::vector<double>{1, 255}));
  EXPECT_EQ(read_npy(npy(dict("|i1", "(2, 1)"), "\x01\xff", 3), kRoom).values, (std::vector<double>{1, -1}));
  EXPECT_EQ(read_npy(npy(R"({"shape": (1,1),"fortran_order":False,"descr":"|u1"})", "\x07"), kRoom).values,
            (std::vector<double>{7}));
}

TEST(Npy, OfAnotherFormIsRefusedWithWhatItIs) {
  EXPECT_EQ(refused_npy("a,b\n"), "it does not begin as a file of NumPy");
  EXPECT_EQ(refused_npy(std::string(kNpyMagic)), "it ends within its header");
  EXPECT_EQ(refused_npy(std::string(kNpyMagic) + '\x09' + std::string(20, '\0')), "its format has the version 9");
  EXPECT_EQ(refused_npy(std::string(kNpyMagic) + std::string("\x02\0\xff\xff\xff\xff", 6)), "its header has 4294967295 bytes");
  EXPECT_EQ(refused_npy(npy(dict("<f4", "(2, 3)"), "").substr(0, 60)), "it ends within its header");
  EXPECT_EQ(refused_npy(npy(dict("|O", "(2, 2)"), "\x80\x04pickle")),
            "it holds Python objects (dtype object), which can execute code");
  EXPECT_EQ(refused_npy(npy(dict("<c16", "(2, 2)"), "")), "its numbers are of type '<c16'");
  EXPECT_EQ(refused_npy(npy(dict("<f2", "(2, 2)"), "")), "its numbers are of type '<f2'");
  EXPECT_EQ(refused_npy(npy(dict("\x1b[31m" + std::string(90, 'x'), "(2, 2)"), "")),
            "its numbers are of type '?[31mxxxxxxxxxxxxxxxxxxx...'");
  EXPECT_EQ(refused_npy(npy("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (3,), }", "")),
            "it holds records of several fields");
  EXPECT_EQ(refused_npy(npy("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 2), }", std::string(16, '\0'))),
            "it is in Fortran order (numpy.ascontiguousarray makes C order of it)");
  for (const auto& [shape, shown] : {std::pair{"()", "()"}, {"(3,)", "(3,)"}, {"(2, 2, 2)", "(2, 2, 2)"}})
    EXPECT_EQ(refused_npy(npy(dict("<f4", shape), "")), fmt::format("its shape is {}", shown));
  for (const char* header :
       {"", "{", "{}", "{'descr'", "{'descr': '<f4}", "{'descr': '<f4', 'fortran_order': Maybe, 'shape': (1, 1)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1, -1)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': [1, 1]}", "{'descr': '<f4', 'fortran_order': False, 'shape': (1 1)}",
        "{'descr': '<f4', 'fortran_order': False}", "{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (1, 1)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1)} more",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999, 1)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1), 'more': 1}"})
    EXPECT_EQ(refused_npy(npy(header, "")), "its header is not a NumPy header") << header;
}

// A header whose size differs from the file is refused without an allocation, also if it states terabytes or its product
// overflows 64 bits to 0.
TEST(Npy, OfAnotherLengthThanItsHeaderSaysIsRefused) {
  EXPECT_EQ(refused_npy(npy(dict("<f8", "(1000000, 1000000)"), "")),
            "its shape is (1000000, 1000000); expected at most 1000 numbers");
  EXPECT_EQ(refused_npy(npy(dict("<f8", "(4294967296, 4294967296)"), "")),
            "its shape is (4294967296, 4294967296); expected at most 1000 numbers");
  EXPECT_EQ(refused_npy(npy(dict("<f4", "(2, 2)"), std::string(15, '\0'))),
            "15 bytes of numbers follow its header; expected 16 for shape (2, 2) of type '<f4'");
  EXPECT_EQ(refused_npy(npy(dict("<f4", "(2, 2)"), std::string(17, '\0'))),
            "17 bytes of numbers follow its header; expected 16 for shape (2, 2) of type '<f4'");
  EXPECT_EQ(read_npy(npy(dict("<f4", "(0, 5)"), ""), kRoom).values.size(), 0U);
}

std::string from_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return bytes;
}

/// PNG with rows of all five filters; the first row has the filter Paeth. libpng 1.6.39 reads the same numbers.
const std::string& picture() {
  static const std::string kBytes = from_hex(
      "89504e470d0a1a0a0000000d494844520000000400000006100000000091c2bcea0000000374455874610062dc49a23b000000144944415478da0136"
      "00c9"
      "ff0400001eef5dcd9bab009919b857ea5e610000002d49444154271513afdd0164641f2d5d0b9be902fd7dfe9cfebbfeda036120279d479b661a0462"
      "e11f"
      "00621f623e4e7e15a0432d4eea0000000049454e44ae426082");
  return kBytes;
}

std::string refused_png(const std::string& bytes, std::size_t most = kRoom) {
  const std::string text = test::message_of<TableError>([&] { (void)read_grey_png(bytes, most); });
  return text.substr(0, text.find("; expected a PNG of 16 bit grey values without interlacing"));
}

/// Appends the bytes of a PNG chunk.
void add_chunk(std::string& to, const std::string& name, const std::string& data) {
  const auto number = [&](std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) to += static_cast<char>(value >> shift);
  };
  number(static_cast<std::uint32_t>(data.size()));
  const std::string all = name + data;
  to += all;
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : all) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1U) ^ (0xEDB88320U & (0U - (crc & 1U)));
  }
  number(~crc);
}

std::string headed(const std::string& head) {
  std::string bytes(kPngMagic);
  add_chunk(bytes, "IHDR", head);
  return bytes;
}

TEST(GreyPng, IsReadThroughEachOfItsFilters) {
  const NumberTable table = read_grey_png(picture(), kRoom);
  EXPECT_EQ(table.rows, 6U);
  EXPECT_EQ(table.columns, 4U);
  EXPECT_EQ(table.values,
            (std::vector<double>{0,     7919,  31676, 5735,  39193, 47143, 5395, 45021, 25700, 33681, 57500, 31621,
                                 25057, 33069, 56919, 31071, 37264, 45307, 3652, 43371, 62321, 4859,  28771, 2985}));
}

TEST(GreyPng, OfAnotherFormIsRefusedWithWhatItIs) {
  const auto head = [](char depth, char colour, char interlaced) {
    return std::string("\0\0\0\4\0\0\0\6", 8) + depth + colour + std::string(2, '\0') + interlaced;
  };
  EXPECT_EQ(refused_png("GIF89a"), "it does not begin as a PNG");
  EXPECT_EQ(refused_png(headed(head(16, 2, 0))), "it is in colour");
  EXPECT_EQ(refused_png(headed(head(16, 4, 0))), "it is grey with transparency");
  EXPECT_EQ(refused_png(headed(head(8, 0, 0))), "it has 8 bit");
  EXPECT_EQ(refused_png(headed(head(16, 0, 1))), "it is interlaced");
  EXPECT_EQ(refused_png(headed(std::string(8, '\0') + std::string("\x10\0\0\0\0", 5))), "it is empty");
  EXPECT_EQ(refused_png(headed("short")), "it lacks the header of a PNG");
  EXPECT_EQ(refused_png(headed(std::string("\x7f\xff\xff\xff\x7f\xff\xff\xff\x10\0\0\0\0", 13))),
            "it has 2147483647 rows of 2147483647 grey values; expected at most 1000 in all");
  EXPECT_EQ(refused_png(picture(), 23), "it has 6 rows of 4 grey values; expected at most 23 in all");
}

TEST(GreyPng, CutAnywhereOrChangedIsRefused) {
  for (std::size_t size = 0; size < picture().size(); ++size)
    EXPECT_NE(refused_png(picture().substr(0, size)), test::kNoError) << size;
  for (std::size_t at = 0; at < picture().size(); ++at) {
    std::string changed = picture();
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    EXPECT_NE(refused_png(changed), test::kNoError) << at;
  }
  std::string coloured = headed(picture().substr(16, 13));
  add_chunk(coloured, "PLTE", "abc");
  EXPECT_EQ(refused_png(coloured), "it has a chunk that grey PNGs do not have");
  std::string without = headed(picture().substr(16, 13));
  add_chunk(without, "IEND", "");
  EXPECT_EQ(refused_png(without), "its picture is damaged");
}

TEST(NumberTable, ReadsBackWhatItWrites) {
  const std::string bytes = npy_head(2, 3) + bytes_of<double>({1, 2, 3, 4, 5, 0.1});
  EXPECT_EQ(npy_head(2, 3).size() % 64, 0U);
  EXPECT_EQ(read_npy(bytes, kRoom).values, (std::vector<double>{1, 2, 3, 4, 5, 0.1}));
  EXPECT_EQ(read_npy(bytes, kRoom).columns, 3U);
}

TEST(Gzip, GivesTheBytesBackAndRefusesDamage) {
  const std::string bytes = npy_head(2, 3) + std::string(5000, 'x');
  const std::string packed = gzip(bytes);
  EXPECT_LT(packed.size(), bytes.size());
  EXPECT_EQ(gunzip(packed, bytes.size()), bytes);
  EXPECT_EQ(gunzip(gzip(""), 0), "");
  const auto refused = [](const std::string& file, std::size_t most) {
    try {
      return gunzip(file, most);
    } catch (const TableError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refused(packed, bytes.size() - 1),
            fmt::format("it holds {0} bytes; expected at most {1}", bytes.size(), bytes.size() - 1));
  EXPECT_TRUE(refused(packed + "x", 1U << 30U).starts_with("it"));
  EXPECT_EQ(refused(packed.substr(0, 17), 1000), "it is not a complete gzip file");
  for (std::size_t at = 10; at < packed.size(); ++at) {
    std::string damaged = packed;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    const std::string read = refused(damaged, 1U << 30U);
    EXPECT_TRUE(read == bytes || read.starts_with("it")) << at;  // some bits of deflate may differ
  }
}

}  // namespace
}  // namespace gaitlab
