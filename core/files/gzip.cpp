#include "core/files/gzip.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <memory>
#include <new>

#include "core/files/number_table.h"

namespace gaitlab {

namespace {

constexpr int kPackLevel = 4;             // level 6 takes twice as long for a field of random heights, and saves 0.1 %
constexpr std::size_t kLeast = 18;        // bytes of header and trailer
constexpr std::size_t kMostRatio = 1032;  // largest factor by which deflate can expand

struct FreePacker {
  void operator()(libdeflate_compressor* one) const { libdeflate_free_compressor(one); }
};
struct FreeUnpacker {
  void operator()(libdeflate_decompressor* one) const { libdeflate_free_decompressor(one); }
};

/// Number of bytes in the file, modulo 2^32, from its last four bytes.
std::size_t stated_size(std::string_view packed) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < 4; ++i) size = 256 * size + static_cast<unsigned char>(packed[packed.size() - 1 - i]);
  return size;
}

}  // namespace

std::string gzip(std::string_view bytes) {
  const std::unique_ptr<libdeflate_compressor, FreePacker> packer(libdeflate_alloc_compressor(kPackLevel));
  if (packer == nullptr) throw std::bad_alloc();
  std::string packed(libdeflate_gzip_compress_bound(packer.get(), bytes.size()), '\0');
  packed.resize(libdeflate_gzip_compress(packer.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
  return packed;
}

std::string gunzip(std::string_view packed, std::size_t most) {
  if (packed.size() < kLeast || !packed.starts_with(kGzipMagic)) throw TableError("it is not a complete gzip file");
  const std::size_t size = stated_size(packed);
  if (size > most) throw TableError(fmt::format("it holds {} bytes; expected at most {}", size, most));
  if (size > kMostRatio * packed.size()) throw TableError("its compressed bytes are damaged");
  const std::unique_ptr<libdeflate_decompressor, FreeUnpacker> unpacker(libdeflate_alloc_decompressor());
  if (unpacker == nullptr) throw std::bad_alloc();
  std::string bytes(size, '\0');
  std::size_t read = 0;
  const auto result =
      libdeflate_gzip_decompress_ex(unpacker.get(), packed.data(), packed.size(), bytes.data(), size, &read, nullptr);
  if (result != LIBDEFLATE_SUCCESS || read != packed.size()) throw TableError("its compressed bytes are damaged");
  return bytes;
}

}  // namespace gaitlab
