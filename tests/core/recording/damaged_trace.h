// A trace file with every table of a run, and ways to damage it that keep its signature valid.
#pragma once
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "core/files/hash.h"
#include "core/recording/h5.h"
#include "core/recording/h5_image.h"
#include "tests/folder.h"

namespace gaitlab::test {

/// The bytes with the correct size and hash in their first lines, so that HDF5 reads them.
inline std::string sealed(const std::string& bytes) {
  const std::string body = bytes.substr(kUserBlock);
  std::string head = "gaitlab-trace-1\nHDF5 follows at byte 512. Bytes in all: " + std::to_string(bytes.size()) +
                     "; hash from byte 512 on: " + hash_words(body) + "\n";
  head.resize(kUserBlock, '\0');
  return head + body;
}

/// A number at a place of a file, which must exist.
template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number{};
  std::memcpy(&number, &bytes.at(at + sizeof number - 1) - (sizeof number - 1), sizeof number);
  return number;
}
template <class Number>
void put_number(std::string& bytes, std::size_t at, Number number) {
  bytes.replace(at, sizeof number, reinterpret_cast<const char*>(&number), sizeof number);
}

/// Entry of a chunk in an index of HDF5, a B-tree of version 1: size, left-out filters, row, column, size of a value, address.
struct ChunkEntry {
  std::size_t at;
  static constexpr std::size_t kMask = 4, kRow = 8, kColumn = 16, kAddress = 32, kBytes = 40;
};

inline std::vector<ChunkEntry> chunk_entries(const std::string& bytes) {
  std::vector<ChunkEntry> found;
  const std::string leaf("TREE\1\0", 6);  // signature, type: chunks, level: leaf
  for (std::size_t node = bytes.find(leaf); node != std::string::npos; node = bytes.find(leaf, node + 1)) {
    constexpr std::size_t kHead = 24;
    const auto entries = number_at<std::uint16_t>(bytes, node + leaf.size());
    for (std::size_t k = 0; k < entries; ++k) found.push_back({node + kHead + k * ChunkEntry::kBytes});
  }
  return found;
}

/// Place of a chunk in the file, whose addresses are counted from the end of the user block.
inline std::size_t chunk_place(const std::string& bytes, const ChunkEntry& entry) {
  return kUserBlock + number_at<std::uint64_t>(bytes, entry.at + ChunkEntry::kAddress);
}

/// `count` zeros in the format of zlib.
inline std::string packed_zeros(std::size_t count) {
  const std::string zeros(count, '\0');
  uLongf size = compressBound(count);
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(zeros.data()), count, 9);
  packed.resize(size);
  return packed;
}

/// Replaces a chunk by `count` packed zero bytes, if they fit into its place.
inline bool replace_chunk(std::string& bytes, const ChunkEntry& entry, std::size_t count) {
  const std::string packed = packed_zeros(count);
  if (packed.size() > number_at<std::uint32_t>(bytes, entry.at)) return false;
  bytes.replace(chunk_place(bytes, entry), packed.size(), packed);
  put_number(bytes, entry.at, static_cast<std::uint32_t>(packed.size()));
  return true;
}

/// A table of numbers that compress badly, so that any other chunk fits into the place of a chunk.
inline Trace noisy_table(std::size_t rows, std::size_t columns) {
  std::mt19937_64 random(rows);
  Trace made;
  for (std::size_t c = 0; c < columns; ++c) made.columns.push_back({"c" + std::to_string(c), "m", "a column"});
  for (std::size_t k = 0; k < rows * columns; ++k) made.values.push_back(std::ldexp(static_cast<double>(random() >> 11U), -53));
  return made;
}

/// Bytes of a file with a trace of two chunks a column, and all other tables of one chunk a column.
inline std::string whole_trace(const std::string& file) {
  std::vector<Trace> tables;
  std::vector<BesideOf> beside;
  tables.reserve(std::size(kBeside));
  for (const char* name : kBeside) {
    tables.push_back(noisy_table(40 + tables.size(), 3));
    beside.push_back({name, &tables.back()});
  }
  write_h5(noisy_table(5000, 3), {"gaitlab: 1\nname: x\n", 7, "build", "done"}, file, beside);
  return read(file);
}

}  // namespace gaitlab::test
