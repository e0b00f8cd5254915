// Names of the files that AtomicFile writes before they get their final names.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace gaitlab {

inline constexpr std::string_view kPartEnd = ".part";
inline constexpr std::size_t kPartDigits = 16;

/// Name `.NAME.XXXXXXXXXXXXXXXX.part` of a file that is to become NAME. A long NAME is clipped.
inline std::string part_name(const std::string& name, std::uint64_t number) {
  constexpr std::size_t kName = 200;  // most bytes of the name, so that the rest fits as well
  return fmt::format(".{}.{:0{}x}{}", name.substr(0, kName), number, kPartDigits, kPartEnd);
}

/// True for a regular file with such a name, left behind by a killed process. To a user, a folder with only such files is
/// empty.
inline bool is_part_file(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  constexpr std::size_t kBehind = 1 + kPartDigits + kPartEnd.size();  // bytes behind NAME
  if (name.size() < 2 + kBehind || name.front() != '.' || !name.ends_with(kPartEnd)) return false;
  const std::string_view behind = std::string_view(name).substr(name.size() - kBehind);
  const auto is_hexadecimal = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  std::error_code none;
  return behind.front() == '.' && std::ranges::all_of(behind.substr(1, kPartDigits), is_hexadecimal) &&
         std::filesystem::is_regular_file(std::filesystem::symlink_status(file, none));
}

}  // namespace gaitlab
