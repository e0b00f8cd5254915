// Scalars read strictly, before any conversion.
#pragma once
#include <cstdint>
#include <string>

#include "core/settings/node.h"

namespace gaitlab {

/// A value, or an error as the rest of a sentence: `is 'fast'; expected a number in s`.
template <class T>
struct Reading {
  T value = {};
  std::string wrong = {};
  [[nodiscard]] bool ok() const { return wrong.empty(); }
};

/// A finite decimal number. Refused: .nan, .inf, hexadecimal, octal, leading zeros, 1_000, quotes, overflow, underflow to 0.
Reading<double> read_number(const Node& node, const std::string& unit);
Reading<std::int64_t> read_integer(const Node& node);
/// `true` or `false`, nothing else.
Reading<bool> read_flag(const Node& node);
/// Any scalar.
Reading<std::string> read_scalar(const Node& node);

}  // namespace gaitlab
