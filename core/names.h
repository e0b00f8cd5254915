// Names of the values of an enum class, in one table next to the enum, for messages, files and screens.
#pragma once
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>

namespace gaitlab {

/// Table of an enum's names, specialised next to the enum. The values of the enum must count from 0. It contains `static
/// constexpr EnumName<Enum> kTable[]` with a row for each value, in the order of the values. A row may be of any type with
/// `value` and `text`, so that a table may have further columns. A value without a row is a compiler error where the table is
/// used.
template <class Enum>
struct EnumNames;

template <class Enum>
struct EnumName {
  Enum value;
  const char* text;
};

template <class Enum>
concept NamedEnum = requires {
  EnumNames<Enum>::kTable;
};

/// True if an enum has this value. The compiler prints an enumerator by its name, and any other value as a cast:
/// `(gaitlab::Word)4`.
template <auto kValue>
constexpr bool is_enumerator() {
  constexpr std::string_view kShown = __PRETTY_FUNCTION__;  // `... kValue = gaitlab::Word::feasible]`
  return kShown[kShown.find_last_not_of("0123456789", kShown.size() - 2)] != ')';
}

/// True if the table has every value of the enum, in the enum's order.
template <NamedEnum Enum>
constexpr bool all_named() {
  constexpr std::size_t kSize = std::size(EnumNames<Enum>::kTable);
  for (std::size_t k = 0; k < kSize; ++k) {
    if (static_cast<std::size_t>(EnumNames<Enum>::kTable[k].value) != k) return false;
  }
  return is_enumerator<static_cast<Enum>(kSize - 1)>() && !is_enumerator<static_cast<Enum>(kSize)>();
}

template <NamedEnum Enum>
constexpr const auto& enum_table() {
  static_assert(all_named<Enum>(), "the table lacks a value of the enum, or has another order");
  return EnumNames<Enum>::kTable;
}

/// The table row of a value.
template <NamedEnum Enum>
constexpr const auto& enum_row(Enum value) {
  return enum_table<Enum>()[static_cast<std::size_t>(value)];
}

template <NamedEnum Enum>
constexpr const char* name_of(Enum value) {
  return enum_row(value).text;
}

/// The value with this name; nothing if the name is unknown.
template <NamedEnum Enum>
constexpr std::optional<Enum> named(std::string_view text) {
  for (const auto& row : enum_table<Enum>()) {
    if (text == row.text) return row.value;
  }
  return {};
}

namespace detail {

template <class Enum>
inline constexpr auto kTexts = [] {
  std::array<const char*, std::size(EnumNames<Enum>::kTable)> texts{};
  for (std::size_t k = 0; k < texts.size(); ++k) texts[k] = enum_table<Enum>()[k].text;
  return texts;
}();

}  // namespace detail

/// All names in the order of the values, for `Fields::choice`, and for messages that suggest the nearest name.
template <NamedEnum Enum>
constexpr std::span<const char* const> enum_names() {
  return detail::kTexts<Enum>;
}

}  // namespace gaitlab
