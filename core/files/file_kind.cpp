#include "core/files/file_kind.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include "core/files/atomic_file.h"

namespace gaitlab {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Key at the beginning of a line, or "".
std::string_view key_of(std::string_view line) {
  std::size_t end = 0;
  while (end < line.size() && (is_letter(line[end]) || (end > 0 && is_digit(line[end])))) ++end;
  const bool colon = end > 0 && end < line.size() && line[end] == ':';
  const bool followed = colon && (end + 1 == line.size() || line[end + 1] == ' ' || line[end + 1] == '\r');
  return followed ? line.substr(0, end) : std::string_view();
}

/// True for a row of a build file: five whole numbers.
bool is_dock(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::size_t numbers = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool blank = line[i] == ' ' || line[i] == '\t' || line[i] == '\r';
    if (!blank && !is_digit(line[i])) return false;
    if (!blank && (i == 0 || !is_digit(line[i - 1]))) ++numbers;
  }
  return numbers == 5;
}

struct Head {
  std::set<std::string, std::less<>> keys = {};
  bool docks = true;  ///< true if every line with content is a row of a build file
  int line = 0;       ///< number of the first line with content, 0 if there is none
};

Head head_of(std::string_view text) {
  Head head;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    if (head.line == 0) head.line = number + 1;
    head.docks = head.docks && is_dock(line);
    if (const std::string_view key = key_of(line); !key.empty()) head.keys.emplace(key);
  }
  return head;
}

std::optional<FileKind> kind_of(const Head& head) {
  const auto has = [&](const char* key) { return head.keys.contains(key); };
  if (head.line > 0 && head.docks) return FileKind::robot;
  if (has("gaitlab_servo")) return FileKind::servo;
  if (has("gaitlab_cpg")) return FileKind::cpg;
  if (has("gaitlab_module") || (has("bodies") && !has("robot"))) return FileKind::module;
  if (has("gaitlab_study") || (has("parameters") && (has("scenario") || has("scenarios")))) return FileKind::study;
  if (has("panels") && !has("robot")) return FileKind::recipe;
  if (has("robot") || (has("gaitlab") && has("duration"))) return FileKind::scenario;
  return {};
}

/// Kind of a file that cannot be a scenario, by its first characters.
std::optional<FileKind> kind_of_start(std::string_view text) {
  constexpr std::string_view kResults[] = {"\"verdict\":", "\"real_time_factor\":"};
  if (text.starts_with("gaitlab-trace") || text.starts_with("\x89HDF"))
    return FileKind::trace;  // with and without a user block
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.starts_with("<!doctype html") || text.starts_with("<html")) return FileKind::page;
  if (text.starts_with("<") && text.find("<robot") != std::string_view::npos) return FileKind::urdf;
  const auto has = [&](std::string_view key) { return text.find(key) != std::string_view::npos; };
  if (text.starts_with("{") && std::ranges::any_of(kResults, has) && !has("\"robot\":")) return FileKind::results;
  return {};
}

bool is_folder(const std::string& path) {
  std::error_code none;
  return std::filesystem::is_directory(path, none);
}

std::string text_of(const std::string& path) {
  try {
    return read_start(path, kMostScenario);
  } catch (const InputError&) {
    return {};
  }
}

std::string remedy(const FileKindRow& kind, const std::string& path) {
  return *kind.use == '\0' ? kind.remedy : std::string(kind.remedy) + " " + kind.use + " " + path;
}

}  // namespace

std::optional<FileKind> kind_of_text(const std::string& text) {
  const std::optional<FileKind> kind = kind_of_start(text);
  return kind ? kind : kind_of(head_of(text));
}

std::optional<FileKind> kind_of_file(const std::string& path) {
  if (!is_folder(path)) return kind_of_text(text_of(path));
  for (const char* name : {"trace.h5", "trace.csv", "scenario.resolved.yaml"}) {
    std::error_code none;
    if (std::filesystem::exists(std::filesystem::path(path) / name, none)) return FileKind::run;
  }
  std::error_code none;
  if (std::filesystem::exists(std::filesystem::path(path) / "golden.json", none)) return FileKind::golden;
  return {};
}

std::optional<Problem> of_another_kind(const std::string& path, FileKind expected) {
  const std::optional<FileKind> kind = kind_of_file(path);
  if (!kind || *kind == expected) return {};
  const int line = is_folder(path) || kind == FileKind::trace ? 0 : head_of(text_of(path)).line;
  const std::string text = std::string("this is ") + enum_row(*kind).noun + ", not " + enum_row(expected).noun + "; " +
                           remedy(enum_row(*kind), path);
  return Problem{{path, line, line > 0 ? 1 : 0}, text};
}

void expect_kind(const std::string& path, FileKind expected) {
  if (std::optional<Problem> other = of_another_kind(path, expected)) throw InputError({std::move(*other)});
}

std::string but_it_is(const std::string& path) {
  const std::optional<FileKind> kind = kind_of_file(path);
  if (!kind) return "";
  const FileKindRow& row = enum_row(*kind);
  return std::string("; it is ") + row.noun +
         (*row.use == '\0' ? std::string("; ") + row.remedy : std::string(": ") + row.use + " " + path);
}

}  // namespace gaitlab
