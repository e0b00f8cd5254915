#include "core/recording/h5.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "core/errors.h"
#include "core/recording/atomic_file.h"
#include "core/recording/h5_image.h"

namespace gaitlab {

namespace {

constexpr std::string_view kName = "gaitlab-trace-";
constexpr std::string_view kSize = "\nHDF5 follows at byte 512. Bytes in all: ";
constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n";

// A format that this program reads.
struct Format {
  std::string_view version, hash_name;
  std::string (*hash)(std::string_view);
};
constexpr std::array<Format, 2> kFormats{{{"1", "FNV-1a", [](std::string_view bytes) { return hash(bytes); }},
                                          {"2", "hash", [](std::string_view bytes) { return hash_words(bytes); }}}};

// The user block. Text, so that `head -n 2` shows what the file is.
std::string header(const Format& format, std::size_t size, std::string_view hdf5) {
  std::string text = fmt::format("{}{}{}{}; {} from byte 512 on: {}\n", kName, format.version, kSize, size, format.hash_name,
                                 format.hash(hdf5));
  text.resize(kUserBlock, '\0');
  return text;
}

// The number at the start of `text`, which it takes off.
std::optional<std::size_t> take_number(std::string_view& text) {
  std::size_t number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, std::string_view expected) {
  if (!text.starts_with(expected)) return false;
  text.remove_prefix(expected.size());
  return true;
}

// Whether HDF5 would open it: its signature may stand at 0, 512, 1024 ...
bool is_hdf5(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size(); at = at == 0 ? kUserBlock : 2 * at) {
    if (bytes.substr(at).starts_with(kHdf5)) return true;
  }
  return false;
}

// What is wrong with the file before HDF5 sees it, or "".
std::string complaint(std::string_view bytes) {
  if (bytes.empty()) return "is empty";
  std::string_view rest = bytes.substr(0, kUserBlock);
  if (rest.size() < kName.size() && kName.starts_with(rest)) return fmt::format("is truncated: {} bytes", bytes.size());
  if (!take(rest, kName))
    return is_hdf5(bytes) ? "is an HDF5 file, but no gaitlab trace" : "is not a gaitlab trace (nor another HDF5 file)";
  const bool cut = bytes.size() < kUserBlock;
  const std::string_view version = rest.substr(0, rest.find('\n'));
  const auto format = std::ranges::find(kFormats, version, &Format::version);
  if (format == kFormats.end()) {
    const bool number = !version.empty() && version.find_first_not_of("0123456789") == std::string_view::npos;
    if (number && !cut) return fmt::format("has format {}{}; this gaitlab reads {}1 and 2", kName, version, kName);
    return cut ? fmt::format("is truncated: {} bytes", bytes.size()) : "is corrupt: its first line is damaged";
  }
  rest.remove_prefix(version.size());
  if (cut) return fmt::format("is truncated: {} bytes", bytes.size());
  const std::optional<std::size_t> size = take(rest, kSize) ? take_number(rest) : std::nullopt;
  if (!size) return "is corrupt: its second line is damaged";
  if (bytes.size() < *size) return fmt::format("is truncated: {} of {} bytes", bytes.size(), *size);
  if (bytes.size() > *size) return fmt::format("is corrupt: {} bytes, of which {} were written", bytes.size(), *size);
  const std::string_view hdf5 = bytes.substr(kUserBlock);
  if (bytes.substr(0, kUserBlock) != header(*format, *size, hdf5))
    return "is corrupt or was changed by another program: its bytes are not those that were written";
  return "";
}

}  // namespace

void write_h5(const Trace& trace, const Provenance& origin, const std::filesystem::path& path, std::span<const Beside> beside) {
  AtomicFile file(path);
  std::string hdf5;
  try {
    hdf5 = to_image(trace, origin, beside);
  } catch (const ImageError& error) {
    throw RunError(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
  }
  file.write(header(kFormats.back(), kUserBlock + hdf5.size(), hdf5));
  file.write(hdf5);
  file.commit();
}

StoredTrace read_h5(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const SourceLocation place{path.string()};
  if (std::string text = complaint(bytes); !text.empty()) throw InputError(place, std::move(text));
  try {
    return from_image(bytes);
  } catch (const ImageError& error) {
    throw InputError(place, fmt::format("is corrupt: {}", error.what()));
  }
}

}  // namespace gaitlab
