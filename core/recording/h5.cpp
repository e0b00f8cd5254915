#include "core/recording/h5.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <new>
#include <optional>
#include <string_view>

#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/h5_image.h"

namespace gaitlab {

namespace {

constexpr std::string_view kName = "gaitlab-trace-";
constexpr std::string_view kSize = "\nHDF5 follows at byte 512. Bytes in all: ";
constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n";

std::string hash_of_words(const SpilledVector<char>& file, std::size_t from) {
  WordHash words;
  words.add_length(file.size() - from);
  each_part(
      file, [&](std::string_view bytes) { words.add_words(bytes); }, from);
  return words.text();
}

// User block of the file, as text, so that `head -n 2` shows the type of the file.
std::string header(std::size_t size, std::string_view hash) {
  std::string text = fmt::format("{}{}{}; hash from byte 512 on: {}\n", kTraceFormat, kSize, size, hash);
  text.resize(kUserBlock, '\0');
  return text;
}

// Removes the number at the start of `text` and returns it.
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

// True if HDF5 would open the file. The HDF5 signature may be at 0, 512, 1024 ...
bool is_hdf5(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size(); at = at == 0 ? kUserBlock : 2 * at) {
    if (bytes.substr(at).starts_with(kHdf5)) return true;
  }
  return false;
}

// Error message for a file of `bytes` bytes that begins with `start`, or "".
std::string complaint(std::string_view start, std::uintmax_t bytes) {
  if (bytes == 0) return "is empty";
  std::string_view rest = start.substr(0, kUserBlock);
  if (rest.size() < kName.size() && kName.starts_with(rest)) return fmt::format("is truncated: {} bytes", bytes);
  if (!take(rest, kName))
    return is_hdf5(start) ? "is an HDF5 file, but not a gaitlab trace" : "is not a gaitlab trace (nor another HDF5 file)";
  const bool cut = bytes < kUserBlock;
  const std::string_view version = rest.substr(0, rest.find('\n'));
  if (version != kTraceFormat.substr(kName.size())) {
    const bool number = !version.empty() && version.find_first_not_of("0123456789") == std::string_view::npos;
    if (number && !cut) return fmt::format("has format {}{}; this gaitlab reads {}", kName, version, kTraceFormat);
    return cut ? fmt::format("is truncated: {} bytes", bytes) : "is corrupt: its first line is damaged";
  }
  rest.remove_prefix(version.size());
  if (cut) return fmt::format("is truncated: {} bytes", bytes);
  const std::optional<std::size_t> size = take(rest, kSize) ? take_number(rest) : std::nullopt;
  if (!size) return "is corrupt: its second line is damaged";
  if (bytes < *size) return fmt::format("is truncated: {} of {} bytes", bytes, *size);
  if (bytes > *size) return fmt::format("is corrupt: {} bytes, but {} were written", bytes, *size);
  return "";
}

// True if the user block matches the remaining bytes.
bool is_whole(const SpilledVector<char>& bytes) {
  return view(bytes).substr(0, kUserBlock) == header(bytes.size(), hash_of_words(bytes, kUserBlock));
}

}  // namespace

void write_h5(const Trace& trace, const Provenance& origin, const std::filesystem::path& path,
              std::span<const BesideOf> beside) {
  AtomicFile file(path);
  SpilledVector<char> image;
  try {
    image = to_image(trace, origin, beside);
  } catch (const ImageError& error) {
    throw NoImage(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
  } catch (const std::bad_alloc&) {
    throw NoImage(path.string() + ": cannot be written: out of memory");
  }
  std::ranges::copy(header(image.size(), hash_of_words(image, kUserBlock)), image.begin());
  each_part(image, [&](std::string_view bytes) { file.write(bytes); });
  file.commit();
}

StoredTrace read_h5(const std::filesystem::path& path) {
  // The header is checked first, so that a file of another size or kind is not read in full.
  constexpr std::size_t kStart = 1 << 16;
  const SourceLocation place{path.string()};
  if (std::string text = complaint(read_start(path, kStart), size_of(path)); !text.empty())
    throw InputError(place, std::move(text));
  const SpilledVector<char> bytes = read_large_file(path, kMostTrace);
  if (bytes.size() < kUserBlock || !is_whole(bytes))
    throw InputError(place, "is corrupt or was changed by another program: its bytes are not those that were written");
  try {
    StoredTrace stored = from_image(bytes);
    stored.file = path;
    return stored;
  } catch (const ImageError& error) {
    throw InputError(place, fmt::format("is corrupt: {}", error.what()));
  }
}

}  // namespace gaitlab
