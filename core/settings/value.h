// Strict readers of scalars, which check the text before they convert it.
#pragma once
#include <cstdint>
#include <string>

#include "core/settings/node.h"

namespace gaitlab {

/// A value, or an error message that continues a sentence, such as `is 'fast'; expected a number in s`.
template <class T>
struct Reading {
  T value = {};
  std::string wrong = {};
  [[nodiscard]] bool ok() const { return wrong.empty(); }
};

/// Reads a finite decimal number. Refuses .nan, .inf, hexadecimal, octal, leading zeros, 1_000, quotes, overflow, and underflow
/// to 0.
Reading<double> read_number(const Node& node, const std::string& unit);
Reading<std::int64_t> read_integer(const Node& node);
/// Reads `true` or `false`, and refuses any other text.
Reading<bool> read_flag(const Node& node);
/// Reads any scalar as text.
Reading<std::string> read_scalar(const Node& node);

/// Text such as `amplitude: 0,4 is two entries; write 0.4` if entry `i` of a map on one line is the second half of a number
/// with a decimal comma; empty for other entries.
std::string decimal_comma(const Node& map, std::size_t i);

}  // namespace gaitlab
