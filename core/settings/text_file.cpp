#include "core/settings/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/files/atomic_file.h"
#include "core/settings/data_folder.h"

namespace gaitlab {
namespace {

[[noreturn]] void refuse(const std::string& path, const SourceLocation& asked_at, const std::string& what) {
  if (asked_at.file.empty()) throw InputError({path}, what);
  throw InputError(asked_at, fmt::format("file '{}' {}", path, what));
}

/// Number of bytes of the UTF-8 character that starts at `at`. It is 0 if there is no valid character; overlong forms and
/// surrogates are invalid.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80) return 0;
  }
  const unsigned second = byte(at + 1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool outside = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return overlong || outside ? 0 : length;
}

/// Error message about the character at `at`, or "".
std::string bad_character(const std::string& text, std::size_t at) {
  const auto c = static_cast<unsigned char>(text[at]);
  if (c == '\t' || c == '\n') return {};
  if (c == '\r') return at + 1 < text.size() && text[at + 1] == '\n' ? std::string{} : "a carriage return without a line feed";
  if (c == 0) return "a NUL byte";
  if (c < 0x20 || c == 0x7F) return fmt::format("the control character 0x{:02x}", c);
  if (utf8_length(text, at) == 0) return fmt::format("the byte 0x{:02x}, which is not UTF-8", c);
  return {};
}

/// True if a file is within a folder; false if either path cannot be resolved.
bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code failure;
  const std::filesystem::path inner = std::filesystem::canonical(file, failure);
  if (failure) return false;
  const std::filesystem::path outer = std::filesystem::canonical(folder.empty() ? "." : folder, failure);
  if (failure) return false;
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

/// True if a line of the file begins with NamedFile::key.
bool says(const NamedFile& file) {
  if (file.key.empty()) return false;
  try {
    const std::string text = "\n" + read_text(file.path);
    return text.find("\n" + file.key + ":") != std::string::npos;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

bool may_quote(const std::string& path, const std::string& folder) {
  return lies_in(path, folder) || lies_in(path, data_folder());
}

void add_found(const Problems& found, const NamedFile& file, Problems& problems) {
  const auto of_file = [&](const Problem& problem) { return problem.place.file == file.path; };
  std::error_code none;
  const bool hidden = std::filesystem::exists(file.path, none) && std::ranges::any_of(found.list(), of_file) &&
                      !may_quote(file.path, file.folder) && !says(file);
  bool first = true;
  for (const Problem& problem : found.list()) {
    if (!hidden || !of_file(problem)) {
      problems.add(problem);
    } else if (std::exchange(first, false)) {
      problems.add(problem.place, fmt::format("is not a {}; {}", file.kind, kNotShown));
    }
  }
}

std::string read_text(const std::string& path, const SourceLocation& asked_at) {
  constexpr std::size_t kMost = std::size_t{1} << 22;  // a log of 90 s with 1000 rows of 45 bytes per second
  std::string text;
  try {
    text = read_start(path, kMost + 1);
  } catch (const InputError& error) {
    refuse(path, asked_at, error.problems().front().text);
  }
  if (text.size() > kMost) refuse(path, asked_at, "is larger than 4 MB");
  return text;
}

void check_text(const std::string& text, const std::string& file) {
  int line = 1;
  std::size_t start = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::string bad = bad_character(text, at);
    if (!bad.empty())
      throw InputError({file, line, static_cast<int>(at - start) + 1}, "found " + bad + "; expected a text file");
    if (text[at] == '\n') {
      ++line;
      start = at + 1;
    }
    at += utf8_length(text, at);
  }
}

std::string path_from(const std::string& folder, const std::string& path) {
  return (std::filesystem::path(folder) / path).lexically_normal().string();
}

}  // namespace gaitlab
